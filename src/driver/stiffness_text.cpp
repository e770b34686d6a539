#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/escape.h"
#include "driver/stiffness_tables.h"
#include "koshi/directional.h"
#include "mechanics/measure.h"

namespace koshi::driver {
namespace {

using homogenize::Moduli;

constexpr std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};

std::string moduli_line(const char* title, const Moduli& moduli) {
  return fmt::format("  {:24} {:12.5g} {:12.5g}\n", title, moduli.bulk, moduli.shear);
}

}  // namespace

nlohmann::ordered_json coarser_json(const homogenize::Effective& fine, const homogenize::Effective& coarse) {
  const Moduli at_d = homogenize::closest_isotropic(fine.stiffness).moduli;
  const Moduli at_2d = homogenize::closest_isotropic(coarse.stiffness).moduli;
  const auto moduli = [](double bulk, double shear) {
    return nlohmann::ordered_json{{"bulk", bulk}, {"shear", shear}};
  };
  return {{"closest_isotropic", moduli(at_2d.bulk, at_2d.shear)},
          {"extrapolated", moduli(2 * at_d.bulk - at_2d.bulk, 2 * at_d.shear - at_2d.shear)},
          {"uncertainty", moduli(std::abs(at_d.bulk - at_2d.bulk), std::abs(at_d.shear - at_2d.shear))}};
}

std::string coarser_text(const homogenize::Effective& fine, const homogenize::Effective& coarse) {
  const nlohmann::ordered_json json = coarser_json(fine, coarse);
  const auto line = [&](const char* title, const char* key) {
    return moduli_line(title, {json[key]["bulk"], json[key]["shear"]});
  };
  return "                                 K [Pa]       G [Pa]\n" +
         line("with twice the spacing", "closest_isotropic") + line("extrapolated", "extrapolated") +
         line("uncertainty", "uncertainty");
}

std::string boxes_text(const std::vector<BoxSample>& samples) {
  if (samples.empty() || samples.front().moduli.empty()) return "";
  std::string text = "  boxes of cells       K [Pa]    deviation       G [Pa]    deviation\n";
  for (const auto& row : box_rows(samples))
    text += fmt::format("  {:4} of {:5}^3 {:12.5g} {:12.5g} {:12.5g} {:12.5g}\n", row[1], row[0], row[2], row[3],
                        row[4], row[5]);
  return text;
}

std::string boundary_name(homogenize::Boundary boundary) {
  constexpr std::array names{"periodic", "displacement", "traction", "mixed"};
  return names[static_cast<std::size_t>(boundary)];
}

std::string stiffness_text(const model::Model& model, const homogenize::Effective& effective) {
  const material::ElasticTensor& C = effective.stiffness;
  const std::vector<std::string> component = mechanics::component_names(model::ProbeDefinition::Quantity::stress);
  std::string text = "effective stiffness C [Pa], engineering shear strains\n    ";
  for (const std::string& name : component) text += fmt::format(" {:>12}", name);
  text += '\n';
  double largest = 0;
  for (const auto& row : C.voigt)
    for (const double entry : row) largest = std::max(largest, std::abs(entry));
  for (std::size_t i = 0; i < 6; ++i) {
    text += fmt::format("  {}", component[i]);
    // What rounding and the tolerance leave would hide the pattern of zeros.
    for (const double entry : C.voigt[i])
      text += fmt::format(" {:12.5g}", std::abs(entry) > 1e-9 * largest ? entry : 0.0);
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

  text += fmt::format("  boundaries               {:>12}\n", boundary_name(effective.boundary));
  const homogenize::ClosestIsotropic closest = homogenize::closest_isotropic(C);
  text += "                                 K [Pa]       G [Pa]\n";
  text += moduli_line("Voigt", effective.bounds.voigt);
  text += moduli_line("Hashin-Shtrikman upper", effective.bounds.hashin_upper);
  text += moduli_line("closest isotropic C", closest.moduli);
  text += moduli_line("Hashin-Shtrikman lower", effective.bounds.hashin_lower);
  text += moduli_line("Reuss", effective.bounds.reuss);
  text += fmt::format("  distance from isotropic  {:12.5g}\n", closest.distance);
  text += fmt::format("  distance from cubic      {:12.5g}\n", homogenize::closest_cubic(C).distance);
  const homogenize::Closest transverse = homogenize::closest_transverse(C);
  const Vec3& axis = transverse.axes[2];
  text += fmt::format("  from isotropic about an axis {:8.5g}  ({:.3f}, {:.3f}, {:.3f})\n", transverse.distance,
                      axis[0], axis[1], axis[2]);
  if (const auto anisotropy = homogenize::universal_anisotropy(C))
    text += fmt::format("  universal anisotropy     {:12.5g}\n", *anisotropy);

  constexpr std::size_t most_shown = 20;
  for (const homogenize::Phase& phase : effective.phases)
    if (effective.phases.size() <= most_shown)
      text += fmt::format("  fraction of {:12} {:12.5g}\n", escaped(phase_name(model, phase.material)), phase.fraction);
  const homogenize::Structure& structure = effective.structure;
  if (structure.porosity > 0) {
    text += fmt::format("  connected porosity       {:12.5g}\n", structure.connected_porosity);
    text += fmt::format("  specific surface [1/m]   {:12.5g}\n", structure.specific_surface);
  }
  if (structure.islands > 0)
    text += fmt::format("  {} of the solid, {:.2g} of the box, hang{} free\n",
                        structure.islands == 1 ? "an island" : fmt::format("{} islands", structure.islands),
                        structure.island_fraction, structure.islands == 1 ? "s" : "");
  text += fmt::format("  density [kg/m^3]         {:12.5g}\n", effective.density);
  if (effective.density > 0)
    for (std::size_t a = 0; a < 3; ++a) {
      const Vec3 v = material::wave_speeds(C, effective.density, axes[a]);
      text += fmt::format("  wave speeds along {} [m/s] {:11.5g} {:12.5g} {:12.5g}\n", "xyz"[a], v[0], v[1], v[2]);
    }
  std::vector<int> iterations;
  for (const statics::SolveReport& solve : effective.cases) iterations.push_back(solve.iterations);
  return text + fmt::format("  iterations of the cases  {}\n", fmt::join(iterations, " "));
}

}  // namespace koshi::driver
