// A simulation run with its files.
#pragma once

#include "driver/simulation.h"
#include "koshi/run.h"

namespace koshi::driver {

/// Runs the simulation and writes its output directory, summary included (collective).
Outcome run_simulation(Simulation& simulation, const RunOptions& options);

}  // namespace koshi::driver
