#include <fmt/format.h>

#include "calibration/calibrate.h"
#include "calibration/words.h"
#include "model/choices.h"

namespace koshi::calibration {
namespace {

using nlohmann::json;

json input(const Calibrated& c) {
  json input{{"cell", lattice::name(c.lattice.cell)},
             {"spacing", c.lattice.spacing},
             {"springs", model::choice_name(c.lattice.springs)},
             {"calibration", model::choice_name(*c.lattice.calibration)},
             {"kinematics", model::choice_name(c.lattice.kinematics)},
             {"youngs_modulus", c.elastic.youngs_modulus},
             {"poissons_ratio", c.elastic.poissons_ratio},
             {"density", c.elastic.density},
             {"bonds", c.bonds}};
  if (c.lattice.calibration == material::Calibration::paper) {
    input["equations"] = c.lattice.equations;
    input["axes"] = c.lattice.axes;
  }
  if (c.cells) input["cells"] = *c.cells;
  return input;
}

json constants(const material::EngineeringConstants& constants) {
  return {{"youngs_modulus", constants.youngs_modulus},
          {"poissons_ratio", constants.poissons_ratio},
          {"shear_modulus", constants.shear_modulus},
          {"zener_ratio", constants.zener_ratio}};
}

json self_check(const mechanics::SelfCheck& check) {
  return {{"verdict", name(check.verdict)},
          {"reason", check.reason},
          {"remedy", check.remedy},
          {"stiffness_tensor", check.C.voigt},
          {"stiffness_error", check.C_error},
          {"energy_ratio",
           {{"bending", check.energy.bending},
            {"dome_bending", check.energy.dome_bending},
            {"saddle_bending", check.energy.saddle_bending},
            {"beam_bending", check.energy.beam_bending},
            {"torsion", check.energy.torsion}}},
          {"cell",
           {{"least_eigenvalue", check.cell.least},
            {"smallest_nonzero_eigenvalue", check.cell.smallest_nonzero},
            {"zero_modes_beyond_rigid", check.cell.zero_modes_beyond_rigid}}},
          {"zone",
           {{"least_squared_frequency", check.zone.least},
            {"least_phase", check.zone.least_phase},
            {"largest_squared_frequency", check.zone.largest},
            {"wave_vectors", check.zone.vectors},
            {"soft_wave_vectors", check.zone.soft_vectors}}}};
}

}  // namespace

json calibration_json(const Calibrated& c) {
  json springs{{"kappa", c.springs.kappa}};
  for (int family = 0; family < lattice::families_of(c.lattice.cell); ++family)
    springs[std::string(family_names[family])] = {{"kn", c.springs.kn[family]}, {"kt", c.springs.kt[family]}};

  json dispersion = json::array();
  for (const mechanics::DispersionRow& row : c.check.dispersion)
    dispersion.push_back({{"direction", direction_name(row.direction)},
                          {"cells_per_wavelength", row.cells},
                          {"p", row.speeds.p},
                          {"s_slow", row.speeds.s_slow},
                          {"s_fast", row.speeds.s_fast}});

  return {
      {"input", input(c)},
      {"springs", springs},
      {"stiffness_tensor", c.C.voigt},
      {"target_tensor", c.check.target.voigt},
      {"constants", c.constants ? constants(*c.constants) : json()},
      {"wave_speeds", {{"p", c.elastic.p_wave_speed()}, {"s", c.elastic.s_wave_speed()}}},
      {"time_step", {{"d_over_p", c.lattice.spacing / c.elastic.p_wave_speed()}, {"bulk_limit", c.check.bulk_step}}},
      {"self_check", self_check(c.check)},
      {"note", c.note},
      {"dispersion", dispersion}};
}

std::string dispersion_csv(const Calibrated& c) {
  std::string csv =
      "direction,cells_per_wavelength,p [m/s],s_slow [m/s],s_fast [m/s],p_ratio,s_slow_ratio,s_fast_ratio\n";
  const double p = c.elastic.p_wave_speed(), s = c.elastic.s_wave_speed();
  for (const mechanics::DispersionRow& row : c.check.dispersion)
    csv += fmt::format("{},{},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}\n", direction_name(row.direction), row.cells,
                       row.speeds.p, row.speeds.s_slow, row.speeds.s_fast, row.speeds.p / p, row.speeds.s_slow / s,
                       row.speeds.s_fast / s);
  return csv;
}

}  // namespace koshi::calibration
