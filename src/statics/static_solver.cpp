#include "statics/static_solver.h"

#include <algorithm>
#include <exception>

#include "base/out_of_memory.h"
#include "base/progress.h"
#include "statics/ending.h"
#include "statics/exact_vectors.h"

namespace koshi::statics {
namespace {

// Rounding ends what a residual can reach at about this part of the forces that made the displacements.
constexpr double rounding = 1e-12;

/// What the callbacks from PETSc need; exceptions wait here until PETSc has returned.
struct Context {
  Equilibrium& equilibrium;
  Preconditioner& preconditioner;
  const StaticOptions& options;
  SolveReport& report;
  double reference = 0;
  std::exception_ptr error;
  bool stopped = false;
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
  const PetscErrorCode code = guarded(context, [&] {
    const double relative = context.reference > 0 ? residual / context.reference : 0;
    context.report.residual_history.push_back(relative);
    if (context.options.progress) context.options.progress(static_cast<int>(iteration), relative);
    context.stopped = context.options.stop && context.options.stop();
  });
  // An error is what ends the iterations from here; the solution so far stays in its vector.
  return context.stopped ? PETSC_ERR_USER : code;
}

}  // namespace

StaticSolver::StaticSolver(const model::Model& model, double t, lattice::Field<double>& work,
                           const StaticOptions& options)
    : model_(model),
      options_(options),
      start_(steady_seconds()),
      session_(model.communicator, options.petsc_options),
      equilibrium_(model, t, work),
      free_(model, equilibrium_.fixed()),
      preconditioner_(while_making("the levels of the solver", [&] {
        return std::make_unique<Preconditioner>(model, equilibrium_.fixed(), free_);
      })) {
  setup_seconds_ = steady_seconds() - start_;
}

void StaticSolver::refresh() {
  // The old one goes first: two need twice the memory.
  preconditioner_.reset();
  preconditioner_ = std::make_unique<Preconditioner>(model_, equilibrium_.fixed(), free_);
}

SolveReport StaticSolver::solve(double* right_hand_side, double absolute, lattice::Field<double>& displacement,
                                bool from_there) {
  SolveReport report;
  const double start = steady_seconds();
  report.projected_motions = free_.count();
  report.free_motions = free_.description();
  report.levels = preconditioner_->level_count();
  report.unknowns = model_.node_count * model_.components() - model_.motion_count;

  const MPI_Comm comm = MPI_Comm_f2c(model_.communicator.handle());
  Context context{equilibrium_, *preconditioner_, options_, report, 0, nullptr, false};
  const auto size = static_cast<PetscInt>(equilibrium_.size());
  PetscMat matrix;
  check(MatCreateShell(comm, size, size, PETSC_DETERMINE, PETSC_DETERMINE, &context, matrix.create()));
  check(MatShellSetOperation(matrix, MATOP_MULT, reinterpret_cast<void (*)()>(apply_operator)));
  check(MatSetOption(matrix, MAT_SPD, PETSC_TRUE));
  PetscVec x, b;
  check(VecCreateMPIWithArray(comm, 1, size, PETSC_DETERMINE, right_hand_side, b.create()));
  // All vectors of the iteration are copies of b: one that PETSc makes for a single rank would not inherit the sums.
  use_exact_sums(b);
  check(VecDuplicate(b, x.create()));
  free_.project(right_hand_side);
  check(VecNorm(b, NORM_2, &context.reference));
  if (from_there) {
    // Loads that go back to zero leave displacements of rounding size, which no longer have a scale of their own.
    largest_ = std::max(largest_, context.reference);
    absolute = rounding * largest_;
    context.reference = std::max(context.reference, absolute / options_.tolerance);
  }

  PetscKsp solver;
  check(KSPCreate(comm, solver.create()));
  check(KSPSetOperators(solver, matrix, matrix));
  check(KSPSetType(solver, KSPCG));
  check(KSPSetNormType(solver, KSP_NORM_UNPRECONDITIONED));
  // Strong contrasts: while a stiff part finds its place in a soft one the residual may rise by orders of magnitude.
  check(KSPSetTolerances(solver, options_.tolerance, absolute > 0 ? absolute : PETSC_DEFAULT, 1e30,
                         options_.max_iterations));
  PC pc = nullptr;
  check(KSPGetPC(solver, &pc));
  check(PCSetType(pc, PCSHELL));
  check(PCShellSetContext(pc, &context));
  check(PCShellSetApply(pc, apply_preconditioner));
  check(KSPMonitorSet(solver, monitor, &context, nullptr));
  check(KSPSetFromOptions(solver));
  if (from_there) {
    PetscScalar* start_values = nullptr;
    check(VecGetArrayWrite(x, &start_values));
    equilibrium_.gather(displacement, start_values);
    check(VecRestoreArrayWrite(x, &start_values));
    check(KSPSetInitialGuessNonzero(solver, PETSC_TRUE));
  }
  report.setup_seconds = setup_seconds_ + steady_seconds() - start;

  const PetscErrorCode code = KSPSolve(solver, b, x);
  if (context.error) std::rethrow_exception(context.error);
  if (!context.stopped) while_making("the vectors of the solver", [&] { check(code); });
  report.solve_seconds = steady_seconds() - start - (report.setup_seconds - setup_seconds_);

  PetscInt iterations = 0;
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  check(KSPGetIterationNumber(solver, &iterations));
  check(KSPGetConvergedReason(solver, &reason));
  report.iterations = static_cast<int>(iterations);
  report.relative_residual = report.residual_history.empty() ? 0 : report.residual_history.back();
  report.stopped = context.stopped;
  report.converged = reason > 0 && !report.stopped;
  report.reason = report.stopped ? "stopped" : end_in_words(reason);
  report.unused_options = session_.unused_options();
  if (!report.converged && !report.stopped) throw no_equilibrium(model_, report, reason);

  const PetscScalar* solution = nullptr;
  check(VecGetArrayRead(x, &solution));
  equilibrium_.fill(solution, displacement);
  check(VecRestoreArrayRead(x, &solution));
  model_.lattice.halo->exchange(displacement);
  return report;
}

}  // namespace koshi::statics
