// How far cells differ, as it came out: what random numbers, files and grain boundaries made of a material.
#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>
#include <vector>

#include "koshi/model.h"

namespace koshi::driver {

/// Factors of one material's cells.
struct ScatterReport {
  std::string material;
  std::string property;  ///< "stiffness" or "strength"
  std::int64_t cells = 0;
  double mean = 0;
  double variation = 0;    ///< standard deviation over mean
  double correlation = 0;  ///< of cells that share a face; 0 where nothing varies
};

/// Of the materials whose stiffness scatters, and of those that can crack where strengths differ (collective; equal for
/// any number of ranks). The model's factors must not have been changed by cracks.
std::vector<ScatterReport> scatter_reports(const model::Model& model);

/// `strength of "rock": mean 0.998, variation 0.121, correlation of neighbours 0.939`
std::string text(const ScatterReport& report);

/// Entry of the summary.
nlohmann::ordered_json json(const std::vector<ScatterReport>& reports);

}  // namespace koshi::driver
