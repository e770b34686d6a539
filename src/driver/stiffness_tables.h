// An effective stiffness as tables: for people and programs.
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

#include "driver/stiffness_studies.h"
#include "koshi/homogenize.h"

namespace koshi::driver {

/// stiffness.json (docs/formats/output.md).
nlohmann::ordered_json stiffness_json(const model::Model& model, const homogenize::Effective& effective);

/// Columns and rows of stiffness.csv: C, and the compliance below it where there is one.
std::vector<std::string> stiffness_columns();
std::vector<std::vector<double>> stiffness_rows(const homogenize::Effective& effective);

/// Columns and rows of directions.csv: Young's modulus and wave speeds along directions in the planes xy, yz, zx.
std::vector<std::string> direction_columns();
std::vector<std::vector<double>> direction_rows(const homogenize::Effective& effective);

/// The word for a boundary type.
std::string boundary_name(homogenize::Boundary boundary);

/// What a material goes by in the tables.
std::string phase_name(const model::Model& model, std::uint16_t material);

/// What twice the spacing says of the error: moduli of the closest isotropic tensor there, extrapolated to cells of no
/// size as an error of first order, and as its uncertainty the difference of the two.
nlohmann::ordered_json coarser_json(const homogenize::Effective& fine, const homogenize::Effective& coarse);
std::string coarser_text(const homogenize::Effective& fine, const homogenize::Effective& coarse);
std::string boxes_text(const std::vector<BoxSample>& samples);

/// Tables for the terminal.
std::string stiffness_text(const model::Model& model, const homogenize::Effective& effective);

}  // namespace koshi::driver
