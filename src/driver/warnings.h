// What a case is told before it runs: springs that would be unstable are refused, and what may surprise is said.
#pragma once

#include <string>
#include <vector>

#include "koshi/model.h"

namespace koshi::driver {

/// Things the user should look at, a sentence each:
/// - a static analysis with springs whose rotations have a gear mode (mechanics::self_check says "warning");
/// - loads and probes of a search for modes, which uses neither;
/// - a smooth platen, that is a face held across and free along itself, that leaves its nodes free to turn. Along the
///   edges of such a face the springs' moments do not cancel (theory, chapter 6), and the body comes out too soft.
/// - a spacing too coarse for a material that cracks to have both its strength and its fracture energy.
/// Errors: InputError where a material's springs are unstable or let nodes move without energy, and in a search for
/// modes springs with a gear mode, with the remedy.
std::vector<std::string> warnings(const model::Model& model);

}  // namespace koshi::driver
