// Definitions of blocks for effective stiffnesses, filled cell by cell.
#pragma once

#include <algorithm>
#include <vector>

#include "koshi/homogenize.h"
#include "support/cases.h"

namespace koshi::test {

inline const std::vector<material::Elastic> three_elastics{{30e9, 0.2, 2600}, {6e9, 0.33, 2000}, {70e9, 0.1, 3000}};

/// Cells of 1 cm of the materials a, b, c, all a; periodic in all directions.
inline model::Definition periodic_block(const Int3& cells) {
  model::Definition definition = block(cells, 0.01);
  definition.analysis = {};
  definition.analysis.tolerance = 1e-12;
  definition.body.periodic = {true, true, true};
  definition.materials = {{"a", three_elastics[0]}, {"b", three_elastics[1]}, {"c", three_elastics[2]}};
  definition.body.material = "a";
  return definition;
}

/// Gives each cell a material by its indices.
template <class F>
void fill(model::Definition& definition, const Int3& cells, F&& material_of) {
  definition.body.material.clear();
  definition.body.cells.clear();
  for (std::int64_t k = 0; k < cells[2]; ++k)
    for (std::int64_t j = 0; j < cells[1]; ++j)
      for (std::int64_t i = 0; i < cells[0]; ++i)
        definition.body.cells.push_back(static_cast<std::uint16_t>(material_of(Int3{i, j, k})));
}

/// At the tolerance of the definition, which is taken as periodic or not as the boundary needs it.
inline homogenize::Effective effective(model::Definition definition, const Communicator& communicator,
                                       homogenize::Boundary boundary = homogenize::Boundary::periodic) {
  if (boundary != homogenize::Boundary::periodic) definition.body.periodic = {};
  statics::StaticOptions options;
  options.tolerance = definition.analysis.tolerance;
  // Elsewhere the tolerance is that of energies, which are of second order.
  if (boundary != homogenize::Boundary::traction) options.tolerance *= options.tolerance;
  return homogenize::effective_stiffness(model::make_model(definition, communicator), options, boundary);
}

}  // namespace koshi::test
