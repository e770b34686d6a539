#include "statics/coarse_solver.h"

#include <vector>

#include "statics/cell_springs.h"

namespace koshi::statics {
namespace {

// Rows of the matrix: component fastest, then nodes x fastest.
PetscInt number(const Level& level, const Int3& node, int component) {
  const Int3& n = level.grid().owned();
  return static_cast<PetscInt>(component + level.components() * (node[0] + n[0] * (node[1] + n[1] * node[2])));
}

// Adds the matrices of all cells; rows of fixed components are left out.
void add_cells(const Level& level, const std::vector<bool>& held, Mat matrix) {
  const auto basis = cell_basis(level.components());
  const Int3& n = level.grid().owned();
  const lattice::Grid& grid = level.grid().grid;
  const int size = 8 * level.components();
  Eigen::MatrixXd K;
  std::vector<PetscInt> at(static_cast<std::size_t>(size));
  for (std::int64_t k = 0; k < n[2]; ++k)
    for (std::int64_t j = 0; j < n[1]; ++j) {
      const std::int32_t row = level.springs().row(j, k);
      for (std::int64_t i = std::max(level.springs().span(row).first, 0); i < level.springs().span(row).last; ++i) {
        K = Eigen::MatrixXd::Zero(size, size);
        for (int q = 0; q < mechanics::cell_constants; ++q) K += level.springs().constant(row, i, q) * basis[q];
        for (int corner = 0; corner < 8; ++corner) {
          Int3 node{i + (corner & 1), j + (corner >> 1 & 1), k + (corner >> 2)};
          for (int a = 0; a < 3; ++a)
            if (grid.periodic[a]) node[a] %= n[a];
          for (int c = 0; c < level.components(); ++c) {
            const PetscInt index = number(level, node, c);
            // Negative indices are skipped.
            at[static_cast<std::size_t>(corner * level.components() + c)] =
                held[static_cast<std::size_t>(index)] ? -1 : index;
          }
        }
        check(MatSetValues(matrix, size, at.data(), size, at.data(), K.data(), ADD_VALUES));
      }
    }
}

// Adds what holds single nodes.
void add_springs(const Level& level, const std::vector<bool>& held, Mat matrix) {
  for (const FixedNode& node : level.fixed())
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) {
        const PetscInt row = number(level, node.node, a), column = number(level, node.node, b);
        if (held[static_cast<std::size_t>(row)] || held[static_cast<std::size_t>(column)]) continue;
        if (node.stiffness(a, b) != 0) check(MatSetValue(matrix, row, column, node.stiffness(a, b), ADD_VALUES));
      }
}

}  // namespace

CoarseSolver::CoarseSolver(const Level& level, double shift) {
  const Int3& n = level.grid().owned();
  const auto size = static_cast<PetscInt>(n[0] * n[1] * n[2] * level.components());
  std::vector<bool> held(static_cast<std::size_t>(size), false);
  for (const FixedNode& fixed : level.fixed())
    for (int c = 0; c < level.components(); ++c)
      if (fixed.mask >> c & 1) held[static_cast<std::size_t>(number(level, fixed.node, c))] = true;

  check(MatCreateSeqAIJ(PETSC_COMM_SELF, size, size, std::min<PetscInt>(27 * level.components(), size), nullptr,
                        matrix_.create()));
  add_cells(level, held, matrix_);
  add_springs(level, held, matrix_);
  for (PetscInt i = 0; i < size; ++i) check(MatSetValue(matrix_, i, i, 0, ADD_VALUES));
  check(MatAssemblyBegin(matrix_, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(matrix_, MAT_FINAL_ASSEMBLY));

  // Rows without any spring become 1, the others get the shift.
  check(MatCreateVecs(matrix_, x_.create(), b_.create()));
  check(MatGetDiagonal(matrix_, b_));
  PetscScalar* diagonal = nullptr;
  check(VecGetArray(b_, &diagonal));
  for (PetscInt i = 0; i < size; ++i) diagonal[i] = diagonal[i] == 0 ? 1 : diagonal[i] * (1 + shift);
  check(VecRestoreArray(b_, &diagonal));
  check(MatDiagonalSet(matrix_, b_, INSERT_VALUES));
  check(MatSetOption(matrix_, MAT_SPD, PETSC_TRUE));

  check(KSPCreate(PETSC_COMM_SELF, solver_.create()));
  check(KSPSetOptionsPrefix(solver_, "coarse_"));
  check(KSPSetOperators(solver_, matrix_, matrix_));
  check(KSPSetType(solver_, KSPPREONLY));
  PC pc = nullptr;
  check(KSPGetPC(solver_, &pc));
  check(PCSetType(pc, PCCHOLESKY));
#if defined(PETSC_HAVE_SUITESPARSE)
  check(PCFactorSetMatSolverType(pc, MATSOLVERCHOLMOD));
#endif
  check(KSPSetFromOptions(solver_));
  check(KSPSetUp(solver_));
}

void CoarseSolver::solve(Level& level) {
  const Int3& n = level.grid().owned();
  const int components = level.components();
  PetscScalar* b = nullptr;
  check(VecGetArray(b_, &b));
  for (std::int64_t k = 0; k < n[2]; ++k)
    for (std::int64_t j = 0; j < n[1]; ++j)
      for (int c = 0; c < components; ++c) {
        const float* const from = level.b.row(j, k) + c * level.b.pitch();
        for (std::int64_t i = 0; i < n[0]; ++i) b[number(level, {i, j, k}, c)] = from[i];
      }
  check(VecRestoreArray(b_, &b));
  check(KSPSolve(solver_, b_, x_));
  const PetscScalar* x = nullptr;
  check(VecGetArrayRead(x_, &x));
  for (std::int64_t k = 0; k < n[2]; ++k)
    for (std::int64_t j = 0; j < n[1]; ++j)
      for (int c = 0; c < components; ++c) {
        float* const to = level.x.row(j, k) + c * level.x.pitch();
        for (std::int64_t i = 0; i < n[0]; ++i) to[i] = static_cast<float>(x[number(level, {i, j, k}, c)]);
      }
  check(VecRestoreArrayRead(x_, &x));
}

}  // namespace koshi::statics
