#include <algorithm>
#include <optional>

#include "dynamics/energy_ledger.h"
#include "dynamics/mean_strain.h"
#include "dynamics/orientation.h"
#include "dynamics/row_update.h"
#include "failure/fracturing.h"
#include "koshi/dynamics.h"
#include "lattice/halo.h"
#include "mechanics/force_kernel.h"
#include "mechanics/loads.h"

namespace koshi::dynamics {
namespace {

using mechanics::Rows;

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

}  // namespace

struct ExplicitSolver::Implementation {
  const model::Model& model;
  model::State& state;
  const double dt;
  const lattice::Halo& halo = *model.lattice.halo;
  const Kick kick;
  const RowUpdate& update = row_update();
  mechanics::ForceKernel kernel;
  mechanics::LoadRows loads;
  mechanics::RowIndex motion_rows;
  lattice::Field<double> inverse_inertia;
  MeanStrain mean_strain;
  const double origin;  // time of step 0: times are origin + step dt, so that they do not gather rounding

  // Of a body that can crack.
  failure::Fracturing* const cracking;
  std::optional<EnergyLedger> ledger;

  Implementation(const model::Model& m, model::State& s, double step, failure::Fracturing* cracks)
      : model(m),
        state(s),
        dt(step),
        kick(make_kick(m.definition.analysis.damping, step)),
        kernel(m.lattice),
        loads(m),
        motion_rows(m.layout(), m.motions, [](const model::PrescribedMotion& p) { return p.node; }),
        inverse_inertia(inverse(m.layout(), m.inertia)),
        mean_strain(m, s),
        origin(s.time - static_cast<double>(s.step) * step),
        cracking(cracks) {
    if (cracking != nullptr) ledger.emplace(model, state, motion_rows, kick, dt);
    if (state.step == 0 && state.time == 0) take_initial_displacements();
  }

  double factor(const model::PrescribedMotion& motion, double t) const {
    return model::factor(model.definition.boundaries[static_cast<std::size_t>(motion.boundary)], t);
  }

  void take_initial_displacements() {
    mean_strain.follow();
    for (const model::PrescribedMotion& motion : model.motions)
      if (!motion.is_velocity)
        state.displacement.component(motion.component)[motion.node] = motion.value * factor(motion, 0);
  }

  // --- The phases of a step. Phases 3 to 6 act on a row of nodes as soon as phase 2 has its force, phase 7 as
  // soon as no other row needs its displacements any more, so that a row is in the cache from its first phase to its
  // last.
  void step() {
    const auto [inner, borders] = regions();
    loads.set_time(state.time);
    begin_exchange();
    advance(inner);  // rows that need no ghosts, while the ghosts are on their way
    end_exchange();
    for (const Rows& border : borders) advance(border);
    drift_borders();
    ++state.step;
    state.time = origin + static_cast<double>(state.step) * dt;
    mean_strain.follow();
    if (cracking != nullptr) crack();
  }

  // 1. Exchange the halo of displacements.
  void begin_exchange() {
    if (halo.active()) halo.begin(state.displacement);
  }
  void end_exchange() {
    if (halo.active()) halo.end();
    mean_strain.continue_ghosts();
  }

  // Takes rows through phases 2 to 7.
  void advance(const Rows& rows) {
    kernel.for_each_row(
        state.displacement, rows, [this](std::int64_t n) { fetch(n); },  // 2. internal force
        [&](std::int64_t j, std::int64_t k, double* const* force) {
          if (cracking != nullptr) cracking->add_forces(j, k, force);
          if (ledger) ledger->open(j, k, force, loads.touch(j, k));
          loads.add(j, k, force);      // 3. add loads
          damp_and_kick(j, k, force);  // 4. and 5.
          impose_motion(j, k);         // 6.
          if (ledger) ledger->close(j, k, force);
          if (cracking != nullptr) cracking->note_row(j, k);
        },
        [&](std::int64_t j, std::int64_t k) {
          if (!touches_border(j, k)) drift(j, k);  // 7.
        });
  }

  // What phases 4 to 7 need of a line of nodes.
  void fetch(std::int64_t n) {
    for (int c = 0; c < model.components(); ++c) __builtin_prefetch(state.velocity.component(c) + n, 1, 2);
    for (int c = 0; c < inverse_inertia.components(); ++c) __builtin_prefetch(inverse_inertia.component(c) + n, 0, 2);
    if (ledger) ledger->fetch(n);
  }

  // 4. Damp (N27) and 5. kick: velocities by the acceleration (N5).
  void damp_and_kick(std::int64_t j, std::int64_t k, double* const* force) {
    const lattice::Layout& layout = model.layout();
    const std::int64_t n = layout.index(0, j, k);
    for (int c = 0; c < model.components(); ++c) {
      const double* const inverse = inverse_inertia.component(c < 3 ? 0 : 1) + n;
      if (ledger)
        ledger->kick(c, n, force[c], inverse);
      else
        update.kick(kick, layout.owned()[0], force[c], inverse, state.velocity.component(c) + n);
    }
  }

  // 6. Impose prescribed motion: the velocity that leads to the displacement at the end of the step, or the velocity at
  // its middle.
  void impose_motion(std::int64_t j, std::int64_t k) {
    const std::int64_t row = j + model.layout().owned()[1] * k;
    for (std::size_t m = motion_rows.begin(row); m < motion_rows.end(row); ++m) {
      const model::PrescribedMotion& motion = model.motions[m];
      double& v = state.velocity.component(motion.component)[motion.node];
      const double u = state.displacement.component(motion.component)[motion.node];
      v = motion.is_velocity ? motion.value * factor(motion, state.time + 0.5 * dt)
                             : (motion.value * factor(motion, state.time + dt) - u) / dt;
    }
  }

  // 7. Drift: displacements by the velocities (N6), orientations with them.
  void drift(std::int64_t j, std::int64_t k) {
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

  // 8. Crack cells, or break bonds, by the displacements at the end of the step.
  void crack() {
    halo.exchange(state.displacement);
    halo.exchange(state.velocity);
    cracking->follow(dt);
  }

  // --- What the exchange asks for: rows with ghosts around them come last, and rows that they need do not drift
  // before.

  struct Regions {
    Rows inner;
    std::array<Rows, 4> borders;  // some may be empty
  };

  Regions regions() const {
    const std::int64_t ny = model.layout().owned()[1], nz = model.layout().owned()[2];
    if (!halo.active()) return {kernel.all_rows(), {}};
    if (!rows_are_whole()) return {{}, {kernel.all_rows()}};
    const std::int64_t upper_z = std::max<std::int64_t>(nz - 1, 1), upper_y = std::max<std::int64_t>(ny - 1, 1);
    return {{1, ny - 1, 1, nz - 1},
            {Rows{0, ny, 0, 1}, Rows{0, 1, 1, upper_z}, Rows{upper_y, ny, 1, upper_z}, Rows{0, ny, upper_z, nz}}};
  }

  bool rows_are_whole() const {
    return model.layout().owned()[0] == model.lattice.grid.nodes()[0] && !model.lattice.grid.periodic[0];
  }

  // Is the row one of a border region, or next to one?
  bool touches_border(std::int64_t j, std::int64_t k) const {
    if (!halo.active()) return false;
    const Int3& owned = model.layout().owned();
    return !rows_are_whole() || j < 2 || k < 2 || j >= owned[1] - 2 || k >= owned[2] - 2;
  }

  void drift_borders() {
    if (!halo.active()) return;
    const Int3& owned = model.layout().owned();
    for (std::int64_t k = 0; k < owned[2]; ++k)
      for (std::int64_t j = 0; j < owned[1]; ++j)
        if (touches_border(j, k)) drift(j, k);
  }
};

ExplicitSolver::ExplicitSolver(const model::Model& model, model::State& state, double dt, failure::Fracturing* cracking)
    : self_(new Implementation(model, state, dt, cracking)) {}
ExplicitSolver::~ExplicitSolver() = default;
double ExplicitSolver::dt() const { return self_->dt; }
void ExplicitSolver::step() { self_->step(); }

}  // namespace koshi::dynamics
