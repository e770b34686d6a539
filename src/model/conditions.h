// Boundaries, loads and probes of the definition on the nodes of one rank.
#pragma once

#include <vector>

#include "koshi/model.h"

namespace koshi::model {

/// Prescribed components, sorted by node and component (collective). The same motion given twice counts once; two that
/// differ are an error that names both boundaries.
std::vector<PrescribedMotion> make_motions(const Model& model);

/// Loads as nodal forces (collective). A total force is spread by each node's part of the selected surface, or evenly.
std::vector<Load> make_loads(const Model& model);

std::vector<Probe> make_probes(const Model& model);

}  // namespace koshi::model
