#include "mechanics/stable_step.h"

#include <cmath>
#include <limits>

#include "base/exact_sum.h"

namespace koshi::mechanics {
namespace {

constexpr int iterations = 60;

// A start vector without symmetry that is the same on any partition: a hash of the global node number and component.
double start_value(std::uint64_t node, int component) {
  std::uint64_t h = node * 6 + static_cast<std::uint64_t>(component) + 0x9e3779b97f4a7c15ULL;
  h = (h ^ h >> 30) * 0xbf58476d1ce4e5b9ULL;
  h = (h ^ h >> 27) * 0x94d049bb133111ebULL;
  return static_cast<double>((h ^ h >> 31) >> 11) * 0x1.0p-52 - 1;
}

}  // namespace

StableStep stable_step(const model::Model& model, ForceKernel& kernel) {
  const lattice::Layout& layout = model.layout();
  const lattice::Grid& grid = model.lattice.grid;
  double fastest = 0;
  for (std::size_t m = 1; m < model.materials.size(); ++m) {
    const material::Elastic& e = model.materials[m];
    fastest = std::max(fastest, std::sqrt((e.lambda() + 2 * e.mu()) / e.density));
  }

  lattice::Field<double> x(layout, model.components()), y(layout, model.components());
  const Int3 nodes = grid.nodes();
  lattice::for_each_owned(layout, [&](auto i, auto j, auto k, auto n) {
    if (model.inertia.component(0)[n] == 0) return;
    const Int3 g = layout.global({i, j, k});
    for (int c = 0; c < model.components(); ++c)
      x.component(c)[n] =
          start_value(static_cast<std::uint64_t>(g[0] + nodes[0] * (g[1] + nodes[1] * g[2])), c) / (c < 3 ? 1 : grid.d);
  });

  // x <- M^-1 K x, scaled by its largest component; the Rayleigh quotient x.Kx / x.Mx comes last.
  double lambda = 0;
  for (int iteration = 0; iteration < iterations; ++iteration) {
    kernel.apply(x, y);
    const bool last = iteration + 1 == iterations;
    double largest = 0;
    ExactSum stiffness, mass;
    lattice::for_each_owned(layout, [&](auto, auto, auto, auto n) {
      if (model.inertia.component(0)[n] == 0) return;
      double xKx = 0, xMx = 0;
      for (int c = 0; c < model.components(); ++c) {
        const double m = model.inertia.component(c < 3 ? 0 : 1)[n];
        xKx -= x.component(c)[n] * y.component(c)[n];
        xMx += x.component(c)[n] * m * x.component(c)[n];
        x.component(c)[n] = -y.component(c)[n] / m;
        largest = std::max(largest, std::abs(x.component(c)[n]) * (c < 3 ? 1 : grid.d));
      }
      if (!last) return;
      stiffness += xKx;
      mass += xMx;
    });
    if (last) {
      stiffness.sum_ranks(model.communicator);
      mass.sum_ranks(model.communicator);
      lambda = stiffness.value() / mass.value();
      break;
    }
    const double scale = model.communicator.max(largest);
    if (!(scale > 0)) break;
    for (std::size_t n = 0; n < x.count(); ++n) x.data()[n] /= scale;
  }
  const model::DampingDefinition& damping = model.definition.analysis.damping;
  const double alpha = damping.kind == model::DampingDefinition::Kind::local ? damping.factor : 0;
  const double frequency = lambda > 0 ? 2 / std::sqrt((1 + alpha) * lambda) : std::numeric_limits<double>::infinity();
  return {grid.d / fastest, frequency};
}

}  // namespace koshi::mechanics
