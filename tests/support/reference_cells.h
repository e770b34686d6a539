// tests/reference/cells.json: springs and eigenvalues of one isolated cell (d = 1, mu = 1), computed independently.
#pragma once

#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "koshi/springs.h"

namespace koshi::test {

struct ReferenceCell {
  lattice::CellType cell;
  material::Calibration calibration;
  material::Kinematics kinematics;
  material::Elastic elastic;        ///< mu = 1 Pa
  material::Springs springs;        ///< printed with 12 decimals
  std::vector<double> eigenvalues;  ///< ascending, printed with 10 decimals
  std::string name;                 ///< for messages
};

inline std::vector<ReferenceCell> reference_cells() {
  std::ifstream file(KOSHI_SOURCE_DIR "/tests/reference/cells.json");
  if (!file) throw std::runtime_error("tests/reference/cells.json is missing");
  std::vector<ReferenceCell> cells;
  const nlohmann::json reference = nlohmann::json::parse(file);
  for (const nlohmann::json& entry : reference.at("cells")) {
    ReferenceCell cell;
    const std::string type = entry.at("cell"), calibration = entry.at("calibration"),
                      kinematics = entry.at("kinematics");
    cell.cell = type == "cube-I"    ? lattice::CellType::cube_i
                : type == "cube-II" ? lattice::CellType::cube_ii
                                    : lattice::CellType::cube_iii;
    cell.calibration =
        calibration == "isotropic" ? material::Calibration::isotropic : material::Calibration::bending_exact;
    cell.kinematics =
        kinematics == "rotational" ? material::Kinematics::rotational : material::Kinematics::least_squares;
    const double nu = entry.at("poissons_ratio");
    cell.elastic = {2 * (1 + nu), nu, 1};
    entry.at("kn").get_to(cell.springs.kn);
    entry.at("kt").get_to(cell.springs.kt);
    entry.at("kappa").get_to(cell.springs.kappa);
    entry.at("eigenvalues").get_to(cell.eigenvalues);
    cell.name = type + ", " + calibration + ", " + kinematics + ", nu = " + std::to_string(nu);
    cells.push_back(cell);
  }
  return cells;
}

}  // namespace koshi::test
