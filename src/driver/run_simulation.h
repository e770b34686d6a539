// A simulation run with its files.
#pragma once

#include "driver/simulation.h"
#include "koshi/run.h"

namespace koshi::driver {

/// Runs the simulation and writes its output directory, summary included (collective). Of `observer`, `poll`,
/// `breathe` and `progress` are called too.
Outcome run_simulation(Simulation& simulation, const RunOptions& options, const Observer& observer = {});

/// Throws RunError when a quasi-static run did not come to rest, or a step of the loads found no end; `remark` ends its
/// text.
void require_rest(const model::Model& model, const Outcome& outcome, const std::string& remark = "");

}  // namespace koshi::driver
