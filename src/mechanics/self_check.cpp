#include "mechanics/self_check.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include "mechanics/cell_matrix.h"

namespace koshi::mechanics {
namespace {

using material::Kinematics;
using material::Springs;

/// Corner unknowns of bending with curvatures a, b and a twist t about x, the cell's centre at the origin. Terms of
/// even order (a y^2/2 + b z^2/2) are equal on all corners: a translation, left out.
Eigen::VectorXd curved_field(double a, double b, double t, double d, Kinematics kinematics) {
  const int n = components(kinematics);
  Eigen::VectorXd q = Eigen::VectorXd::Zero(corner_count * n);
  for (int node = 0; node < corner_count; ++node) {
    const auto [i, j, k] = corner(node);
    const double x = (i - 0.5) * d, y = (j - 0.5) * d, z = (k - 0.5) * d;
    q.segment<3>(node * n) << 0, -a * x * y - t * z * x, -b * x * z + t * y * x;
    if (n == 6) q.segment<3>(node * n + 3) << t * x, b * z - t * y / 2, -a * y - t * z / 2;
  }
  return q;
}

/// Springs that give one isolated cell its full bonds.
Springs unshared(Springs springs) {
  for (int family = 0; family < lattice::family_count; ++family) {
    springs.kn[family] *= lattice::cells_per_bond[family];
    springs.kt[family] *= lattice::cells_per_bond[family];
  }
  return springs;
}

bool only_edges(const Springs& springs) {
  return springs.kn[1] == 0 && springs.kt[1] == 0 && springs.kn[2] == 0 && springs.kt[2] == 0;
}

void judge(const Springs& springs, Kinematics kinematics, SelfCheck& check) {
  const bool rotational = kinematics == Kinematics::rotational;
  const char* const stable_choice =
      "use calibration \"isotropic\", or \"bending-exact\" with kinematics \"rotational\", which are stable for "
      "-1 < nu < 0.5";
  if (check.cell.least < 0 || check.zone.least < 0) {
    check.verdict = Verdict::refuse;
    check.reason = check.zone.least < 0
                       ? fmt::format(
                             "unstable: the wave with k d = ({:.3g}, {:.3g}, {:.3g}) has a negative squared "
                             "frequency, so it grows without load",
                             check.zone.least_phase[0], check.zone.least_phase[1], check.zone.least_phase[2])
                       : fmt::format(
                             "unstable: a single cell has a negative eigenvalue ({:.3g} mu d), so surfaces and "
                             "thin parts deform without load",
                             check.cell.least);
    check.remedy = stable_choice;
  } else if (check.zone.soft_vectors > 0 && (check.zone.soft_moves || !only_edges(springs))) {
    check.verdict = Verdict::refuse;
    check.reason =
        fmt::format("spurious modes: at {} of {} wave vectors {} without any energy", check.zone.soft_vectors,
                    check.zone.vectors, check.zone.soft_moves ? "nodes move" : "nodes turn");
    check.remedy = rotational && !check.zone.soft_moves
                       ? std::string(
                             "give edges and face diagonals some shear stiffness kt (calibration \"isotropic\" or "
                             "\"bending-exact\"), or use kinematics \"least-squares\"")
                       : stable_choice;
  } else if (check.zone.soft_vectors > 0) {
    check.verdict = Verdict::warning;
    check.reason =
        "gear mode: with edges alone, nodes can turn against their neighbours like gears without any energy; "
        "displacements and forces are not affected, rotations are undetermined";
    check.remedy = "use kinematics \"least-squares\" or cell \"cube-II\" or \"cube-III\", or do not read rotations";
  } else if (check.cell.zero_modes_beyond_rigid > 0) {
    check.verdict = Verdict::warning;
    check.reason = fmt::format(
        "a single cell has {} motions without energy besides the six rigid ones: parts one cell "
        "thick may be loose",
        check.cell.zero_modes_beyond_rigid);
    check.remedy = stable_choice;
  }
}

}  // namespace

EnergyRatios energy_ratios(const Springs& springs, double d, Kinematics kinematics, const material::Elastic& elastic) {
  const Eigen::MatrixXd K = cell_matrix(springs, d, kinematics);
  const auto energy = [&](double a, double b, double t) {
    const Eigen::VectorXd q = curved_field(a, b, t, d, kinematics);
    return 0.5 * q.dot(K * q);
  };
  // Continuum densities of theory.md, section 8, times d^2 (curvature squared times area) times the volume d^3.
  const double nu = elastic.poissons_ratio, d5 = std::pow(d, 5);
  const double plate = elastic.youngs_modulus / (1 - nu * nu) / 24 * d5;
  // energy(a, b) = B (a^2 + b^2) + 2 C a b.
  const double B = energy(1, 0, 0), dome = energy(1, 1, 0), C = dome / 2 - B;
  return {B / plate, dome / (plate * 2 * (1 + nu)), energy(1, -1, 0) / (plate * 2 * (1 - nu)),
          B > 0 ? (B - C * C / B) / (plate * (1 - nu * nu)) : 0, energy(0, 0, 1) / (elastic.mu() / 12 * d5)};
}

CellModes cell_modes(const Springs& springs, double d, Kinematics kinematics, material::Sharing sharing, double mu) {
  const int n = components(kinematics);
  Eigen::MatrixXd K = cell_matrix(sharing == material::Sharing::plain ? unshared(springs) : springs, d, kinematics);
  Eigen::VectorXd scale(K.rows());
  for (Eigen::Index row = 0; row < K.rows(); ++row) scale(row) = row % n < 3 ? 1 : 1 / d;
  K = scale.asDiagonal() * K * scale.asDiagonal() / (mu * d);

  const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K, Eigen::EigenvaluesOnly).eigenvalues();
  const double zero = 1e-11 * values.cwiseAbs().maxCoeff();
  CellModes modes;
  modes.least = values(0) < -zero ? values(0) : 0;
  modes.zero_modes_beyond_rigid = static_cast<int>((values.array().abs() <= zero).count()) - 6;
  const auto first = std::find_if(values.begin(), values.end(), [&](double value) { return value > zero; });
  modes.smallest_nonzero = first == values.end() ? 0 : *first;
  return modes;
}

SelfCheck self_check(const Springs& springs, double d, Kinematics kinematics, material::Sharing sharing,
                     const material::Elastic& elastic) {
  SelfCheck check;
  check.target = material::elastic_tensor(elastic);
  check.C = material::lattice_tensor(springs, d);
  double error = 0, largest = 0;
  for (int row = 0; row < 6; ++row)
    for (int column = 0; column < 6; ++column) {
      error = std::max(error, std::abs(check.C.voigt[row][column] - check.target.voigt[row][column]));
      largest = std::max(largest, std::abs(check.target.voigt[row][column]));
    }
  check.C_error = error / largest;
  check.constants = material::engineering_constants(check.C);

  check.energy = energy_ratios(springs, d, kinematics, elastic);
  check.cell = cell_modes(springs, d, kinematics, sharing, elastic.mu());
  const PeriodicLattice lattice(springs, d, kinematics, elastic.density);
  check.zone = scan_zone(lattice);
  check.dispersion = dispersion_table(lattice);
  check.bulk_step = 2 / std::sqrt(check.zone.largest);
  judge(springs, kinematics, check);
  return check;
}

}  // namespace koshi::mechanics
