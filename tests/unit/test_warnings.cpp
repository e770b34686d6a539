// What a case is told before it runs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "driver/simulation.h"
#include "driver/warnings.h"
#include "koshi/error.h"
#include "support/cases.h"

namespace koshi::driver {
namespace {

using material::Kinematics;
using model::Face;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::string> warnings_of(const model::Definition& definition) {
  return warnings(model::make_model(definition, Communicator::world()));
}

model::Definition pressed(std::initializer_list<std::size_t> held) {
  model::Definition definition = test::block({4, 4, 4}, 0.002);
  definition.boundaries = {test::fixed("bottom", Face::z_min, held)};
  return definition;
}

TEST(Warnings, SmoothPlatensThatLetTheirNodesTurn) {
  EXPECT_THAT(warnings_of(pressed({2})),
              ElementsAre(testing::AllOf(HasSubstr("boundary \"bottom\" holds z of face \"z-min\""),
                                         HasSubstr("add \"rx\", \"ry\" to fix"))));
  EXPECT_THAT(warnings_of(pressed({2, 3})).size(), 1u);     // one axis is not enough
  EXPECT_THAT(warnings_of(pressed({2, 3, 4})), IsEmpty());  // turning about the normal is free
  EXPECT_THAT(warnings_of(pressed({0, 1, 2})), IsEmpty());  // rough
  EXPECT_THAT(warnings_of(pressed({0, 1})), IsEmpty());     // not held across

  model::Definition moved = pressed({});
  moved.boundaries[0].displacement[2] = -1e-5;
  moved.boundaries[0].selection.face = Face::y_max;
  EXPECT_THAT(warnings_of(moved), IsEmpty());  // along itself
  moved.boundaries[0].displacement = {};
  moved.boundaries[0].velocity[1] = -1e-5;
  EXPECT_THAT(warnings_of(moved), ElementsAre(HasSubstr("add \"rx\", \"rz\" to fix")));

  // Two boundaries of one face count together.
  model::Definition two = pressed({2});
  two.boundaries.push_back(test::fixed("no turning", Face::z_min, {3, 4}));
  EXPECT_THAT(warnings_of(two), IsEmpty());
}

TEST(Warnings, PlatensThatCannotTurnWrongly) {
  model::Definition fitted = pressed({2});
  fitted.lattice.kinematics = Kinematics::least_squares;
  EXPECT_THAT(warnings_of(fitted), IsEmpty());
  model::Definition edges = pressed({2});
  edges.lattice.cell = lattice::CellType::cube_i;
  EXPECT_THAT(warnings_of(edges), IsEmpty());
  model::Definition plain = pressed({2});
  plain.lattice.springs = material::Sharing::plain;
  EXPECT_THAT(warnings_of(plain), IsEmpty());
  model::Definition endless = pressed({2});
  endless.body.periodic = {true, true, false};
  EXPECT_THAT(warnings_of(endless), IsEmpty());
}

// Loose rotations matter to equilibrium, not to motion.
TEST(Warnings, GearModeInEquilibrium) {
  model::Definition definition = pressed({0, 1, 2, 3, 4, 5});
  definition.lattice.cell = lattice::CellType::cube_i;
  EXPECT_THAT(warnings_of(definition), IsEmpty());
  definition.analysis.type = model::AnalysisDefinition::Type::statics;
  EXPECT_THAT(warnings_of(definition), ElementsAre(HasSubstr("gear mode")));
  definition.materials.push_back({"sand", {2e6, 0.18, 2000}});  // the same Poisson's ratio: said once
  EXPECT_THAT(warnings_of(definition).size(), 1u);
  definition.lattice.kinematics = Kinematics::least_squares;
  EXPECT_THAT(warnings_of(definition), IsEmpty());
}

// Bending-exact springs of the fit release energy in a lone cell below nu = -0.2; the place is that of the calibration.
TEST(Warnings, UnstableSpringsAreRefused) {
  model::Definition definition = pressed({0, 1, 2});
  definition.lattice.kinematics = Kinematics::least_squares;
  int refused = 0, fine = 0;
  for (const double nu : {-0.9, -0.5, -0.21, -0.19, 0.0, 0.3, 0.499}) {
    definition.materials[0].elastic.poissons_ratio = nu;
    Simulation simulation(definition, Communicator::world());
    try {
      simulation.prepare();
      ++fine;
    } catch (const InputError& error) {
      EXPECT_LT(nu, -0.2);
      EXPECT_THAT(error.message(), HasSubstr("the springs of material \"rock\" (nu = "));
      EXPECT_THAT(error.message(), HasSubstr("use calibration \"isotropic\""));
      EXPECT_THROW(simulation.prepare(), InputError);  // and again
      ++refused;
    }
  }
  EXPECT_EQ(refused, 3);
  EXPECT_EQ(fine, 4);
}

// 2 30 GPa 20 J/m^2/(30 MPa)^2 = 1.333 mm hold sqrt(3) d up to d = 0.770 mm; tension along two axes alike stores 2 (1 -
// 0.2) = 1.6 times as much, and asks for 0.481 mm. At 0.6 mm a crack takes there 1.6 20 J/m^2 1.0392/1.3333 = 24.9
// J/m^2.
TEST(Warnings, SpacingsTooCoarseForTheStrength) {
  const auto warnings_at = [](double d) {
    model::Definition definition = test::block({2, 2, 2}, d, {30e9, 0.2, 2400});
    material::Fracture& fracture = definition.materials[0].fracture.emplace();
    fracture.tensile_strength = 30e6;
    fracture.fracture_energy = 20;
    definition.boundaries = {test::fixed("bottom", Face::z_min, {0, 1, 2})};
    return warnings_of(definition);
  };
  EXPECT_THAT(warnings_at(0.48e-3), IsEmpty());
  for (const double d : {0.482e-3, 0.6e-3, 0.769e-3})
    EXPECT_THAT(warnings_at(d),
                ElementsAre(HasSubstr("where tension acts along two axes alike: there a cell stores 1.6 "
                                      "times as much energy")));
  EXPECT_THAT(
      warnings_at(0.6e-3),
      ElementsAre(HasSubstr("Cracks there open at 3e+07 Pa, but take up to 24.94 J/m^2, not 20 J/m^2; a spacing "
                            "below 0.000481 m keeps both")));
  EXPECT_THAT(warnings_at(0.771e-3),
              ElementsAre(HasSubstr("a spacing below 0.00077 m keeps both, one below 0.000481 m also where tension")));
}

}  // namespace
}  // namespace koshi::driver
