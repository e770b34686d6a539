#include "koshi/modes.h"

#include <Eigen/Eigenvalues>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "base/progress.h"
#include "lattice/halo.h"
#include "modes/eigen_search.h"
#include "modes/mass_figures.h"
#include "statics/petsc.h"

namespace koshi::modes {
namespace {

constexpr int most_below = 200;  // modes that may be found on the way to those near a frequency

// Free components of all nodes.
std::int64_t unknowns(const model::Model& model) { return model.node_count * model.components() - model.motion_count; }

// Modes that the body has; refuses a body or a count that make no sense.
std::int64_t modes_there(const model::Model& model, const statics::FreeMotions& free,
                         const model::AnalysisDefinition& analysis) {
  const model::Places& places = model.definition.places;
  if (free.part_count() > 1 && free.free_part_count() > 0 && !analysis.allow_floating)
    throw InputError(
        places.find("analysis.type"),
        fmt::format("the body falls into {} parts, and {}; each part vibrates by itself: remove what floats "
                    "or hold it, or set allow_floating = true in [analysis] for the modes of all parts "
                    "together",
                    free.part_count(), free.description()));
  const std::int64_t most = unknowns(model) - free.count();
  if (analysis.count > most)
    throw InputError(places.find("analysis.count"),
                     fmt::format("count is {}, but the body has {} modes ({} free components, {} rigid motions)",
                                 analysis.count, most, unknowns(model), free.count()));
  return most;
}

// A few vectors more than wanted: those at the edge of a block converge slowly, and equal frequencies come together.
int width_for(int count, std::int64_t most) {
  return static_cast<int>(std::min<std::int64_t>(most, count + std::max(2, count / 5)));
}

/// Modes of equal frequency, of which any combination is one too.
struct Cluster {
  int first, count;
};

// Turns equal modes so that the kinetic energy in x, y and z differs as much as it can: a square beam then bends along
// its sides, and the result does not depend on where the search started. The sign follows a fixed noise.
void settle(const model::Model& model, Vibration& vibration, EigenSearch& search, double tolerance) {
  const auto nodes = static_cast<std::size_t>(model.layout().owned_count());
  const double equal = std::max(1e-6, 10 * tolerance);
  std::vector<Cluster> clusters;
  for (int j = 0; j < search.width(); ++j) {
    const bool joins = j > 0 && search.lambda(j) - search.lambda(j - 1) <= equal * search.lambda(j);
    if (joins)
      ++clusters.back().count;
    else
      clusters.push_back({j, 1});
  }
  for (const Cluster& cluster : clusters) {
    if (cluster.count == 1) continue;
    Eigen::MatrixXd energy = Eigen::MatrixXd::Zero(cluster.count, cluster.count);
    for (int a = 0; a < cluster.count; ++a)
      for (int b = 0; b <= a; ++b) {
        const double *p = search.vector(cluster.first + a), *q = search.vector(cluster.first + b);
        for (std::size_t c = 0; c < 3; ++c)
          for (std::size_t n = 0; n < nodes; ++n)
            energy(a, b) += static_cast<double>(c + 1) * p[c * nodes + n] * q[c * nodes + n];
      }
    energy = summed(energy, model.communicator);
    search.turn(cluster.first, Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(energy).eigenvectors());
  }
  std::vector<double> noise(static_cast<std::size_t>(vibration.size()));
  vibration.start(0, true, noise.data());
  for (int j = 0; j < search.width(); ++j) {
    double* const y = search.vector(j);
    Eigen::MatrixXd product = Eigen::MatrixXd::Zero(1, 1);
    for (std::size_t i = 0; i < noise.size(); ++i) product(0, 0) += noise[i] * y[i];
    if (summed(product, model.communicator)(0, 0) < 0)
      for (std::size_t i = 0; i < noise.size(); ++i) y[i] = -y[i];
  }
}

}  // namespace

std::string free_motions(const model::Model& model, const model::AnalysisDefinition& analysis) {
  lattice::Field<double> none;
  const statics::Equilibrium equilibrium(model, 0, none);
  const statics::FreeMotions free(model, equilibrium.fixed());
  modes_there(model, free, analysis);
  return free.description();
}

ModesReport find_modes(const model::Model& model, const ModesOptions& options) {
  const double start = steady_seconds();
  const model::AnalysisDefinition& analysis = model.definition.analysis;
  const statics::PetscSession session(model.communicator, {});
  lattice::Field<double> work(model.layout(), model.components());
  Vibration vibration(model, work);
  const std::int64_t most = modes_there(model, vibration.free(), analysis);
  ModesReport report;
  report.unknowns = unknowns(model);
  report.levels = vibration.preconditioner().level_count();
  report.projected_motions = vibration.free().count();
  report.free_motions = vibration.free().description();
  const auto frequency = [&](double lambda) {
    return std::sqrt(std::max(0.0, vibration.omega_squared(lambda))) / (2 * std::numbers::pi);
  };

  // The lowest modes; near a frequency, as many of them as show that no other lies closer.
  EigenSearch::Goal goal;
  goal.count = analysis.count;
  goal.residual = std::sqrt(analysis.tolerance);
  goal.max_iterations = options.max_iterations;
  goal.progress = options.progress;
  auto search = std::make_unique<EigenSearch>(vibration, model.communicator, width_for(goal.count, most));
  report.setup_seconds = steady_seconds() - start;
  int first = 0;
  for (;;) {
    if (!search->run(goal)) {
      report.stopped = true;
      return report;
    }
    report.iterations += search->iterations();
    // The window of `count` modes whose farthest one is closest to the frequency.
    const auto distance = [&](int j) { return std::abs(frequency(search->lambda(j)) - analysis.near); };
    while (first + analysis.count < goal.count && distance(first + analysis.count) < distance(first)) ++first;
    const bool certain = analysis.near == 0 || goal.count == most || first + analysis.count < goal.count ||
                         distance(first) <= frequency(search->lambda(goal.count - 1)) - analysis.near;
    if (certain) break;
    if (goal.count >= most_below)
      throw RunError(
          fmt::format("the {} lowest modes reach {:.6g} Hz, short of those near {:.6g} Hz; modes are found from the "
                      "lowest on, and at "
                      "most {} of them: choose a lower frequency",
                      goal.count, frequency(search->lambda(goal.count - 1)), analysis.near, most_below));
    goal.count = static_cast<int>(
        std::min<std::int64_t>({most, most_below, goal.count + std::max(analysis.count, goal.count / 2)}));
    search = std::make_unique<EigenSearch>(vibration, model.communicator, width_for(goal.count, most), search.get());
  }
  report.searched = goal.count;
  settle(model, vibration, *search, analysis.tolerance);

  const MassFigures figures(model, vibration);
  report.centre_of_mass = figures.centre();
  report.total_effective_mass = figures.total();
  report.rigid_effective_mass = figures.rigid();
  for (int j = first; j < first + analysis.count; ++j) {
    Mode& mode = report.modes.emplace_back();
    mode.number = j + 1;
    mode.frequency = frequency(search->lambda(j));
    mode.residual = search->residual(j);
    figures.measure(search->vector(j), mode);
  }
  report.solve_seconds = steady_seconds() - start - report.setup_seconds;
  return report;
}

void fill(const model::Model& model, const Mode& mode, lattice::Field<double>& displacement) {
  displacement.zero();
  const auto nodes = static_cast<std::size_t>(model.layout().owned_count());
  std::size_t at = 0;
  lattice::for_each_owned(model.layout(), [&](auto, auto, auto, auto n) {
    for (int c = 0; c < model.components(); ++c)
      displacement.component(c)[n] = mode.shape[at + static_cast<std::size_t>(c) * nodes];
    ++at;
  });
  model.lattice.halo->exchange(displacement);
}

}  // namespace koshi::modes
