// An effective stiffness on the page: its tables, and the curves of Young's modulus.
#include "report/stiffness.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/report_array.h"

namespace koshi::report {
namespace {

using json = nlohmann::ordered_json;

// Orthotropic, E = 10, 20, 40 GPa along x, y, z without contraction; the rest is as in a stiffness.json.
json stiffness_of_boards() {
  json stiffness = json::array(), compliance = json::array();
  const double diagonal[6] = {10e9, 20e9, 40e9, 8e9, 5e9, 4e9};
  for (std::size_t i = 0; i < 6; ++i) {
    stiffness.push_back(json::array());
    compliance.push_back(json::array());
    for (std::size_t j = 0; j < 6; ++j) {
      stiffness[i].push_back(i == j ? diagonal[i] : 0);
      compliance[i].push_back(i == j ? 1 / diagonal[i] : 0);
    }
  }
  const json moduli{{"bulk", 1e9}, {"shear", 2e9}, {"distance", 0.1}};
  return {
      {"boundary", "periodic"},
      {"components", {"xx", "yy", "zz", "yz", "xz", "xy"}},
      {"stiffness", stiffness},
      {"compliance", compliance},
      {"asymmetry", 1e-9},
      {"engineering", {{"youngs_modulus", {10e9, 20e9, 40e9}}}},
      {"closest_isotropic", moduli},
      {"closest_cubic", moduli},
      {"closest_transversely_isotropic", moduli},
      {"universal_anisotropy", 0.5},
      {"bounds",
       {{"voigt", moduli}, {"hashin_shtrikman_upper", moduli}, {"hashin_shtrikman_lower", moduli}, {"reuss", moduli}}},
      {"phases", {{"void", 0.25}, {"wood", 0.75}}},
      {"connected_porosity", 0.2},
      {"specific_surface", 100},
      {"islands", {{"count", 3}, {"fraction", 0.01}}},
      {"density", 700}};
}

TEST(ReportStiffness, TablesAndCurves) {
  json data;
  add_stiffness(stiffness_of_boards(), data);
  ASSERT_EQ(data["tables"].size(), 4u);
  const json& matrix = data["tables"][0];
  EXPECT_EQ(matrix["heat"], true);
  ASSERT_EQ(matrix["rows"].size(), 6u);
  for (const json& row : matrix["rows"]) EXPECT_EQ(row.size(), matrix["columns"].size());
  EXPECT_EQ(matrix["rows"][2][0], "zz");
  EXPECT_EQ(matrix["rows"][2][3], 40e9);
  // Three planes; at 0 and 90 degrees the modulus along the axes, at 45 between x and y
  // 4 / (1/E_x + 1/E_y + 1/G_xy) = 10 GPa.
  ASSERT_EQ(data["curves"].size(), 4u);
  const json& series = data["curves"][0]["series"];
  ASSERT_EQ(series.size(), 3u);
  EXPECT_EQ(data["curves"][0]["equal"], true);
  const double along[3] = {10e9, 20e9, 40e9};
  for (std::size_t plane = 0; plane < 3; ++plane) {
    EXPECT_NEAR(series[plane]["x"][0].get<double>() / along[plane], 1, 1e-12);
    EXPECT_NEAR(series[plane]["y"][30].get<double>() / along[(plane + 1) % 3], 1, 1e-12);
  }
  const double x = series[0]["x"][15], y = series[0]["y"][15];
  EXPECT_NEAR(std::hypot(x, y) / 10e9, 1, 1e-12);
  // Waves along y: rho v^2 = C_22 and the shears G_yz = 8, G_xy = 4 GPa; y is at 90 degrees of plane xy, at 0 of yz and
  // at neither of zx, whose 180 degrees are -z.
  const double squares[3] = {20e9, 8e9, 4e9};
  for (std::size_t wave = 0; wave < 3; ++wave) {
    const json& planes = data["curves"][1 + wave]["series"];
    EXPECT_EQ(planes[0]["x"][30], 90);
    EXPECT_NEAR(planes[0]["y"][30].get<double>() / std::sqrt(squares[wave] / 700), 1, 1e-12);
    EXPECT_NEAR(planes[1]["y"][0].get<double>() / std::sqrt(squares[wave] / 700), 1, 1e-12);
    EXPECT_NEAR(planes[2]["y"][0].get<double>() / planes[2]["y"][60].get<double>(), 1, 1e-12);
  }
}

TEST(ReportStiffness, ASurfaceShowsYoungsModulusByDirection) {
  json data;
  add_stiffness(stiffness_of_boards(), data);
  const json& mesh = data["mesh"];
  EXPECT_EQ(mesh["smooth"], true);
  const auto points = test::decoded<float>(mesh["points"], 3 * 61 * 120);
  const auto quads = test::decoded<std::int32_t>(mesh["quads"], 4 * 60 * 120);
  const auto modulus = test::decoded<float>(mesh["samples"][0]["fields"]["Young's modulus"]["data"], 61 * 120);
  ASSERT_EQ(points.size(), 3u * 61 * 120);
  ASSERT_EQ(modulus.size(), 61u * 120);
  ASSERT_EQ(quads.size(), 4u * 60 * 120);
  // Each point is as far from the middle as its modulus says; 1 / E = sum S_ii n_i^4 + sum n_j^2 n_k^2 / G.
  double largest = 0;
  for (std::size_t p = 0; p < modulus.size(); ++p) {
    const double x = points[3 * p], y = points[3 * p + 1], z = points[3 * p + 2];
    const double r = std::sqrt(x * x + y * y + z * z), a = x * x / r / r, b = y * y / r / r, c = z * z / r / r;
    const double E = 1 / (a * a / 10e9 + b * b / 20e9 + c * c / 40e9 + b * c / 8e9 + a * c / 5e9 + a * b / 4e9);
    EXPECT_NEAR(modulus[p] / E, 1, 1e-5);
    EXPECT_NEAR(r * 40e9 / E, 1, 1e-5);
    largest = std::max(largest, r);
  }
  EXPECT_NEAR(largest, 1, 1e-6);
  // Seen from outside corners go round counter-clockwise: six times the volume is positive.
  double volume = 0;
  for (std::size_t q = 0; q < quads.size(); q += 4)
    for (const std::size_t third : {2, 3}) {
      const auto at = [&](std::size_t corner, int axis) { return points[3 * quads[q + corner] + axis]; };
      for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        volume += at(0, i) * (at(third - 1, j) * at(third, k) - at(third - 1, k) * at(third, j));
      }
    }
  EXPECT_GT(volume, 0.1);
}

TEST(ReportStiffness, ASingularOneHasNoCurves) {
  json stiffness = stiffness_of_boards(), data;
  stiffness["compliance"] = nullptr;
  stiffness.erase("engineering");
  add_stiffness(stiffness, data);
  EXPECT_FALSE(data.contains("curves"));
  EXPECT_FALSE(data.contains("mesh"));
  EXPECT_TRUE(data["tables"][1]["rows"][0][1].is_null());
  stiffness.erase("bounds");
  EXPECT_THROW(add_stiffness(stiffness, data), json::exception);
}

}  // namespace
}  // namespace koshi::report
