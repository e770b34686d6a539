#include "report/stiffness.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "koshi/directional.h"
#include "report/directional_surface.h"

namespace koshi::report {
namespace {

using json = nlohmann::ordered_json;
using Matrix = std::array<std::array<double, 6>, 6>;

json column(const std::string& name, const char* unit = nullptr) {
  json result{{"name", name}};
  if (unit) result["unit"] = unit;
  return result;
}

// A row of the matrix is a stress, a column a strain.
json matrix_table(const json& stiffness) {
  json table{
      {"title", "Effective stiffness C"},
      {"columns", json::array({column("stress")})},
      {"rows", json::array()},
      {"heat", true},
      {"note", fmt::format("Stresses under mean strains, engineering shear strains; boundaries: {}. Asymmetry "
                           "before the matrix was made symmetric: {:.1e}.",
                           stiffness.at("boundary").get<std::string>(), stiffness.at("asymmetry").get<double>())}};
  const json& names = stiffness.at("components");
  for (const json& name : names) table["columns"].push_back(column(name.get<std::string>(), "Pa"));
  for (std::size_t i = 0; i < 6; ++i) {
    json row = json::array({names.at(i)});
    for (std::size_t j = 0; j < 6; ++j) row.push_back(stiffness.at("stiffness").at(i).at(j));
    table["rows"].push_back(std::move(row));
  }
  return table;
}

json bounds_table(const json& stiffness) {
  json table{{"title", "Moduli of the closest isotropic tensor between the bounds"},
             {"columns", {column(""), column("K", "Pa"), column("G", "Pa")}},
             {"rows", json::array()}};
  const auto add = [&](const char* name, const json& moduli) {
    table["rows"].push_back({name, moduli.at("bulk"), moduli.at("shear")});
  };
  const json& bounds = stiffness.at("bounds");
  add("Voigt", bounds.at("voigt"));
  add("Hashin-Shtrikman, upper", bounds.at("hashin_shtrikman_upper"));
  add("closest isotropic", stiffness.at("closest_isotropic"));
  add("Hashin-Shtrikman, lower", bounds.at("hashin_shtrikman_lower"));
  add("Reuss", bounds.at("reuss"));
  return table;
}

json constants_table(const json& stiffness) {
  json table{
      {"title", "Along the axes"},
      {"columns", {column(""), column("E", "Pa"), column("v_p", "m/s"), column("v_s1", "m/s"), column("v_s2", "m/s")}},
      {"rows", json::array()}};
  for (std::size_t a = 0; a < 3; ++a) {
    const std::string axis(1, "xyz"[a]);
    json row = json::array({axis});
    row.push_back(stiffness.contains("engineering") ? stiffness["engineering"].at("youngs_modulus").at(a) : json());
    for (std::size_t v = 0; v < 3; ++v)
      row.push_back(stiffness.contains("wave_speeds") ? stiffness["wave_speeds"].at(axis).at(v) : json());
    table["rows"].push_back(std::move(row));
  }
  return table;
}

json structure_table(const json& stiffness) {
  json table{{"title", "What fills the box"}, {"columns", {column(""), column("value")}}, {"rows", json::array()}};
  for (const auto& [name, fraction] : stiffness.at("phases").items())
    if (stiffness.at("phases").size() <= 20) table["rows"].push_back({"share of " + name, fraction});
  table["rows"].push_back({"pores that lead through", stiffness.at("connected_porosity")});
  table["rows"].push_back(
      {"area of the pores over the volume", {{"value", stiffness.at("specific_surface")}, {"unit", "1/m"}}});
  table["rows"].push_back({"islands of the solid", stiffness.at("islands").at("count")});
  table["rows"].push_back({"mean density", {{"value", stiffness.at("density")}, {"unit", "kg/m^3"}}});
  table["rows"].push_back({"distance from isotropic", stiffness.at("closest_isotropic").at("distance")});
  table["rows"].push_back({"distance from cubic", stiffness.at("closest_cubic").at("distance")});
  table["rows"].push_back(
      {"distance from isotropic about an axis", stiffness.at("closest_transversely_isotropic").at("distance")});
  table["rows"].push_back({"universal anisotropy", stiffness.at("universal_anisotropy")});
  return table;
}

// In each of the three planes the end points of E(n) n.
json modulus_curves(const material::ElasticTensor& C) {
  json plot{{"title", "Young's modulus by direction"},
            {"x", {{"label", "E along the first axis"}, {"unit", "Pa"}}},
            {"y", {{"label", "E along the second axis"}, {"unit", "Pa"}}},
            {"equal", true},
            {"series", json::array()},
            {"note", "The distance of the curve from the middle is Young's modulus in that direction of the plane."}};
  for (std::size_t plane = 0; plane < 3; ++plane) {
    const std::size_t second = (plane + 1) % 3;
    json x = json::array(), y = json::array();
    for (int degrees = 0; degrees <= 360; degrees += 3) {
      const double angle = degrees * std::numbers::pi / 180;
      Vec3 n{};
      n[plane] = std::cos(angle);
      n[second] = std::sin(angle);
      const double E = material::youngs_modulus(C, n).value();
      x.push_back(E * n[plane]);
      y.push_back(E * n[second]);
    }
    plot["series"].push_back({{"name", fmt::format("plane {}{}", "xyz"[plane], "xyz"[second])}, {"x", x}, {"y", y}});
  }
  return plot;
}

// The speed of one of the three waves against the angle in each plane.
json speed_curves(const material::ElasticTensor& C, double density, std::size_t wave) {
  constexpr std::array titles{"Speed v_p of the P wave", "Speed v_s1 of the faster S wave",
                              "Speed v_s2 of the slower S wave"};
  json plot{{"title", titles[wave]},
            {"x", {{"label", "from the first axis of the plane"}, {"unit", "deg"}}},
            {"y", {{"label", "speed"}, {"unit", "m/s"}}},
            {"series", json::array()}};
  for (std::size_t plane = 0; plane < 3; ++plane) {
    const std::size_t second = (plane + 1) % 3;
    json x = json::array(), y = json::array();
    for (int degrees = 0; degrees <= 180; degrees += 3) {
      const double angle = degrees * std::numbers::pi / 180;
      Vec3 n{};
      n[plane] = std::cos(angle);
      n[second] = std::sin(angle);
      x.push_back(degrees);
      y.push_back(material::wave_speeds(C, density, n)[wave]);
    }
    plot["series"].push_back({{"name", fmt::format("plane {}{}", "xyz"[plane], "xyz"[second])}, {"x", x}, {"y", y}});
  }
  return plot;
}

}  // namespace

void add_stiffness(const json& stiffness, json& data) {
  data["tables"] = {matrix_table(stiffness), constants_table(stiffness), bounds_table(stiffness),
                    structure_table(stiffness)};
  if (stiffness.at("compliance").is_null()) return;
  const material::ElasticTensor C{stiffness.at("stiffness").get<Matrix>()};
  const double density = stiffness.at("density");
  data["mesh"] = directional_surface(C, density);
  data["curves"] = json::array({modulus_curves(C)});
  for (std::size_t wave = 0; wave < 3; ++wave) data["curves"].push_back(speed_curves(C, density, wave));
}

}  // namespace koshi::report
