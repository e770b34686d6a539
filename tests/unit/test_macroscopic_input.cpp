// Wrong inputs of [macroscopic]: each message with its place.
#include <gtest/gtest.h>

#include "support/broken_input.h"

namespace koshi::tests {
namespace {

const std::string block = R"([lattice]
spacing = 1
[body]
size = [4, 4, 4]
material = "rock"
periodic = ["x", "y", "z"]
[material.rock]
youngs_modulus = 1e9
poissons_ratio = 0.2
density = 1000
[macroscopic]
strain = { xx = 1e-3, xy = 0 }
stress = { zz = "1 MPa" }
)";

TEST(MacroscopicInput, BrokenIsRefusedAtItsPlace) {
  ASSERT_EQ(message_of(block), "");
  const std::vector<std::pair<std::vector<std::string>, std::string>> inputs{
      {{"body.periodic=[]"},
       "case.toml:11:1: error: macroscopic strain without periodic directions: it is the strain of a"},
      {{"body.periodic=['x', 'y']"},
       "case.toml:13:17: error: a macroscopic zz needs a body that is periodic along its axes, and this one is not in "
       "z; "
       "add \"z\" to body.periodic, or leave zz out"},
      {{"body.periodic=['x', 'z']"},
       "case.toml:12:28: error: a macroscopic xy needs a body that is periodic along its axes"},
      {{"macroscopic.stress.xx=0"}, "error: xx has both a mean strain and a mean stress"},
      {{"macroscopic.strain={}", "macroscopic.stress={}"}, "case.toml:11:1: error: [macroscopic] gives no component"},
      {{"macroscopic.strain.yx=0"}, "error: unknown key \"yx\" in strain; did you mean"},
      {{"macroscopic.strain.xx=nan"}, "error: xx is the number nan; expected a finite number"},
      {{"macroscopic.history=[[1, 0], [1, 1]]"}, "error: time 1 s does not come after 1 s"},
      {{"analysis={type='dynamic', duration=1}"},
       "case.toml:13:10: error: mean stresses are met in equilibrium alone; use analysis.type = \"static\" instead of "
       "\"dynamic\", or give the mean strain"},
      {{"analysis.type='quasi-static'"}, "case.toml:13:10: error: mean stresses are met in equilibrium alone"},
      {{"analysis.type='modes'"}, "case.toml:11:1: error: modes swing about the body as it is"},
      {{"lattice.springs='plain'"}, "case.toml:11:1: error: plain springs belong to no cell"},
      {{"material.rock.fracture={tensile_strength=1e6, fracture_energy=1e8}"},
       "case.toml:11:1: error: cracks are not followed under a macroscopic strain"},
      {{"boundary=[{name='pin', point=[0, 0, 0], fix=['y']}]"},
       "error: boundary \"pin\" prescribes y, along which the body is periodic"},
      {{"boundary=[{name='turn', point=[0, 0, 0], twist={z=1}}]"},
       "error: boundary \"turn\" prescribes x, along which the body is periodic"},
  };
  for (const auto& [overrides, message] : inputs) {
    // What an override gives is the place of what is wrong with it.
    const std::string whole = message.starts_with("error") ? "--set " + overrides.front() + ": " + message : message;
    EXPECT_EQ(message_of(block, overrides).substr(0, whole.size()), whole);
  }
  EXPECT_EQ(inputs.size(), 15U);
}

}  // namespace
}  // namespace koshi::tests
