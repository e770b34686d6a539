// Definitions of small blocks for tests, filled in code.
#pragma once

#include <string>

#include "koshi/definition.h"

namespace koshi::test {

/// A block of `cells` cells of side `d` [m] of one rock, without boundaries and loads, in an undamped dynamic analysis.
inline model::Definition block(const Int3& cells, double d, material::Elastic elastic = {1112e6, 0.18, 2000}) {
  model::Definition definition;
  definition.lattice.spacing = d;
  for (std::size_t a = 0; a < 3; ++a) definition.body.size[a] = d * static_cast<double>(cells[a]);
  definition.body.material = "rock";
  definition.materials = {{"rock", elastic}};
  definition.analysis.type = model::AnalysisDefinition::Type::dynamic;
  definition.analysis.duration = 1;
  definition.analysis.damping.kind = model::DampingDefinition::Kind::none;
  return definition;
}

/// A boundary on one face that fixes the listed components: 0 ... 5 = x, y, z, rx, ry, rz.
inline model::BoundaryDefinition fixed(const std::string& name, model::Face face,
                                       std::initializer_list<std::size_t> components) {
  model::BoundaryDefinition boundary;
  boundary.name = name;
  boundary.selection.face = face;
  for (const std::size_t c : components) boundary.fix[c] = true;
  return boundary;
}

inline model::ProbeDefinition probe(const std::string& name, model::Face face,
                                    model::ProbeDefinition::Quantity quantity, model::ProbeDefinition::Reduce reduce) {
  model::ProbeDefinition probe;
  probe.name = name;
  probe.selection.face = face;
  probe.quantity = quantity;
  probe.reduce = reduce;
  return probe;
}

}  // namespace koshi::test
