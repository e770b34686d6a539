// Modes on several ranks: as on one, up to rounding.
#include <gtest/gtest.h>

#include "koshi/modes.h"

namespace koshi {
namespace {

TEST(ModesOnRanks, AreThoseOfOneRank) {
  model::Definition definition;
  definition.lattice.spacing = 0.01;
  definition.body.size = {0.06, 0.16, 0.06};
  definition.body.material = "rock";
  definition.materials = {{"rock", {2e9, 0.25, 2000}}, {"soft", {1e9, 0.1, 1000}}};
  model::RegionDefinition end;
  end.material = "soft";
  end.min = {0.03, 0.1, 0};
  end.max = {0.06, 0.16, 0.06};
  definition.regions = {end};
  definition.analysis.type = model::AnalysisDefinition::Type::modes;
  definition.analysis.count = 8;
  definition.analysis.tolerance = 1e-12;
  const model::Model whole = model::make_model(definition, Communicator::self());
  const model::Model split = model::make_model(definition, Communicator::world());
  const modes::ModesReport one = modes::find_modes(whole), several = modes::find_modes(split);
  ASSERT_EQ(one.modes.size(), 8u);
  ASSERT_EQ(several.modes.size(), 8u);
  EXPECT_GT(split.communicator.size(), 1);
  std::int64_t compared = 0;
  for (std::size_t m = 0; m < one.modes.size(); ++m) {
    EXPECT_NEAR(several.modes[m].frequency / one.modes[m].frequency, 1, 1e-10);
    EXPECT_NEAR(several.modes[m].modal_mass / one.modes[m].modal_mass, 1, 1e-5);
    lattice::Field<double> u(whole.layout(), 6), v(split.layout(), 6);
    modes::fill(whole, one.modes[m], u);
    modes::fill(split, several.modes[m], v);
    // Sign and order are settled as well; shapes are as good as the residual, 1e-6.
    lattice::for_each_owned(split.layout(), [&](auto i, auto j, auto k, auto n) {
      const std::int64_t at = whole.layout().index(split.layout().global({i, j, k}));
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(v.component(c)[n], u.component(c)[at], 1e-4) << m;
      ++compared;
    });
  }
  EXPECT_EQ(split.communicator.sum(compared), 8 * 7 * 17 * 7);
}

}  // namespace
}  // namespace koshi
