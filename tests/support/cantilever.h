// The paper's cantilever: 1.8 x 7.8 x 1.8 cm along y, clamped at y = 0, 9.8 N in +x over the end face by cell share.
#pragma once

#include "koshi/model.h"

namespace koshi::test {

inline model::Definition cantilever(double spacing, double nu) {
  model::Definition definition;
  definition.lattice.spacing = spacing;
  definition.body.size = {0.018, 0.078, 0.018};
  definition.body.material = "rock";
  definition.materials = {{"rock", {1112e6, nu, 2000}}};
  model::BoundaryDefinition root;
  root.name = "root";
  root.selection.face = model::Face::y_min;
  root.fix.fill(true);
  definition.boundaries = {root};
  model::LoadDefinition load;
  load.name = "tip load";
  load.selection.face = model::Face::y_max;
  load.force = Vec3{9.8, 0, 0};
  definition.loads = {load};
  model::ProbeDefinition probe;
  probe.name = "tip";
  probe.selection.face = model::Face::y_max;
  probe.reduce = model::ProbeDefinition::Reduce::area_mean;
  definition.probes = {probe};
  return definition;
}

}  // namespace koshi::test
