// Equilibrium by plain conjugate gradients on the force kernel: small, and independent of the static solver.
#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "driver/simulation.h"

namespace koshi::test {

/// A body with its equilibrium under loads and prescribed displacements; the residual falls by `tolerance`.
class Equilibrium {
 public:
  explicit Equilibrium(const model::Definition& definition, double tolerance = 1e-14)
      : simulation_(definition, Communicator::world()), kernel_(simulation_.model().lattice) {
    solve(tolerance);
    measurement_ = simulation_.meter().measure(simulation_.state(), 0);
  }

  const model::Model& model() const { return simulation_.model(); }
  const mechanics::Measurement& measurement() const { return measurement_; }
  mechanics::Meter& meter() { return simulation_.meter(); }
  model::State& state() { return simulation_.state(); }
  const mechanics::ProbeValue& probe(std::size_t p) const { return measurement_.probes[p]; }
  int iterations() const { return iterations_; }
  /// Component c of the node (i, j, k).
  double u(int c, std::int64_t i, std::int64_t j, std::int64_t k) {
    return state().displacement.component(c)[model().layout().index(i, j, k)];
  }

 private:
  using Field = lattice::Field<double>;

  template <class F>
  void for_each_free(F&& f) const {
    for (std::size_t n = 0; n < free_.size(); ++n) f(free_[n]);
  }
  double dot(const Field& a, const Field& b) const {
    double sum = 0;
    for_each_free([&](std::int64_t at) { sum += a.data()[at] * b.data()[at]; });
    return sum;
  }

  void find_free() {
    const int components = model().components();
    Field held(model().layout(), components);
    for (const auto& motion : model().motions) held.component(motion.component)[motion.node] = 1;
    lattice::for_each_owned(model().layout(), [&](auto, auto, auto, auto n) {
      for (int c = 0; c < components; ++c)
        if (model().inertia.component(0)[n] > 0 && held.component(c)[n] == 0) free_.push_back(held.stride() * c + n);
    });
  }

  // Preconditioned by a typical diagonal: the node's mass stands for its number of cells, and rotations carry d^2.
  void solve(double tolerance) {
    find_free();
    const lattice::Layout& layout = model().layout();
    const int components = model().components();
    Field& u = state().displacement;
    Field r(layout, components), z(layout, components), p(layout, components), Ap(layout, components);
    Field inverse(layout, components);
    const double d = model().lattice.grid.d;
    lattice::for_each_owned(layout, [&](auto, auto, auto, auto n) {
      for (int c = 0; c < components; ++c)
        if (model().inertia.component(0)[n] > 0)
          inverse.component(c)[n] = (c < 3 ? 1 : 10 / (d * d)) / model().inertia.component(0)[n];
    });
    for (const auto& motion : model().motions)
      u.component(motion.component)[motion.node] =
          motion.value * model::factor(model().definition.boundaries[static_cast<std::size_t>(motion.boundary)], 1e300);
    kernel_.apply(u, r);
    for (const auto& load : model().loads)
      for (const auto& force : load.forces)
        for (int c = 0; c < 3; ++c) r.component(c)[force.node] += force.force[static_cast<std::size_t>(c)];

    const auto precondition = [&] {
      for_each_free([&](std::int64_t at) { z.data()[at] = inverse.data()[at] * r.data()[at]; });
    };
    precondition();
    p = z;
    double rz = dot(r, z);
    const double goal = tolerance * tolerance * rz;
    while (rz > goal && rz > 0 && iterations_ < 20000) {
      kernel_.apply(p, Ap);
      const double alpha = -rz / dot(p, Ap);
      for_each_free([&](std::int64_t at) {
        u.data()[at] += alpha * p.data()[at];
        r.data()[at] += alpha * Ap.data()[at];
      });
      precondition();
      const double next = dot(r, z);
      for_each_free([&](std::int64_t at) { p.data()[at] = z.data()[at] + next / rz * p.data()[at]; });
      rz = next;
      ++iterations_;
    }
    EXPECT_LT(iterations_, 20000) << "conjugate gradients did not converge";
  }

  driver::Simulation simulation_;
  mechanics::ForceKernel kernel_;
  std::vector<std::int64_t> free_;  ///< positions of the free unknowns in a field
  mechanics::Measurement measurement_;
  int iterations_ = 0;
};

}  // namespace koshi::test
