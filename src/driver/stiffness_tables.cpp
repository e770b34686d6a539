#include "driver/stiffness_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/escape.h"
#include "mechanics/measure.h"

namespace koshi::driver {
namespace {

using Json = nlohmann::ordered_json;
using homogenize::Moduli;

const std::vector<std::string> component = mechanics::component_names(model::ProbeDefinition::Quantity::stress);
constexpr std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};

double fraction_of(const homogenize::Effective& effective, std::uint16_t material) {
  for (const homogenize::Phase& phase : effective.phases)
    if (phase.material == material) return phase.fraction;
  return 0;
}

std::string phase_name(const model::Model& model, std::uint16_t material) {
  return material == 0 ? "void" : model.definition.materials[material - 1].name;
}

Json moduli_json(const Moduli& moduli) { return {{"bulk", moduli.bulk}, {"shear", moduli.shear}}; }

std::string moduli_line(const char* title, const Moduli& moduli) {
  return fmt::format("  {:24} {:12.5g} {:12.5g}\n", title, moduli.bulk, moduli.shear);
}

}  // namespace

Json stiffness_json(const model::Model& model, const homogenize::Effective& effective) {
  const material::ElasticTensor& C = effective.stiffness;
  Json json{{"components", component}, {"stiffness", C.voigt}, {"asymmetry", effective.asymmetry}};
  const auto S = material::compliance(C);
  json["compliance"] = S ? Json(*S) : Json(nullptr);
  if (const auto constants = material::engineering_constants(C))
    json["engineering"] = {{"youngs_modulus", constants->youngs_modulus},
                           {"poissons_ratio", constants->poissons_ratio},
                           {"shear_modulus", constants->shear_modulus}};
  const homogenize::ClosestIsotropic closest = homogenize::closest_isotropic(C);
  json["closest_isotropic"] = moduli_json(closest.moduli);
  json["closest_isotropic"]["distance"] = closest.distance;
  json["bounds"] = {{"voigt", moduli_json(effective.bounds.voigt)},
                    {"hashin_shtrikman_upper", moduli_json(effective.bounds.hashin_upper)},
                    {"hashin_shtrikman_lower", moduli_json(effective.bounds.hashin_lower)},
                    {"reuss", moduli_json(effective.bounds.reuss)}};
  json["density"] = effective.density;
  json["porosity"] = fraction_of(effective, 0);
  for (const homogenize::Phase& phase : effective.phases)
    json["phases"][phase_name(model, phase.material)] = phase.fraction;
  if (effective.density > 0)
    for (std::size_t a = 0; a < 3; ++a)
      json["wave_speeds"][std::string(1, "xyz"[a])] = homogenize::wave_speeds(C, effective.density, axes[a]);
  for (const statics::SolveReport& solve : effective.cases)
    json["cases"].push_back({{"iterations", solve.iterations},
                             {"relative_residual", solve.relative_residual},
                             {"seconds", solve.solve_seconds}});
  json["unknowns"] = effective.cases.front().unknowns;
  json["setup_seconds"] = effective.cases.front().setup_seconds;
  return json;
}

std::vector<std::string> stiffness_columns() {
  std::vector<std::string> columns;
  for (const char* const unit : {"Pa", "1/Pa"})
    for (const std::string& name : component)
      columns.push_back(fmt::format("{} {} [{}]", *unit == 'P' ? "C" : "S", name, unit));
  return columns;
}

std::vector<std::vector<double>> stiffness_rows(const homogenize::Effective& effective) {
  const auto S = material::compliance(effective.stiffness);
  std::vector<std::vector<double>> rows;
  for (std::size_t i = 0; i < 6; ++i) {
    const auto& C = effective.stiffness.voigt[i];
    auto& row = rows.emplace_back(C.begin(), C.end());
    for (std::size_t j = 0; j < 6; ++j) row.push_back(S ? (*S)[i][j] : std::numeric_limits<double>::quiet_NaN());
  }
  return rows;
}

std::string stiffness_text(const model::Model& model, const homogenize::Effective& effective) {
  const material::ElasticTensor& C = effective.stiffness;
  std::string text = "effective stiffness C [Pa], engineering shear strains\n    ";
  for (const std::string& name : component) text += fmt::format(" {:>12}", name);
  text += '\n';
  double largest = 0;
  for (const auto& row : C.voigt)
    for (const double entry : row) largest = std::max(largest, std::abs(entry));
  for (std::size_t i = 0; i < 6; ++i) {
    text += fmt::format("  {}", component[i]);
    // What rounding leaves would hide the pattern of zeros.
    for (const double entry : C.voigt[i])
      text += fmt::format(" {:12.5g}", std::abs(entry) > 1e-12 * largest ? entry : 0.0);
    text += '\n';
  }
  text += fmt::format("  asymmetry {:.1e}\n", effective.asymmetry);

  if (const auto constants = material::engineering_constants(C)) {
    const auto& E = constants->youngs_modulus;
    const auto& nu = constants->poissons_ratio;
    const auto& G = constants->shear_modulus;
    text += fmt::format("  E x, y, z [Pa]           {:12.5g} {:12.5g} {:12.5g}\n", E[0], E[1], E[2]);
    text += fmt::format("  G yz, xz, xy [Pa]        {:12.5g} {:12.5g} {:12.5g}\n", G[0], G[1], G[2]);
    text += fmt::format("  nu yz, xz, xy            {:12.5g} {:12.5g} {:12.5g}\n", nu[1][2], nu[0][2], nu[0][1]);
  } else {
    text += "  singular: some strain meets no resistance\n";
  }

  const homogenize::ClosestIsotropic closest = homogenize::closest_isotropic(C);
  text += "                                 K [Pa]       G [Pa]\n";
  text += moduli_line("Voigt", effective.bounds.voigt);
  text += moduli_line("Hashin-Shtrikman upper", effective.bounds.hashin_upper);
  text += moduli_line("closest isotropic C", closest.moduli);
  text += moduli_line("Hashin-Shtrikman lower", effective.bounds.hashin_lower);
  text += moduli_line("Reuss", effective.bounds.reuss);
  text += fmt::format("  distance from isotropic  {:12.5g}\n", closest.distance);

  for (const homogenize::Phase& phase : effective.phases)
    text += fmt::format("  fraction of {:12} {:12.5g}\n", escaped(phase_name(model, phase.material)), phase.fraction);
  text += fmt::format("  density [kg/m^3]         {:12.5g}\n", effective.density);
  if (effective.density > 0)
    for (std::size_t a = 0; a < 3; ++a) {
      const Vec3 v = homogenize::wave_speeds(C, effective.density, axes[a]);
      text += fmt::format("  wave speeds along {} [m/s] {:11.5g} {:12.5g} {:12.5g}\n", "xyz"[a], v[0], v[1], v[2]);
    }
  std::vector<int> iterations;
  for (const statics::SolveReport& solve : effective.cases) iterations.push_back(solve.iterations);
  return text + fmt::format("  iterations of the cases  {}\n", fmt::join(iterations, " "));
}

}  // namespace koshi::driver
