// An effective stiffness as tables: for people and programs.
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

#include "koshi/homogenize.h"

namespace koshi::driver {

/// stiffness.json (docs/formats/output.md).
nlohmann::ordered_json stiffness_json(const model::Model& model, const homogenize::Effective& effective);

/// Columns and rows of stiffness.csv: C, and the compliance below it where there is one.
std::vector<std::string> stiffness_columns();
std::vector<std::vector<double>> stiffness_rows(const homogenize::Effective& effective);

/// Tables for the terminal.
std::string stiffness_text(const model::Model& model, const homogenize::Effective& effective);

}  // namespace koshi::driver
