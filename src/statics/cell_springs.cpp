#include "statics/cell_springs.h"

#include <Eigen/Eigenvalues>

#include <vector>

#include "koshi/error.h"

namespace koshi::statics {

CellConstants cell_constants(const material::Springs& springs, double d) {
  const auto& kn = springs.kn;
  const auto& kt = springs.kt;
  return {kn[0] / 16,           kt[0] / 16, (kn[1] - kt[1]) / 16,  kt[1] / 8,
          (kn[2] - kt[2]) / 12, kt[2] / 4,  springs.kappa * d / 16};
}

std::array<Eigen::MatrixXd, mechanics::cell_constants> cell_basis(int components) {
  // One cell between four rows of two nodes; the rows have room for the kernel's vectors.
  constexpr std::ptrdiff_t pitch = 32;
  const std::ptrdiff_t row_size = components * pitch;
  std::vector<double> u(static_cast<std::size_t>(4 * row_size)), force(u.size()),
      constants(mechanics::cell_constants * pitch);
  mechanics::CellRow<double> row{constants.data(), pitch, {}, pitch, {}, pitch};
  for (int r = 0; r < 4; ++r) {
    row.u[r] = u.data() + r * row_size;
    row.force[r] = force.data() + r * row_size;
  }
  const auto at = [&](int corner, int component) {
    return static_cast<std::size_t>((corner >> 1) * row_size + component * pitch + (corner & 1));
  };
  const auto& kernels = mechanics::cell_kernels<double>();
  std::array<Eigen::MatrixXd, mechanics::cell_constants> basis;
  for (int q = 0; q < mechanics::cell_constants; ++q) {
    basis[q] = Eigen::MatrixXd::Zero(8 * components, 8 * components);
    constants[static_cast<std::size_t>(q * pitch)] = 1;
    for (int column = 0; column < 8 * components; ++column) {
      std::fill(force.begin(), force.end(), 0.0);
      u[at(column / components, column % components)] = 1;
      (components == 6 ? kernels.rotational : kernels.least_squares)(row, 0, 1);
      u[at(column / components, column % components)] = 0;
      for (int i = 0; i < 8 * components; ++i) basis[q](i, column) = -force[at(i / components, i % components)];
    }
    constants[static_cast<std::size_t>(q * pitch)] = 0;
  }
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
