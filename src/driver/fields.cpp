#include "driver/fields.h"

#include "driver/cracked_cells.h"
#include "dynamics/orientation.h"
#include "mechanics/cell_stress.h"
#include "mechanics/measure.h"
#include "mechanics/surface_stress.h"
#include "mechanics/uniform_strain.h"

namespace koshi::driver {
namespace {

using lattice::Field;

const std::vector<std::string> vector_names{"x", "y", "z"};
const std::vector<std::string> tensor_names = mechanics::component_names(model::ProbeDefinition::Quantity::stress);

// A field on the solid cells whose lowest corner this rank owns: f(state of the cell, component).
template <class F>
Field<double> on_cells(const model::Model& model, const Field<double>& u, int components, F&& f) {
  Field<double> field(model.layout(), components);
  const std::uint16_t* cell = model.lattice.cell.component(0);
  lattice::for_each_owned(model.layout(), [&](auto, auto, auto, auto n) {
    if (cell[n] == 0) return;
    const mechanics::CellState state = mechanics::material_state(model.lattice, u, n);
    for (int c = 0; c < components; ++c) field.component(c)[n] = f(state, c);
  });
  return field;
}

// Strain or stress, `tensor` of what is recovered, in the same cells; those that a surface cuts take it from the
// whole ones around them.
Field<double> tensor_on_cells(const model::Model& model, const Field<double>& u,
                              mechanics::Tensor6 mechanics::CellState::*own,
                              mechanics::Tensor6 mechanics::SurfaceStress::Value::*recovered) {
  Field<double> field =
      on_cells(model, u, 6, [&](const auto& state, int c) { return (state.*own)[static_cast<std::size_t>(c)]; });
  if (!model.cut) return field;
  std::vector<std::int64_t> cut;
  const std::uint16_t* cell = model.lattice.cell.component(0);
  lattice::for_each_owned(model.layout(), [&](auto, auto, auto, auto n) {
    if (cell[n] != 0 && model.lattice.fraction_of(n) != 1) cut.push_back(n);
  });
  mechanics::SurfaceStress surface(model.lattice, cut);
  surface.update(u);
  for (const std::int64_t n : cut) {
    const auto value = surface.at(n, surface.middle_of_part(n));
    for (int c = 0; c < 6; ++c) field.component(c)[n] = (value.*recovered)[static_cast<std::size_t>(c)];
  }
  return field;
}

// Rotations of the nodes: unknowns with rotational kinematics, else the mean of the cells around the node.
Field<double> fitted_rotation(const model::Model& model, const Field<double>& u) {
  Field<double> field(model.layout(), 3);
  lattice::for_each_owned(model.layout(), [&](auto, auto, auto, auto n) {
    const Vec3 w = mechanics::node_state(model.lattice, u, n).rotation;
    for (int c = 0; c < 3; ++c) field.component(c)[n] = w[static_cast<std::size_t>(c)];
  });
  return field;
}

Field<double> euler_angles(const model::Model& model, const Field<double>& orientation) {
  Field<double> field(model.layout(), 3);
  lattice::for_each_owned(model.layout(), [&](auto, auto, auto, auto n) {
    dynamics::Quaternion q;
    for (int c = 0; c < 4; ++c) q[static_cast<std::size_t>(c)] = orientation.component(c)[n];
    const Vec3 angles = dynamics::euler_angles(q);
    for (int c = 0; c < 3; ++c) field.component(c)[n] = angles[static_cast<std::size_t>(c)];
  });
  return field;
}

}  // namespace

FieldSet::FieldSet(const std::vector<std::string>& names, const model::Model& model, model::State& state,
                   mechanics::Meter& meter) {
  mechanics::exchange_displacements(model, state.mean_strain, state.displacement);
  for (const std::string& name : names) add(name, model, state, meter);
}

void FieldSet::add(const std::string& name, const model::Model& model, model::State& state, mechanics::Meter& meter) {
  const Field<double>& u = state.displacement;
  const bool rotational = model.components() == 6;
  const auto computed = [&](Field<double> field, std::vector<std::string> components, bool cells) {
    computed_.push_back(std::move(field));
    Field<double>& kept = computed_.back();
    fields_.push_back({name, &kept, 0, kept.components(), std::move(components), cells});
  };
  if (name == "displacement") fields_.push_back({name, &state.displacement, 0, 3, vector_names, false, true});
  if (name == "velocity") fields_.push_back({name, &state.velocity, 0, 3, vector_names, false});
  if (name == "rotation") {
    if (rotational)
      fields_.push_back({name, &state.displacement, 3, 3, vector_names, false, true});
    else
      computed(fitted_rotation(model, u), vector_names, false);
  }
  if (name == "orientation" && state.orientation.components() != 0)
    computed(euler_angles(model, state.orientation), {"theta", "phi", "psi"}, false);
  if (name == "reaction") {
    computed(meter.reactions(state), vector_names, false);
    fields_.back().components = 3;
  }
  if (name == "strain")
    computed(tensor_on_cells(model, u, &mechanics::CellState::strain, &mechanics::SurfaceStress::Value::strain),
             tensor_names, true);
  if (name == "stress")
    computed(tensor_on_cells(model, u, &mechanics::CellState::stress, &mechanics::SurfaceStress::Value::stress),
             tensor_names, true);
  if (name == "damage") fields_.push_back({name, &state.crack, 0, 1, {}, true});
  if (name == "crack_opening") {
    Field<double> opening(model.layout(), 1);
    lattice::for_each_owned(
        model.layout(), [&](auto, auto, auto, auto n) { opening.component(0)[n] = crack_opening(model, state, n); });
    computed(std::move(opening), {}, true);
  }
  if (name == "energy") computed(on_cells(model, u, 1, [](const auto& s, int) { return s.energy; }), {}, true);
}

}  // namespace koshi::driver
