// The stiffness of one cell: reference eigenvalues, rigid motions, uniform strain, moments.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "koshi/calibration.h"
#include "mechanics/bond_law.h"
#include "mechanics/cell_matrix.h"
#include "support/reference_cells.h"

namespace koshi::mechanics {
namespace {

using material::Kinematics;

/// Unknowns of the corners in the field u(x) = gradient x, rotations half its curl.
Eigen::VectorXd linear_field(const Eigen::Matrix3d& gradient, double d, Kinematics kinematics) {
  const int n = components(kinematics);
  Eigen::VectorXd q = Eigen::VectorXd::Zero(corner_count * n);
  for (int a = 0; a < corner_count; ++a) {
    const auto [x, y, z] = corner(a);
    q.segment<3>(a * n) = gradient * Eigen::Vector3d(x * d, y * d, z * d);
    if (n == 6)
      q.segment<3>(a * n + 3) = 0.5 * Eigen::Vector3d(gradient(2, 1) - gradient(1, 2), gradient(0, 2) - gradient(2, 0),
                                                      gradient(1, 0) - gradient(0, 1));
  }
  return q;
}

// The file prints 10 decimals.
TEST(CellMatrix, ReferenceEigenvalues) {
  int compared = 0;
  for (const auto& reference : test::reference_cells()) {
    const auto springs =
        material::springs_for(reference.cell, reference.calibration, reference.kinematics, reference.elastic, 1);
    const Eigen::MatrixXd K = cell_matrix(springs, 1, reference.kinematics);
    const Eigen::VectorXd found =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K, Eigen::EigenvaluesOnly).eigenvalues();
    ASSERT_EQ(found.size(), static_cast<Eigen::Index>(reference.eigenvalues.size())) << reference.name;
    for (Eigen::Index i = 0; i < found.size(); ++i, ++compared)
      EXPECT_NEAR(found(i), reference.eigenvalues[i], 1e-9) << reference.name << ", eigenvalue " << i;
  }
  EXPECT_EQ(compared, 20 * 48 + 19 * 24);
}

// Energy 1/2 e:C:e d^3 for any uniform strain with any rotation on top, forces summing to zero, and none at all in the
// six rigid motions; d <> 1 so that every power of d counts.
TEST(CellMatrix, UniformStrainAndRigidMotions) {
  const double d = 0.7;
  int checked = 0;
  for (const auto& reference : test::reference_cells()) {
    const auto springs =
        material::springs_for(reference.cell, reference.calibration, reference.kinematics, reference.elastic, d);
    const Eigen::MatrixXd K = cell_matrix(springs, d, reference.kinematics);
    const double scale = K.cwiseAbs().maxCoeff();
    EXPECT_EQ((K - K.transpose()).cwiseAbs().maxCoeff(), 0);

    Eigen::Matrix3d gradient;
    gradient << 0.3, -0.8, 0.1, 0.5, -0.2, 0.9, 0.4, 0.7, 0.6;
    const Eigen::Matrix3d e = 0.5 * (gradient + gradient.transpose());
    // e:C:e = lambda tr(e)^2 + 2 mu e:e, with mu = 1.
    const double density = reference.elastic.lambda() * e.trace() * e.trace() + 2 * e.squaredNorm();
    const Eigen::VectorXd q = linear_field(gradient, d, reference.kinematics);
    EXPECT_NEAR(q.dot(K * q) / (density * d * d * d), 1, 1e-12) << reference.name;

    for (int axis = 0; axis < 3; ++axis) {
      Eigen::VectorXd translation = Eigen::VectorXd::Zero(K.rows());
      for (int a = 0; a < corner_count; ++a) translation(a * components(reference.kinematics) + axis) = 1;
      EXPECT_LT((K * translation).cwiseAbs().maxCoeff(), 1e-14 * scale) << reference.name;
      Eigen::Matrix3d spin = Eigen::Matrix3d::Zero();
      spin((axis + 2) % 3, (axis + 1) % 3) = 1;
      spin((axis + 1) % 3, (axis + 2) % 3) = -1;
      const Eigen::VectorXd rotation = linear_field(spin, d, reference.kinematics);
      EXPECT_LT((K * rotation).cwiseAbs().maxCoeff(), 1e-14 * scale) << reference.name;
      EXPECT_GT((K * rotation.cwiseAbs()).cwiseAbs().maxCoeff(), 1e-3 * scale) << reference.name;
      checked += 2;
    }
  }
  EXPECT_EQ(checked, 39 * 6);
}

// The moments of the bond law (N24) are minus the energy's gradient in the rotations: for one lone bond between corners
// 0 and 7 (body diagonals only, the others unmoved) the matrix gives back bond_force.
TEST(CellMatrix, MomentsOfTheBondLaw) {
  const double d = 1.3;
  material::Springs springs;
  springs.kn[lattice::body] = 2.0;
  springs.kt[lattice::body] = 0.6;
  const Eigen::MatrixXd K = cell_matrix(springs, d, Kinematics::rotational);
  Eigen::VectorXd q = Eigen::VectorXd::Zero(48);
  q.segment<6>(0) << 0.1, -0.2, 0.3, 0.4, 0.5, -0.6;
  q.segment<6>(42) << -0.7, 0.8, 0.9, -0.1, 0.2, 0.35;
  const Vec3 D{-d, -d, -d};
  const Vec3 r = relative_displacement({0.1, -0.2, 0.3}, {-0.7, 0.8, 0.9}, {0.15, 0.35, -0.125}, D);
  const Vec3 F = bond_force(2.0, 0.6, D, r), M = bond_moment(D, F);
  const Eigen::VectorXd force = -K * q;
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(force(i), -F[i], 1e-14);
    EXPECT_NEAR(force(42 + i), F[i], 1e-14);
    EXPECT_NEAR(force(3 + i), M[i], 1e-14);
    EXPECT_NEAR(force(45 + i), M[i], 1e-14);
  }
  EXPECT_NEAR(q.dot(K * q) / 2, bond_energy(2.0, 0.6, D, r), 1e-14);
}

}  // namespace
}  // namespace koshi::mechanics
