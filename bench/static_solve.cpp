// Parts of the static solver and whole solutions to 1e-8, in million unknowns per second of processor time; end to end,
// with files: bench/static_study.py.
#include <benchmark/benchmark.h>

#include <random>

#include "koshi/statics.h"
#include "statics/petsc.h"
#include "statics/preconditioner.h"
#include "support/cantilever.h"

namespace koshi {
namespace {

using material::Kinematics;

struct Body {
  const char* name;
  Kinematics kinematics;
  double nu;
  bool mixed;  ///< every third cell or so ten times softer
};

constexpr Body bodies[] = {
    {"cantilever", Kinematics::rotational, 0.18, false},
    {"cantilever, least-squares", Kinematics::least_squares, 0.18, false},
    {"cantilever, nu = 0.45", Kinematics::rotational, 0.45, false},
    {"cantilever, nu = 0.49", Kinematics::rotational, 0.49, false},
    {"cantilever, two phases", Kinematics::rotational, 0.18, true},
};

// The paper's cantilever, `refinement` times finer than 18 x 78 x 18 cells.
model::Definition cantilever(const Body& body, int refinement) {
  model::Definition definition = test::cantilever(0.001 / refinement, body.nu);
  definition.lattice.kinematics = body.kinematics;
  definition.materials.push_back({"soft", {111.2e6, body.nu, 2000}});
  if (body.mixed) {
    std::minstd_rand random;
    for (int n = 0; n < 18 * 78 * 18 * refinement * refinement * refinement; ++n)
      definition.body.cells.push_back(random() % 10 < 3 ? 2 : 1);
  }
  return definition;
}

void count(benchmark::State& state, std::int64_t unknowns) {
  state.counters["Munknowns/s"] = benchmark::Counter(
      1e-6 * static_cast<double>(unknowns) * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

// y = K x in double precision, as conjugate gradients ask for it.
void apply(benchmark::State& state, const Body& body) {
  const model::Model model =
      model::make_model(cantilever(body, static_cast<int>(state.range(0))), Communicator::world());
  lattice::Field<double> work(model.layout(), model.components());
  statics::Equilibrium equilibrium(model, 0, work);
  std::vector<double> x(static_cast<std::size_t>(equilibrium.size()), 1e-6), y(x.size());
  for (auto _ : state) equilibrium.apply(x.data(), y.data());
  count(state, equilibrium.size());
}

// One multigrid cycle.
void cycle(benchmark::State& state, const Body& body) {
  const model::Model model =
      model::make_model(cantilever(body, static_cast<int>(state.range(0))), Communicator::world());
  lattice::Field<double> work(model.layout(), model.components());
  const statics::PetscSession session(model.communicator, {});
  statics::Equilibrium equilibrium(model, 0, work);
  const statics::FreeMotions free(model, equilibrium.fixed());
  statics::Preconditioner preconditioner(model, equilibrium.fixed(), free);
  std::vector<double> r(static_cast<std::size_t>(equilibrium.size()), 1e-6), z(r.size());
  for (auto _ : state) preconditioner.apply(r.data(), z.data());
  count(state, equilibrium.size());
}

void solve(benchmark::State& state, const Body& body) {
  const model::Model model =
      model::make_model(cantilever(body, static_cast<int>(state.range(0))), Communicator::world());
  model::State at(model);
  statics::SolveReport report;
  for (auto _ : state) report = statics::solve_static(model, at, {});
  count(state, report.unknowns);
  state.counters["iterations"] = report.iterations;
}

const bool registered = [] {
  for (const Body& body : bodies) {
    const auto add = [&](const std::string& part, auto* function) {
      benchmark::RegisterBenchmark(("static/" + part + "/" + body.name).c_str(), function, body)
          ->Unit(benchmark::kMillisecond)
          ->Arg(1)
          ->Arg(2)
          ->Arg(4);
    };
    add("operator", apply);
    add("cycle", cycle);
    add("solve", solve);
  }
  return true;
}();

}  // namespace
}  // namespace koshi
