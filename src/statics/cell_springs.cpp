#include "statics/cell_springs.h"

#include <Eigen/Eigenvalues>

#include "koshi/error.h"
#include "mechanics/cell_matrix.h"

namespace koshi::statics {

std::array<Eigen::MatrixXd, mechanics::cell_constants> cell_basis(int components) {
  // With d = 2 rotations are unknowns as they are.
  const auto kinematics = components == 6 ? material::Kinematics::rotational : material::Kinematics::least_squares;
  std::array<Eigen::MatrixXd, mechanics::cell_constants> basis;
  for (std::size_t q = 0; q < basis.size(); ++q)
    basis[q] = mechanics::cell_matrix(mechanics::unit_springs[q], 2, kinematics);
  return basis;
}

double relaxation_bound(const CellConstants& constants, int components) {
  const auto basis = cell_basis(components);
  Eigen::MatrixXd K = constants[0] * basis[0];
  for (int q = 1; q < mechanics::cell_constants; ++q) K += constants[q] * basis[q];
  Eigen::MatrixXd blocks = Eigen::MatrixXd::Zero(K.rows(), K.cols());
  for (int a = 0; a < 8; ++a) {
    const Eigen::Index at = a * components;
    blocks.block(at, at, components, components) = K.block(at, at, components, components);
  }
  if (Eigen::LLT<Eigen::MatrixXd>(blocks).info() != Eigen::Success)
    throw InputError("the springs of a cell do not hold its corners; equilibrium needs positive springs");
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> eigen(K, blocks, Eigen::EigenvaluesOnly);
  return eigen.eigenvalues().maxCoeff();
}

}  // namespace koshi::statics
