#include <algorithm>

#include "dynamics/orientation.h"
#include "dynamics/row_update.h"
#include "koshi/dynamics.h"
#include "lattice/halo.h"
#include "mechanics/force_kernel.h"
#include "mechanics/loads.h"

namespace koshi::dynamics {
namespace {

Kick make_kick(const model::DampingDefinition& damping, double dt) {
  using Kind = model::DampingDefinition::Kind;
  const double c = damping.kind == Kind::viscous ? 0.5 * damping.rate * dt : 0;
  return {(1 - c) / (1 + c), dt / (1 + c), damping.kind == Kind::local ? damping.factor : 0};
}

lattice::Field<double> inverse(const lattice::Layout& layout, const lattice::Field<double>& inertia) {
  lattice::Field<double> result(layout, inertia.components());
  for (int c = 0; c < inertia.components(); ++c)
    lattice::for_each_owned(layout, [&](auto, auto, auto, auto n) {
      if (inertia.component(c)[n] > 0) result.component(c)[n] = 1 / inertia.component(c)[n];
    });
  return result;
}

// Rows of nodes in y whose displacements on three planes and velocities on two stay in the second-level cache.
std::int64_t rows_in_cache(const model::Model& model) {
  constexpr std::int64_t cache = 768 * 1024;
  const std::int64_t row = static_cast<std::int64_t>(sizeof(double)) * model.components() * model.layout().pitch();
  return std::max<std::int64_t>(4, (cache / row - 6) / 5);
}

}  // namespace

struct ExplicitSolver::Implementation {
  const model::Model& model;
  model::State& state;
  const double dt;
  const Kick kick;
  const RowUpdate& update = row_update();
  mechanics::ForceKernel<double> kernel;
  mechanics::LoadRows loads;
  mechanics::RowIndex motion_rows;
  lattice::Field<double> inverse_inertia;
  const std::int64_t block_rows;
  const double origin;  // time of step 0: times are origin + step dt, so that they do not gather rounding

  Implementation(const model::Model& m, model::State& s, double step)
      : model(m),
        state(s),
        dt(step),
        kick(make_kick(m.definition.analysis.damping, step)),
        kernel(m.lattice),
        loads(m),
        motion_rows(m.layout(), m.motions, [](const model::PrescribedMotion& p) { return p.node; }),
        inverse_inertia(inverse(m.layout(), m.inertia)),
        block_rows(rows_in_cache(m)),
        origin(s.time - static_cast<double>(s.step) * step) {
    if (state.step == 0 && state.time == 0) take_initial_displacements();
  }

  double factor(const model::PrescribedMotion& motion, double t) const {
    return model::factor(model.definition.boundaries[static_cast<std::size_t>(motion.boundary)], t);
  }

  void take_initial_displacements() {
    for (const model::PrescribedMotion& motion : model.motions)
      if (!motion.is_velocity)
        state.displacement.component(motion.component)[motion.node] = motion.value * factor(motion, 0);
  }

  // Prescribed components of a row: the velocity that leads to the displacement at the end of the step, or the velocity
  // at its middle.
  void impose_motion(std::int64_t row) {
    for (std::size_t m = motion_rows.begin(row); m < motion_rows.end(row); ++m) {
      const model::PrescribedMotion& motion = model.motions[m];
      double& v = state.velocity.component(motion.component)[motion.node];
      const double u = state.displacement.component(motion.component)[motion.node];
      v = motion.is_velocity ? motion.value * factor(motion, state.time + 0.5 * dt)
                             : (motion.value * factor(motion, state.time + dt) - u) / dt;
    }
  }

  void kick_row(std::int64_t j, std::int64_t k) {
    const lattice::Layout& layout = model.layout();
    double* const* force = kernel.row(state.displacement, j, k);
    loads.add(j, k, force);
    const std::int64_t n = layout.index(0, j, k);
    for (int c = 0; c < model.components(); ++c)
      update.kick(kick, layout.owned()[0], layout.pitch(), force[c], inverse_inertia.component(c < 3 ? 0 : 1) + n,
                  state.velocity.component(c) + n);
    impose_motion(j + layout.owned()[1] * k);
  }

  void drift_row(std::int64_t j, std::int64_t k) {
    const std::int64_t n = model.layout().index(0, j, k);
    for (int c = 0; c < model.components(); ++c)
      update.drift(dt, model.layout().owned()[0], state.velocity.component(c) + n, state.displacement.component(c) + n);
    if (state.orientation.components() != 0) turn_row(n);
  }

  void turn_row(std::int64_t first) {
    for (std::int64_t n = first; n < first + model.layout().owned()[0]; ++n) {
      Quaternion q;
      Vec3 omega;
      for (int c = 0; c < 4; ++c) q[c] = state.orientation.component(c)[n];
      for (int c = 0; c < 3; ++c) omega[c] = state.velocity.component(3 + c)[n];
      q = rotate(q, omega, dt);
      for (int c = 0; c < 4; ++c) state.orientation.component(c)[n] = q[c];
    }
  }

  // Moves the rows lo <= j < hi of plane k, without those closer than `margin` to the border.
  void drift_rows(std::int64_t lo, std::int64_t hi, std::int64_t k, std::int64_t margin) {
    const Int3& owned = model.layout().owned();
    if (k < margin || k >= owned[2] - margin) return;
    lo = std::max(lo, margin);
    hi = std::min(hi, owned[1] - margin);
    for (std::int64_t j = lo; j < hi; ++j) drift_row(j, k);
  }

  // Kicks the rows that are `border` or more away from the border, and moves those whose neighbours are all among them.
  // Blocks of a few rows go up through all planes, so that what a row's neighbours read is still in the cache; a row
  // moves when the last row that reads it, the next one in the plane above, has its force.
  void step_inner(std::int64_t border) {
    const Int3& owned = model.layout().owned();
    const std::int64_t last_row = owned[1] - border, last_plane = owned[2] - border;
    for (std::int64_t begin = border; begin < last_row; begin += block_rows) {
      const std::int64_t end = std::min(begin + block_rows, last_row);
      const std::int64_t lo = begin - 1, hi = end == last_row ? end : end - 1;
      for (std::int64_t k = border; k < last_plane; ++k) {
        for (std::int64_t j = begin; j < end; ++j) kick_row(j, k);
        drift_rows(lo, hi, k - 1, 2 * border);
      }
      drift_rows(lo, hi, last_plane - 1, 2 * border);
    }
  }

  // Rows that need no ghosts are done while the ghosts are on their way.
  void step() {
    const Int3& owned = model.layout().owned();
    const lattice::Halo& halo = *model.lattice.halo;
    loads.set_time(state.time);
    if (!halo.active()) {
      step_inner(0);
    } else {
      const bool rows_are_whole = owned[0] == model.lattice.grid.nodes()[0] && !model.lattice.grid.periodic[0];
      const std::int64_t border = rows_are_whole ? 1 : owned[1] + owned[2];
      const auto inside = [&](std::int64_t j, std::int64_t k, std::int64_t margin) {
        return j >= margin && k >= margin && j < owned[1] - margin && k < owned[2] - margin;
      };
      halo.begin(state.displacement);
      step_inner(border);
      halo.end();
      for (std::int64_t k = 0; k < owned[2]; ++k)
        for (std::int64_t j = 0; j < owned[1]; ++j)
          if (!inside(j, k, border)) kick_row(j, k);
      for (std::int64_t k = 0; k < owned[2]; ++k)
        for (std::int64_t j = 0; j < owned[1]; ++j)
          if (!inside(j, k, 2 * border)) drift_row(j, k);
    }
    ++state.step;
    state.time = origin + static_cast<double>(state.step) * dt;
  }
};

ExplicitSolver::ExplicitSolver(const model::Model& model, model::State& state, double dt)
    : self_(new Implementation(model, state, dt)) {}
ExplicitSolver::~ExplicitSolver() = default;
double ExplicitSolver::dt() const { return self_->dt; }
void ExplicitSolver::step() { self_->step(); }

}  // namespace koshi::dynamics
