#include <fmt/format.h>

#include "study/paper.h"

namespace koshi::study {
namespace {

using model::Face;

model::Definition base_case(lattice::CellType cell) {
  model::Definition definition;
  definition.lattice.cell = cell;
  definition.lattice.spacing = 0.002;
  definition.lattice.springs = material::Sharing::plain;
  definition.lattice.calibration = material::Calibration::paper;
  definition.body.material = "rock";
  definition.materials = {{"rock", {1112e6, 0.18, 2000}}};
  definition.analysis.damping = {model::DampingDefinition::Kind::local, 0.8, 0};
  return definition;
}

model::ProbeDefinition point_probe(const std::string& name, const Vec3& point) {
  model::ProbeDefinition probe;
  probe.name = name;
  probe.selection.point = point;
  probe.reduce = model::ProbeDefinition::Reduce::mean;
  return probe;
}

}  // namespace

model::Definition uniaxial_case(lattice::CellType cell) {
  model::Definition definition = base_case(cell);
  definition.title = fmt::format("Uniaxial compression, {}", lattice::name(cell));
  definition.body.size = {0.008, 0.008, 0.016};
  // One platen fixes the rotations, the other leaves them free: the reading that gives the paper's values.
  model::BoundaryDefinition bottom, top;
  bottom.name = "bottom platen";
  bottom.selection.face = Face::z_min;
  bottom.fix = {false, false, true, true, true, true};
  top.name = "top platen";
  top.selection.face = Face::z_max;
  top.velocity[2] = -1e-3;  // 1e-8 cm every 1e-7 s
  definition.boundaries = {bottom, top};
  definition.analysis.type = model::AnalysisDefinition::Type::dynamic;
  definition.analysis.duration = 0.32;  // until u/h0 = 0.02

  model::ProbeDefinition force;
  force.name = "top force";
  force.selection.face = Face::z_max;
  force.quantity = model::ProbeDefinition::Quantity::reaction;
  force.reduce = model::ProbeDefinition::Reduce::sum;
  definition.probes = {force, point_probe("side x-min", {0, 0.004, 0.008}),
                       point_probe("side x-max", {0.008, 0.004, 0.008})};
  definition.output.fields = {"displacement", "rotation", "stress", "strain"};
  return definition;
}

model::Definition cantilever_case(lattice::CellType cell, bool exact) {
  model::Definition definition = base_case(cell);
  definition.title = fmt::format("Cantilever, {}{}", lattice::name(cell), exact ? ", exact springs" : "");
  definition.body.size = {0.018, 0.078, 0.018};
  if (exact) {
    definition.lattice.springs = material::Sharing::shared;
    definition.lattice.calibration = material::Calibration::bending_exact;
  } else {
    definition.lattice.axes = "yxz";  // axis 1 of the stiffness tensor lies along the beam
  }
  model::BoundaryDefinition root;
  root.name = "root";
  root.selection.face = Face::y_min;
  root.fix.fill(true);
  definition.boundaries = {root};
  model::LoadDefinition load;
  load.name = "tip load";
  load.selection.face = Face::y_max;
  load.force = Vec3{9.8, 0, 0};
  load.distribution = exact ? model::LoadDefinition::Distribution::area : model::LoadDefinition::Distribution::nodes;
  definition.loads = {load};
  definition.analysis.type = model::AnalysisDefinition::Type::quasi_static;
  definition.analysis.tolerance = 1e-6;

  definition.probes = {point_probe("tip", {0.008, 0.078, 0.010})};
  for (int j = 0; j <= 39; ++j) {
    const double y = 0.002 * j;
    definition.probes.push_back(point_probe(fmt::format("y = {:.1f} cm", 100 * y), {0.008, y, 0.010}));
  }
  definition.output.fields = {"displacement", "rotation", "stress", "strain"};
  return definition;
}

}  // namespace koshi::study
