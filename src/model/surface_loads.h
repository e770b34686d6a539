// Loads on the surfaces of regions.
#pragma once

#include <string>
#include <vector>

#include "koshi/model.h"

namespace koshi::model {

/// Forces of a pressure, traction or total force on what a load selects of the surfaces of `regions`: every piece of
/// surface gives its force to the corners of its cell by their trilinear shape functions at its centroid, which keeps
/// force and moment. Sorted by node; the same bits on any ranks. `path` and `title` name the load in messages; throws
/// InputError when it selects no surface of the body.
std::vector<NodeForce> surface_forces(const Model& model, const LoadDefinition& load, const std::vector<int>& regions,
                                      const std::string& path, const std::string& title);

}  // namespace koshi::model
