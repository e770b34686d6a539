#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <fstream>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "base/suggest.h"
#include "calibration/calibrate.h"
#include "commands.h"
#include "driver/strength_tests.h"
#include "io/units.h"
#include "koshi/error.h"
#include "model/choices.h"
#include "model/ranges.h"

namespace koshi::app {
namespace {

/// The options as they stand on the command line; quantities may carry units.
struct Options {
  std::string cell{lattice::name(lattice::CellType::cube_iii)};
  std::string youngs_modulus, poissons_ratio, spacing;
  std::string density = "2000 kg/m^3";
  std::vector<std::string> size;
  std::string springs = "shared", calibration, kinematics = "rotational";
  std::vector<std::string> equations;
  std::string axes = "xyz";
  bool strength = false;
  std::string tensile_strength, fracture_energy, softening = "exponential", cohesion, friction_angle = "0 deg";
  bool json = false;
  std::string dispersion;
};

/// The enumerator a word stands for; the option is the place of the error.
template <class E>
E choose(const std::string& option, const std::string& word) {
  for (const auto& choice : model::choices<E>)
    if (choice.name == word) return choice.value;
  const std::vector<std::string> known = model::choice_names<E>();
  throw InputError(Place{option}, fmt::format("\"{}\" is not known; {}", word, suggestion(word, known)));
}

// The value of an option that is a quantity.
double quantity(const std::string& option, const std::string& text, io::Dimension dimension,
                const model::Range& range) {
  const Place place{"--" + option};
  const double value = io::parse_quantity(text, dimension, place);
  model::require(range, option, value, place);
  return value;
}

model::LatticeDefinition read_lattice(const Options& options) {
  model::LatticeDefinition lattice;
  lattice.cell = choose<lattice::CellType>("--cell", options.cell);
  lattice.spacing = quantity("spacing", options.spacing, io::Dimension::length, model::ranges::spacing);
  lattice.springs = choose<material::Sharing>("--springs", options.springs);
  if (!options.calibration.empty())
    lattice.calibration = choose<material::Calibration>("--calibration", options.calibration);
  lattice.kinematics = choose<material::Kinematics>("--kinematics", options.kinematics);
  lattice.equations = options.equations;
  lattice.axes = options.axes;
  return lattice;
}

// What --strength tests; empty without it.
std::optional<material::Fracture> read_fracture(const Options& options) {
  if (!options.strength) {
    for (const auto& [option, given] : {std::pair{"--tensile-strength", !options.tensile_strength.empty()},
                                        {"--fracture-energy", !options.fracture_energy.empty()},
                                        {"--cohesion", !options.cohesion.empty()}})
      if (given) throw InputError(Place{option}, "belongs to the tests of strength; add --strength, or leave it out");
    return std::nullopt;
  }
  if (options.tensile_strength.empty() || options.fracture_energy.empty())
    throw InputError(Place{"--strength"},
                     "needs --tensile-strength such as \"3 MPa\" and --fracture-energy such as \"100 J/m^2\"");
  material::Fracture fracture;
  fracture.tensile_strength =
      quantity("tensile-strength", options.tensile_strength, io::Dimension::pressure, model::ranges::strength);
  fracture.fracture_energy = quantity("fracture-energy", options.fracture_energy, io::Dimension::energy_per_area,
                                      model::ranges::fracture_energy);
  fracture.softening = choose<material::Softening>("--softening", options.softening);
  if (!options.cohesion.empty())
    fracture.cohesion = quantity("cohesion", options.cohesion, io::Dimension::pressure, model::ranges::strength);
  fracture.friction_angle =
      quantity("friction-angle", options.friction_angle, io::Dimension::angle, model::ranges::friction_angle);
  return fracture;
}

void run(const Options& options) {
  const model::LatticeDefinition lattice = read_lattice(options);
  const material::Elastic elastic{
      quantity("youngs-modulus", options.youngs_modulus, io::Dimension::pressure, model::ranges::youngs_modulus),
      quantity("poissons-ratio", options.poissons_ratio, io::Dimension::number, model::ranges::poissons_ratio),
      quantity("density", options.density, io::Dimension::density, model::ranges::density)};
  std::optional<Vec3> size;
  if (!options.size.empty()) {
    size.emplace();
    for (int axis = 0; axis < 3; ++axis)
      (*size)[axis] = quantity("size", options.size[axis], io::Dimension::length, model::ranges::size);
  }

  const std::optional<material::Fracture> fracture = read_fracture(options);

  const calibration::Calibrated calibrated = calibration::calibrate(lattice, elastic, size);
  std::optional<driver::StrengthReport> strength;
  if (fracture) strength = driver::test_strength(lattice, elastic, *fracture);
  if (options.json) {
    nlohmann::ordered_json json = calibration::calibration_json(calibrated);
    if (strength) json["strength"] = driver::strength_json(*strength);
    std::cout << json.dump(2) << '\n';
  } else {
    std::cout << calibration::calibration_report(calibrated) << (strength ? driver::strength_text(*strength) : "");
  }
  if (!options.dispersion.empty()) {
    std::ofstream file(options.dispersion);
    if (!(file << calibration::dispersion_csv(calibrated) << std::flush))
      throw InputError(Place{"--dispersion"}, fmt::format("cannot write \"{}\"", options.dispersion));
  }
  // The report says so too; the exit code tells scripts.
  if (calibrated.check.verdict == mechanics::Verdict::refuse)
    throw InputError(fmt::format("{}; {}", calibrated.check.reason, calibrated.check.remedy));
}

}  // namespace

void add_calibrate_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "calibrate", "Springs from Young's modulus and Poisson's ratio, and what they give; quantities may carry units");
  const auto options = std::make_shared<Options>();
  command->add_option("--cell", options->cell, "Unit cell: cube-I, cube-II or cube-III")->capture_default_str();
  command->add_option("--youngs-modulus", options->youngs_modulus, "Young's modulus, such as \"1112 MPa\"")->required();
  command->add_option("--poissons-ratio", options->poissons_ratio, "Poisson's ratio, between -1 and 0.5")->required();
  command->add_option("--spacing", options->spacing, "Side of a cell, such as \"0.2 cm\"")->required();
  command->add_option("--density", options->density, "Density, for wave speeds and time steps")->capture_default_str();
  command
      ->add_option("--size", options->size,
                   "Three sizes of the body whose bonds are summed; without them the unit cell inside the bulk")
      ->expected(3);
  command->add_option("--springs", options->springs, "shared or plain")->capture_default_str();
  command->add_option(
      "--calibration", options->calibration,
      "bending-exact, beam-exact, isotropic or paper; unset: bending-exact for shared Cube-III, isotropic for shared "
      "Cube-I and -II, paper for plain springs");
  command->add_option("--kinematics", options->kinematics, "rotational or least-squares")->capture_default_str();
  command
      ->add_option("--equations", options->equations,
                   "Calibration paper: entries of C set equal to the elastic tensor, such as C1122 C1212")
      ->expected(1, 2);
  command->add_option("--axes", options->axes, "Calibration paper: which body axes are 1, 2, 3 of C")
      ->capture_default_str();
  command->add_flag("--strength", options->strength,
                    "Also break small blocks along [100], [110] and [111]: strength, energy of cracks, spacing limit");
  command->add_option("--tensile-strength", options->tensile_strength, "With --strength, such as \"3 MPa\"");
  command->add_option("--fracture-energy", options->fracture_energy, "With --strength, such as \"100 J/m^2\"");
  command->add_option("--softening", options->softening, "With --strength: exponential or linear")
      ->capture_default_str();
  command->add_option("--cohesion", options->cohesion, "With --strength, such as \"8 MPa\"; unset: no shear limit");
  command->add_option("--friction-angle", options->friction_angle, "With --strength and --cohesion")
      ->capture_default_str();
  command->add_flag("--json", options->json, "Print JSON in SI units");
  command->add_option("--dispersion", options->dispersion, "Write wave speeds over wavelength to this CSV file");
  command->callback([options] { run(*options); });
}

}  // namespace koshi::app
