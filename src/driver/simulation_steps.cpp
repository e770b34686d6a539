// A simulation stepped by its owner, who may change loads and motions in between.
#include <algorithm>

#include "base/suggest.h"
#include "driver/simulation.h"
#include "failure/cracking.h"

namespace koshi::driver {
namespace {

// Index of the table with this name; `kind` is its section of the input.
template <class D>
std::size_t index_of(const std::vector<D>& tables, const std::string& name, const std::string& kind) {
  const auto found = std::find_if(tables.begin(), tables.end(), [&](const D& table) { return table.name == name; });
  if (found != tables.end()) return static_cast<std::size_t>(found - tables.begin());
  std::vector<std::string> names;
  for (const D& table : tables) names.push_back(table.name);
  throw InputError("there is no " + kind + " \"" + name + "\"; " +
                   (names.empty() ? "the case has none" : suggestion(name, names)));
}

}  // namespace

double Simulation::time_step() {
  if (!stable_) stable_ = mechanics::stable_step(*model_, *kernel_);
  return choose_step(*stable_);
}

void Simulation::step(std::int64_t count, const std::function<void()>& breathe) {
  if (!stepper_) {
    // The state may have been changed since it was cracked.
    if (fracturing() != nullptr) fracturing()->restore();
    stepper_ = std::make_unique<dynamics::ExplicitSolver>(*model_, state(), time_step(), fracturing());
  }
  // The owner may have moved nodes since the last call.
  if (fracturing() != nullptr) fracturing()->look_again();
  if (count > 0) lag_ = time_step();
  for (std::int64_t s = 0; s < count; ++s) {
    stepper_->step();
    if (breathe) breathe();
  }
}

mechanics::Measurement Simulation::measure() { return measure_at(lag_); }

void Simulation::set_load_factor(const std::string& name, double value) {
  model::History history{{0, value}};
  const std::size_t load = index_of(model_->definition.loads, name, "load");
  model_->definition.loads[load].history = history;
  model_->loads[load].history = history;
}

void Simulation::check_cracks() const {
  if (!model_->definition.cracks())
    throw InputError("damage: error: no material of the case can crack; give one a fracture");
}

void Simulation::damage_cells(const lattice::Field<double>& wanted, const Vec3& normal) {
  check_cracks();
  if (!(norm(normal) > 0))
    throw InputError("damage: error: the normal is zero; it needs a direction such as (1, 0, 0)");
  auto* const cracking = dynamic_cast<failure::Cracking*>(fracturing());
  if (cracking == nullptr)
    throw InputError(
        "damage: error: with law = \"bonds\" a cell has no damage of its own, only bonds that break; take law = "
        "\"cohesive\"");
  cracking->damage_cells(wanted, normal);
}

void Simulation::set_boundary_factor(const std::string& name, double value) {
  model::BoundaryDefinition& boundary =
      model_->definition.boundaries[index_of(model_->definition.boundaries, name, "boundary")];
  boundary.ramp = 0;
  boundary.history = {{0, value}};
}

}  // namespace koshi::driver
