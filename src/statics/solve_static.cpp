#include "koshi/statics.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>

#include "statics/cell_springs.h"
#include "statics/equilibrium.h"
#include "statics/free_motions.h"
#include "statics/multigrid.h"
#include "statics/petsc.h"

namespace koshi::statics {
namespace {

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

// The time at which all histories and ramps have ended, or the duration asked for.
double end_time(const model::Definition& definition) {
  if (definition.analysis.duration) return *definition.analysis.duration;
  double t = 0;
  const auto last = [&t](const model::History& history) {
    if (!history.empty()) t = std::max(t, history.back()[0]);
  };
  for (const auto& load : definition.loads) last(load.history);
  for (const auto& boundary : definition.boundaries) {
    last(boundary.history);
    t = std::max(t, boundary.ramp);
  }
  return t;
}

// What the preconditioner takes for each material. Edges alone leave node rotations a checkerboard that costs nothing,
// and coarse levels would fall for it: face diagonals with a tenth of their shear stiffness hold it.
std::vector<CellConstants> preconditioner_constants(const model::SpringLattice& body) {
  std::vector<CellConstants> by_material;
  for (const material::Springs& springs : body.springs) {
    CellConstants& k = by_material.emplace_back(cell_constants(springs, body.grid.d));
    if (springs.kt[1] == 0 && springs.kt[2] == 0) k[3] = 0.1 * k[1];
  }
  return by_material;
}

// Constants of all cells, scaled so that the stiffest is 1: single precision then serves any unit.
RowField<float> fine_constants(const model::SpringLattice& body, const std::vector<CellConstants>& by_material) {
  double largest = 0;
  for (const CellConstants& constants : by_material)
    for (const double k : constants) largest = std::max(largest, std::abs(k));
  RowField<float> constants(body.layout.owned(), mechanics::cell_constants);
  const std::uint8_t* const cell = body.cell.component(0);
  lattice::for_each(body.layout, {-1, -1, -1}, body.layout.owned(), [&](auto i, auto j, auto k, auto n) {
    if (cell[n] == 0) return;
    for (int q = 0; q < mechanics::cell_constants; ++q)
      constants.row(j, k)[q * constants.pitch() + i] = static_cast<float>(by_material[cell[n]][q] / largest);
  });
  return constants;
}

/// The preconditioner between PETSc's vectors and the hierarchy.
class Preconditioner {
 public:
  Preconditioner(const model::Model& model, const FixedNodes& fixed, const FreeMotions& free)
      : components_(model.components()), free_(free) {
    const model::SpringLattice& body = model.lattice;
    const auto by_material = preconditioner_constants(body);
    CycleOptions options;
    for (std::size_t m = 1; m < by_material.size(); ++m)
      options.bound = std::max(options.bound, relaxation_bound(by_material[m], components_));
    options.shift = free.count() > 0 ? 1e-8 : 0;
    // Nearly incompressible springs have a wide spectrum that the relaxation must cover.
    options.degree = options.bound < 4 ? 3 : options.bound < 6 ? 4 : 5;
    hierarchy_ = std::make_unique<Hierarchy>(LevelGrid{body.grid, body.partition, body.halo}, components_,
                                             fine_constants(body, by_material), fixed, options);
  }

  void apply(const double* r, double* z) {
    Level& level = hierarchy_->finest();
    transfer(level.b, [&](float& to, std::int64_t at) { to = static_cast<float>(r[at]); });
    hierarchy_->cycle();
    transfer(level.x, [&](float& from, std::int64_t at) { z[at] = from; });
    free_.project(z);
  }

  int level_count() const { return hierarchy_->level_count(); }

 private:
  template <class F>
  void transfer(RowField<float>& field, F&& copy) {
    const Int3& n = field.owned();
    std::int64_t at = 0;
    for (int c = 0; c < components_; ++c)
      for (std::int64_t k = 0; k < n[2]; ++k)
        for (std::int64_t j = 0; j < n[1]; ++j) {
          float* const row = field.row(j, k) + c * field.pitch();
          for (std::int64_t i = 0; i < n[0]; ++i) copy(row[i], at++);
        }
  }

  int components_;
  const FreeMotions& free_;
  std::unique_ptr<Hierarchy> hierarchy_;
};

/// What the callbacks from PETSc need; exceptions wait here until PETSc has returned.
struct Context {
  Equilibrium& equilibrium;
  Preconditioner& preconditioner;
  const StaticOptions& options;
  SolveReport& report;
  double reference = 0;
  std::exception_ptr error;
};

template <class F>
PetscErrorCode guarded(Context& context, F&& work) {
  try {
    work();
    return 0;
  } catch (...) {
    context.error = std::current_exception();
    return PETSC_ERR_USER;
  }
}

template <class F>
PetscErrorCode on_arrays(Vec x, Vec y, F&& work) {
  const PetscScalar* from = nullptr;
  PetscScalar* to = nullptr;
  VecGetArrayRead(x, &from);
  VecGetArray(y, &to);
  work(from, to);
  VecRestoreArray(y, &to);
  return VecRestoreArrayRead(x, &from);
}

PetscErrorCode apply_operator(Mat matrix, Vec x, Vec y) {
  Context* context = nullptr;
  MatShellGetContext(matrix, &context);
  return guarded(*context, [&] {
    on_arrays(x, y, [&](const double* from, double* to) { context->equilibrium.apply(from, to); });
  });
}

PetscErrorCode apply_preconditioner(PC pc, Vec r, Vec z) {
  Context* context = nullptr;
  PCShellGetContext(pc, &context);
  return guarded(*context, [&] {
    on_arrays(r, z, [&](const double* from, double* to) { context->preconditioner.apply(from, to); });
  });
}

PetscErrorCode monitor(KSP, PetscInt iteration, PetscReal residual, void* data) {
  Context& context = *static_cast<Context*>(data);
  return guarded(context, [&] {
    const double relative = context.reference > 0 ? residual / context.reference : 0;
    context.report.residual_history.push_back(relative);
    if (context.options.progress) context.options.progress(static_cast<int>(iteration), relative);
  });
}

std::string history_text(const std::vector<double>& history) {
  std::string text;
  const std::size_t step = std::max<std::size_t>(1, history.size() / 10);
  for (std::size_t i = 0; i < history.size(); i += step) text += fmt::format(" {}: {:.1e}", i, history[i]);
  return text;
}

}  // namespace

SolveReport solve_static(const model::Model& model, model::State& state, const StaticOptions& options) {
  SolveReport report;
  const double start = now();
  state.time = end_time(model.definition);
  state.velocity.zero();
  const PetscSession session(model.communicator, options.petsc_options);
  Equilibrium equilibrium(model, state.time, state.displacement);
  const FreeMotions free(model, equilibrium.fixed());
  Preconditioner preconditioner(model, equilibrium.fixed(), free);
  report.projected_motions = free.count();
  report.levels = preconditioner.level_count();
  report.unknowns = model.node_count * model.components() - model.motion_count;

  const MPI_Comm comm = MPI_Comm_f2c(model.communicator.handle());
  Context context{equilibrium, preconditioner, options, report, 0, nullptr};
  const auto size = static_cast<PetscInt>(equilibrium.size());
  PetscMat matrix;
  check(MatCreateShell(comm, size, size, PETSC_DETERMINE, PETSC_DETERMINE, &context, matrix.create()));
  check(MatShellSetOperation(matrix, MATOP_MULT, reinterpret_cast<void (*)()>(apply_operator)));
  check(MatSetOption(matrix, MAT_SPD, PETSC_TRUE));
  PetscVec x, b;
  check(MatCreateVecs(matrix, x.create(), b.create()));
  PetscScalar* values = nullptr;
  check(VecGetArray(b, &values));
  equilibrium.right_hand_side(values);
  free.require_balance(values);
  free.project(values);
  check(VecRestoreArray(b, &values));
  check(VecNorm(b, NORM_2, &context.reference));

  PetscKsp solver;
  check(KSPCreate(comm, solver.create()));
  check(KSPSetOperators(solver, matrix, matrix));
  check(KSPSetType(solver, KSPCG));
  check(KSPSetNormType(solver, KSP_NORM_UNPRECONDITIONED));
  check(KSPSetTolerances(solver, options.tolerance, PETSC_DEFAULT, PETSC_DEFAULT, options.max_iterations));
  PC pc = nullptr;
  check(KSPGetPC(solver, &pc));
  check(PCSetType(pc, PCSHELL));
  check(PCShellSetContext(pc, &context));
  check(PCShellSetApply(pc, apply_preconditioner));
  check(KSPMonitorSet(solver, monitor, &context, nullptr));
  check(KSPSetFromOptions(solver));
  check(KSPSetUp(solver));
  report.setup_seconds = now() - start;

  const PetscErrorCode code = KSPSolve(solver, b, x);
  if (context.error) std::rethrow_exception(context.error);
  check(code);
  report.solve_seconds = now() - start - report.setup_seconds;

  PetscInt iterations = 0;
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  check(KSPGetIterationNumber(solver, &iterations));
  check(KSPGetConvergedReason(solver, &reason));
  report.iterations = static_cast<int>(iterations);
  report.relative_residual = report.residual_history.empty() ? 0 : report.residual_history.back();
  report.converged = reason > 0;
  report.reason = KSPConvergedReasons[reason];
  if (!report.converged)
    throw RunError(fmt::format("no equilibrium found: {} after {} iterations, relative residual{}", report.reason,
                               report.iterations, history_text(report.residual_history)));

  const PetscScalar* solution = nullptr;
  check(VecGetArrayRead(x, &solution));
  equilibrium.fill(solution, state.displacement);
  check(VecRestoreArrayRead(x, &solution));
  model.lattice.halo->exchange(state.displacement);
  return report;
}

}  // namespace koshi::statics
