// A thin slab between walls by direct equilibrium: a few cells across, on coarse levels less than one.
#include <gtest/gtest.h>

#include "koshi/statics.h"
#include "support/cases.h"

namespace koshi {
namespace {

using model::Face;

// Pressed by p, the slab cannot widen: u_z = -p z / (lambda + 2 mu). The far wall lies between the planes of the
// coarsest nodes, the last of which must be held like it: free, they make that level so soft that the cycle is not
// definite.
TEST(Walls, ThinSlabIsPressedUniformly) {
  int checked = 0;
  for (const std::int64_t across : {1, 4, 5}) {
    constexpr double d = 0.25, pressure = 1e6;
    model::Definition definition = test::block({108, across, 108}, d, {10e9, 0.25, 2700});
    definition.analysis.type = model::AnalysisDefinition::Type::statics;
    definition.boundaries = {test::fixed("front", Face::y_min, {1, 3, 4, 5}),
                             test::fixed("back", Face::y_max, {1, 3, 4, 5}),
                             test::fixed("west", Face::x_min, {0, 4, 5}), test::fixed("east", Face::x_max, {0, 4, 5}),
                             test::fixed("base", Face::z_min, {2, 3, 4})};
    model::LoadDefinition load;
    load.selection.face = Face::z_max;
    load.pressure = pressure;
    definition.loads = {load};
    const model::Model model = model::make_model(definition, Communicator::world());
    model::State state(model);
    const statics::SolveReport report = statics::solve_static(model, state, {});
    EXPECT_TRUE(report.converged);
    EXPECT_LE(report.iterations, 12) << across;
    EXPECT_GE(report.levels, across == 1 ? 2 : 4) << across;
    const material::Elastic& rock = definition.materials[0].elastic;
    const double strain = pressure / (rock.lambda() + 2 * rock.mu());
    lattice::for_each_owned(model.layout(), [&](auto i, auto j, auto k, auto n) {
      const double z = model.lattice.grid.position({i, j, k})[2];
      ASSERT_NEAR(state.displacement.component(2)[n], -strain * z, 1e-6 * strain * 27) << i << " " << j << " " << k;
      ++checked;
    });
  }
  EXPECT_EQ(checked, 109 * 109 * (2 + 5 + 6));
}

}  // namespace
}  // namespace koshi
