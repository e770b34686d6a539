#include "driver/stiffness_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "koshi/directional.h"
#include "mechanics/measure.h"

namespace koshi::driver {

std::string phase_name(const model::Model& model, std::uint16_t material) {
  return material == 0 ? "void" : model.definition.materials[material - 1].name;
}

namespace {

using Json = nlohmann::ordered_json;
using homogenize::Moduli;

const std::vector<std::string> component = mechanics::component_names(model::ProbeDefinition::Quantity::stress);
constexpr std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};

Json moduli_json(const Moduli& moduli) { return {{"bulk", moduli.bulk}, {"shear", moduli.shear}}; }

Json closest_json(const homogenize::Closest& closest) {
  return {{"distance", closest.distance}, {"axes", closest.axes}, {"stiffness", closest.tensor.voigt}};
}

}  // namespace

Json stiffness_json(const model::Model& model, const homogenize::Effective& effective) {
  const material::ElasticTensor& C = effective.stiffness;
  Json json{{"boundary", boundary_name(effective.boundary)},
            {"components", component},
            {"stiffness", C.voigt},
            {"asymmetry", effective.asymmetry}};
  const auto S = material::compliance(C);
  json["compliance"] = S ? Json(*S) : Json(nullptr);
  if (const auto constants = material::engineering_constants(C))
    json["engineering"] = {{"youngs_modulus", constants->youngs_modulus},
                           {"poissons_ratio", constants->poissons_ratio},
                           {"shear_modulus", constants->shear_modulus}};
  const homogenize::ClosestIsotropic closest = homogenize::closest_isotropic(C);
  json["closest_isotropic"] = moduli_json(closest.moduli);
  json["closest_isotropic"]["distance"] = closest.distance;
  json["closest_cubic"] = closest_json(homogenize::closest_cubic(C));
  json["closest_transversely_isotropic"] = closest_json(homogenize::closest_transverse(C));
  const auto anisotropy = homogenize::universal_anisotropy(C);
  json["universal_anisotropy"] = anisotropy ? Json(*anisotropy) : Json(nullptr);
  json["bounds"] = {{"voigt", moduli_json(effective.bounds.voigt)},
                    {"hashin_shtrikman_upper", moduli_json(effective.bounds.hashin_upper)},
                    {"hashin_shtrikman_lower", moduli_json(effective.bounds.hashin_lower)},
                    {"reuss", moduli_json(effective.bounds.reuss)}};
  json["density"] = effective.density;
  const homogenize::Structure& structure = effective.structure;
  json["porosity"] = structure.porosity;
  json["connected_porosity"] = structure.connected_porosity;
  json["connected_porosity_along"] = structure.through;
  json["specific_surface"] = structure.specific_surface;
  json["islands"] = {{"count", structure.islands}, {"fraction", structure.island_fraction}};
  for (const homogenize::Phase& phase : effective.phases)
    json["phases"][phase_name(model, phase.material)] = phase.fraction;
  for (const homogenize::PhaseMeans& means : effective.means)
    json["phase_means"][phase_name(model, means.material)] = {{"stress", means.stress}, {"strain", means.strain}};
  if (effective.density > 0)
    for (std::size_t a = 0; a < 3; ++a)
      json["wave_speeds"][std::string(1, "xyz"[a])] = material::wave_speeds(C, effective.density, axes[a]);
  for (const statics::SolveReport& solve : effective.cases)
    json["cases"].push_back({{"iterations", solve.iterations},
                             {"relative_residual", solve.relative_residual},
                             {"seconds", solve.solve_seconds}});
  json["unknowns"] = effective.cases.front().unknowns;
  json["setup_seconds"] = effective.cases.front().setup_seconds;
  return json;
}

std::vector<std::string> direction_columns() {
  return {"n x [1]", "n y [1]", "n z [1]", "E [Pa]", "v_p [m/s]", "v_s1 [m/s]", "v_s2 [m/s]"};
}

std::vector<std::vector<double>> direction_rows(const homogenize::Effective& effective) {
  constexpr double missing = std::numeric_limits<double>::quiet_NaN();
  std::vector<std::vector<double>> rows;
  for (std::size_t plane = 0; plane < 3; ++plane)
    for (int degrees = 0; degrees < 180; degrees += 5) {
      const double angle = degrees * std::numbers::pi / 180;
      Vec3 n{};
      n[plane] = std::cos(angle);
      n[(plane + 1) % 3] = std::sin(angle);
      const auto E = material::youngs_modulus(effective.stiffness, n);
      const Vec3 v = effective.density > 0 ? material::wave_speeds(effective.stiffness, effective.density, n)
                                           : Vec3{missing, missing, missing};
      rows.push_back({n[0], n[1], n[2], E.value_or(missing), v[0], v[1], v[2]});
    }
  return rows;
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

}  // namespace koshi::driver
