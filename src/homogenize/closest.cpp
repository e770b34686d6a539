// Tensors of higher symmetry closest to a stiffness, and how far it is from isotropic.
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "koshi/homogenize.h"

namespace koshi::homogenize {
namespace {

using Rotation = Eigen::Matrix3d;
using Voigt = std::array<std::array<double, 6>, 6>;

constexpr std::array<std::array<int, 2>, 6> indices{{{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}};

// An entry of the matrix stands for one, two or four of the tensor.
double count_of(std::size_t i, std::size_t j) { return (i < 3 ? 1 : 2) * (j < 3 ? 1 : 2); }

double square_of(const Voigt& C) {
  double sum = 0;
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j) sum += count_of(i, j) * C[i][j] * C[i][j];
  return sum;
}

// The tensor in a frame whose axes are the rows of R: C'_ijkl = R_ip R_jq R_kr R_ls C_pqrs, by matrices of strains.
Voigt turned(const Voigt& C, const Rotation& R) {
  Eigen::Matrix<double, 6, 6> T, V;
  for (Eigen::Index a = 0; a < 6; ++a)
    for (Eigen::Index b = 0; b < 6; ++b) {
      const auto [i, j] = indices[static_cast<std::size_t>(a)];
      const auto [p, q] = indices[static_cast<std::size_t>(b)];
      T(a, b) = p == q ? R(i, p) * R(j, q) : R(i, p) * R(j, q) + R(i, q) * R(j, p);
      V(a, b) = C[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)];
    }
  const Eigen::Matrix<double, 6, 6> W = T * V * T.transpose();
  Voigt result;
  for (std::size_t a = 0; a < 6; ++a)
    for (std::size_t b = 0; b < 6; ++b) result[a][b] = W(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
  return result;
}

// Mean over the rotations of a cube about the axes of the frame.
Voigt cubic_part(const Voigt& C) {
  const double c11 = (C[0][0] + C[1][1] + C[2][2]) / 3, c12 = (C[0][1] + C[0][2] + C[1][2]) / 3;
  const double c44 = (C[3][3] + C[4][4] + C[5][5]) / 3;
  Voigt part{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) part[i][j] = i == j ? c11 : c12;
    part[3 + i][3 + i] = c44;
  }
  return part;
}

// Mean over all rotations about the frame's third axis.
Voigt transverse_part(const Voigt& C) {
  const double c11 = 0.375 * (C[0][0] + C[1][1]) + 0.25 * C[0][1] + 0.5 * C[5][5];
  const double c12 = 0.125 * (C[0][0] + C[1][1]) + 0.75 * C[0][1] - 0.5 * C[5][5];
  const double c13 = 0.5 * (C[0][2] + C[1][2]), c44 = 0.5 * (C[3][3] + C[4][4]);
  Voigt part{};
  part[0][0] = part[1][1] = c11;
  part[0][1] = part[1][0] = c12;
  part[0][2] = part[2][0] = part[1][2] = part[2][1] = c13;
  part[2][2] = C[2][2];
  part[3][3] = part[4][4] = c44;
  part[5][5] = 0.5 * (c11 - c12);
  return part;
}

Rotation about(int axis, double angle) {
  return Eigen::AngleAxisd(angle, Eigen::Vector3d::Unit(axis)).toRotationMatrix();
}

// The frame in which the part is largest, and so the rest smallest: the parts are means, hence orthogonal projections.
// From each start, turns about the three axes that make it larger, by halving angles.
Rotation best_frame(const Voigt& C, Voigt (*part)(const Voigt&)) {
  const auto size = [&](const Rotation& R) { return square_of(part(turned(C, R))); };
  Rotation best = Rotation::Identity();
  double largest = size(best);
  for (const double a : {0.0, 1.0, 2.0})
    for (const double b : {0.0, 1.0, 2.0}) {
      constexpr double third = std::numbers::pi / 6;
      Rotation R = about(0, third * a) * about(1, third * b);
      double here = size(R);
      for (double step = third / 2; step > 1e-9;) {
        bool better = false;
        for (int axis = 0; axis < 3; ++axis)
          for (const double sign : {1.0, -1.0}) {
            const Rotation next = about(axis, sign * step) * R;
            const double there = size(next);
            if (!(there > here)) continue;
            R = next;
            here = there;
            better = true;
          }
        if (!better) step /= 2;
      }
      // What is no better than rounding is no other frame.
      if (here > largest * (1 + 1e-12)) {
        best = R;
        largest = here;
      }
    }
  return best;
}

Closest closest(const material::ElasticTensor& C, Voigt (*part)(const Voigt&)) {
  const Rotation R = best_frame(C.voigt, part);
  Closest result;
  Voigt rest = turned(C.voigt, R);
  result.tensor.voigt = part(rest);
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j) rest[i][j] -= result.tensor.voigt[i][j];
  const double all = square_of(C.voigt);
  result.distance = all > 0 ? std::sqrt(square_of(rest) / all) : 0;
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t i = 0; i < 3; ++i)
      result.axes[a][i] = R(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(i));
  return result;
}

}  // namespace

Closest closest_cubic(const material::ElasticTensor& C) { return closest(C, cubic_part); }
Closest closest_transverse(const material::ElasticTensor& C) { return closest(C, transverse_part); }

std::optional<double> universal_anisotropy(const material::ElasticTensor& C) {
  const auto S = material::compliance(C);
  if (!S) return std::nullopt;
  // Means over all orientations: of C (Voigt) and of S (Reuss), whose shear strains are engineering ones.
  const auto& V = C.voigt;
  double trace = 0, cross = 0, shear = 0, s_trace = 0, s_cross = 0, s_shear = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    trace += V[i][i];
    cross += V[i][(i + 1) % 3];
    shear += V[3 + i][3 + i];
    s_trace += (*S)[i][i];
    s_cross += (*S)[i][(i + 1) % 3];
    s_shear += (*S)[3 + i][3 + i];
  }
  const double bulk_voigt = (trace + 2 * cross) / 9, shear_voigt = (trace - cross + 3 * shear) / 15;
  const double bulk_reuss = 1 / (s_trace + 2 * s_cross);
  const double shear_reuss = 15 / (4 * (s_trace - s_cross) + 3 * s_shear);
  return 5 * shear_voigt / shear_reuss + bulk_voigt / bulk_reuss - 6;
}

}  // namespace koshi::homogenize
