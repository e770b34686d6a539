#include "report/directional_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "io/report_block.h"

namespace koshi::report {
namespace {

using json = nlohmann::ordered_json;

// Circles of latitude and meridians of the directions.
constexpr int circles = 60, meridians = 120;

std::vector<Vec3> directions() {
  std::vector<Vec3> list;
  for (int i = 0; i <= circles; ++i)
    for (int j = 0; j < meridians; ++j) {
      const double down = std::numbers::pi * i / circles, around = 2 * std::numbers::pi * j / meridians;
      list.push_back({std::sin(down) * std::cos(around), std::sin(down) * std::sin(around), std::cos(down)});
    }
  return list;
}

// Counter-clockwise seen from outside; those at the poles have two corners in one place.
std::vector<std::int32_t> quads() {
  std::vector<std::int32_t> list;
  for (int i = 0; i < circles; ++i)
    for (int j = 0; j < meridians; ++j) {
      const int next = (j + 1) % meridians;
      for (const int corner :
           {meridians * i + j, meridians * (i + 1) + j, meridians * (i + 1) + next, meridians * i + next})
        list.push_back(corner);
    }
  return list;
}

json scalar(const std::vector<float>& values, const char* unit) {
  return {{"kind", "scalar"}, {"on", "points"}, {"unit", unit}, {"data", io::encoded(std::span<const float>(values))}};
}

}  // namespace

json directional_surface(const material::ElasticTensor& C, double density) {
  const std::vector<Vec3> along = directions();
  std::vector<float> modulus;
  std::array<std::vector<float>, 3> speeds;
  for (const Vec3& n : along) {
    modulus.push_back(static_cast<float>(material::youngs_modulus(C, n).value()));
    const Vec3 v = material::wave_speeds(C, density, n);
    for (std::size_t wave = 0; wave < 3; ++wave) speeds[wave].push_back(static_cast<float>(v[wave]));
  }
  const float largest = *std::max_element(modulus.begin(), modulus.end());
  std::vector<float> points;
  for (std::size_t p = 0; p < along.size(); ++p)
    for (const double x : along[p]) points.push_back(static_cast<float>(x) * modulus[p] / largest);

  const std::vector<std::int32_t> corners = quads();
  json fields{{"Young's modulus", scalar(modulus, "Pa")}};
  constexpr std::array names{"v_p", "v_s1", "v_s2"};
  for (std::size_t wave = 0; wave < 3; ++wave) fields[names[wave]] = scalar(speeds[wave], "m/s");
  json samples = json::array();
  samples.push_back({{"fields", fields}});
  return {{"title", "Young's modulus by direction"},
          {"unit", "1"},
          {"smooth", true},
          {"points", io::encoded(std::span<const float>(points))},
          {"quads", io::encoded(std::span<const std::int32_t>(corners))},
          {"samples", samples},
          {"note",
           "The distance of the surface from the middle is Young's modulus in that direction, over the largest; the "
           "colours may show the speeds of waves along it instead."}};
}

}  // namespace koshi::report
