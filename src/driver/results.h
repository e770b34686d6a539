// What a run reports: columns of the history, the summary.
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

#include "driver/simulation.h"

namespace koshi::driver {

/// Columns of history.csv: time, probes, energies, unbalanced-force ratio.
std::vector<std::string> history_columns(const model::Model& model);
std::vector<double> history_row(const model::Model& model, double time, const mechanics::Measurement& measurement);

/// Memory of a run, of all its ranks together [bytes].
struct RunMemory {
  double peak = 0;        ///< the most
  ResidentMemory before;  ///< before the model was made
  ResidentMemory at_end;
};

/// summary.json (docs/formats/output.md).
nlohmann::ordered_json summary(const model::Model& model, const model::State& state, const Outcome& outcome,
                               const RunMemory& memory);

/// A few lines for the terminal.
std::string headline(const model::Model& model, const Outcome& outcome);

}  // namespace koshi::driver
