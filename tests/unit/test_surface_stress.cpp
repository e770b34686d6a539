// Stress at surfaces and in cut cells, recovered from the cells there.
#include "mechanics/surface_stress.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "koshi/input.h"
#include "koshi/model.h"
#include "lattice/halo.h"
#include "mechanics/measure.h"
#include "mechanics/percentile.h"

namespace koshi::mechanics {
namespace {

// A ball of radius 0.83 of one material in a cube of 16^3 cells of 1/8, its middle beside the nodes.
model::Model ball(const std::string& rest = "") {
  return model::make_model(io::load_files(io::read_case_text(R"([lattice]
spacing = 0.125
[material.rock]
youngs_modulus = 1e9
poissons_ratio = 0.2
density = 1
[body]
origin = [-1, -1, -1]
size = [2, 2, 2]
material = "void"
surface = "cut"
[[region]]
name = "ball"
shape = "sphere"
center = [0.03, 0.01, -0.02]
radius = 0.83
material = "rock"
)" + rest,
                                                             "case.toml")),
                           Communicator::world());
}

// Displacements (a x + b x y + q x y z, c x y, 0), which the corners of cells hold exactly: e_xx = a + b y + q y z,
// e_yy = c x, 2 e_xy = b x + q x z + c y, 2 e_xz = q x y.
constexpr double a = 1e-4, b = 3e-4, c = -2e-4;
void bend(const model::Model& model, lattice::Field<double>& u, double q = 0) {
  lattice::for_each_owned(model.layout(), [&](auto i, auto j, auto k, auto n) {
    const Vec3 x = model.lattice.grid.position(model.layout().global({i, j, k}));
    u.component(0)[n] = a * x[0] + b * x[0] * x[1] + q * x[0] * x[1] * x[2];
    u.component(1)[n] = c * x[0] * x[1];
  });
  model.lattice.halo->exchange(u);
}

// Linear fields are met at places of cut cells. So are quadratic ones, but for the few where the cells around do not
// tell a curvature, which is taken as none: a fifth of what it changes over a cell.
void expect_exact(double q) {
  const model::Model model = ball();
  lattice::Field<double> u(model.layout(), 6);
  bend(model, u, q);
  std::vector<std::int64_t> cut;
  std::vector<Vec3> centre;
  lattice::for_each_owned(model.layout(), [&](auto i, auto j, auto k, auto n) {
    if (model.lattice.cell.component(0)[n] == 0 || model.lattice.fraction_of(n) == 1) return;
    cut.push_back(n);
    centre.push_back(model.lattice.grid.position(model.layout().global({i, j, k})) + Vec3{0.0625, 0.0625, 0.0625});
  });
  ASSERT_GT(cut.size(), 500u);
  SurfaceStress surface(model.lattice, cut);
  surface.update(u);
  // Isotropic elasticity with lambda = E nu/((1 + nu)(1 - 2 nu)), 2 mu = E/(1 + nu).
  const double lambda = 1e9 * 0.2 / (1.2 * 0.6), mu2 = 1e9 / 1.2;
  double worst_part = -1;
  const double loose = 1e-12 + 0.2 * q * 0.125 * 0.125;
  std::size_t exact = 0;
  for (std::size_t p = 0; p < cut.size(); ++p) {
    const Vec3 from{0.3, -0.2, 0.4};
    const Vec3 x = centre[p] + 0.125 * from;
    const double xx = a + b * x[1] + q * x[1] * x[2], yy = c * x[0];
    const double xy = 0.5 * (b * x[0] + q * x[0] * x[2] + c * x[1]);
    const SurfaceStress::Value value = surface.at(cut[p], from);
    EXPECT_NEAR(value.strain[0], xx, loose);
    EXPECT_NEAR(value.strain[1], yy, 1e-12);
    EXPECT_NEAR(value.strain[4], 0.5 * q * x[0] * x[1], loose);
    EXPECT_NEAR(value.strain[5], xy, loose);
    exact += std::abs(value.strain[0] - xx) < 1e-12 && std::abs(value.strain[5] - xy) < 1e-12;
    EXPECT_NEAR(value.stress[0], lambda * (xx + yy) + mu2 * xx, 1 + 2e9 * loose);
    EXPECT_NEAR(value.stress[2], lambda * (xx + yy), 1 + 2e9 * loose);
    EXPECT_NEAR(value.stress[5], mu2 * xy, 1 + 2e9 * loose);
    // The middle of the part inside lies inside: a ball is convex.
    const Vec3 part = centre[p] + 0.125 * surface.middle_of_part(cut[p]);
    worst_part = std::max(worst_part, norm(part - Vec3{0.03, 0.01, -0.02}) - 0.83);
  }
  EXPECT_GE(exact, cut.size() - cut.size() / 10);
  EXPECT_LT(worst_part, 0);
  EXPECT_GT(worst_part, -0.05 * 0.125);
}
TEST(SurfaceStress, IsExactWhereItIsLinear) { expect_exact(0); }
TEST(SurfaceStress, IsExactWhereItIsQuadratic) { expect_exact(5e-4); }

TEST(SurfaceStress, OfProbesOnASurface) {
  // Means over the sphere of a strain that is linear in x and y: that at its middle; percentile and maximum by size.
  std::string probes;
  for (const char* reduce : {"mean", "area-mean", "max", "percentile"})
    probes += fmt::format("[[probe]]\nname = \"{}\"\nsurface = \"ball\"\nquantity = \"strain\"\nreduce = \"{}\"\n{}",
                          reduce, reduce, std::string(reduce) == "percentile" ? "percentile = 50\n" : "");
  const model::Model model = ball(probes);
  ASSERT_EQ(model.probes.size(), 4u);
  EXPECT_GT(model.probes[0].places.size(), 2000u);
  EXPECT_TRUE(model.probes[0].nodes.empty());
  EXPECT_NEAR(model.probes[0].total, 4 * std::numbers::pi * 0.83 * 0.83, 0.01);
  model::State state(model);
  bend(model, state.displacement);
  ForceKernel kernel(model.lattice);
  Meter meter(model, kernel);
  const Measurement measured = meter.measure(state, 0);
  for (const std::size_t mean : {0u, 1u}) {
    EXPECT_NEAR(measured.probes[mean][0], a + b * 0.01, 1e-9);
    EXPECT_NEAR(measured.probes[mean][1], c * 0.03, 1e-9);
  }
  // Largest by size at y = 0.01 + 0.83: a + 0.84 b = 3.52e-4.
  EXPECT_NEAR(measured.probes[2][0], a + b * 0.84, 1e-3 * 3.52e-4);
  // Half of a sphere's area has |x - m| below R/2 for the coordinate across which it is uniform: of |c x| the median is
  // |c| times that of |0.03 + R s|, s uniform in [-1, 1], which is R/2 to second order in 0.03/R.
  EXPECT_NEAR(std::abs(measured.probes[3][1]), -c * 0.83 / 2, 0.05 * 0.83e-4);
}

TEST(Percentile, ByPlaceAndSize) {
  const Communicator self = Communicator::self();
  std::vector<Weighted> values;  // by size 0 -1 1 -2 2.5 3 4 -5 7 -10
  for (const double value : {3.0, -5.0, 1.0, -2.0, 4.0, 0.0, -1.0, 2.5, -10.0, 7.0}) values.push_back({value, 1});
  for (const auto& [percent, value] : std::vector<std::pair<double, double>>{
           {100, -10}, {95, -10}, {90, 7}, {80, -5}, {50, 2.5}, {20, -1}, {25, 1}, {0, 0}})
    EXPECT_EQ(percentile(self, values, percent), value) << percent;
  // Half of a weight of 8 lies up to the value of weight 5.
  EXPECT_EQ(percentile(self, {{2, 5}, {1, 1}, {3, 2}}, 50), 2);
  EXPECT_EQ(percentile(self, {{2, 5}, {1, 1}, {3, 2}}, 76), 3);
  EXPECT_EQ(percentile(self, {}, 50), 0);
}

}  // namespace
}  // namespace koshi::mechanics
