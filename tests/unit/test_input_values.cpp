// Broken inputs of the right form with wrong values: each message whole, with line and column.
#include <gtest/gtest.h>

#include <vector>

#include "support/broken_input.h"

namespace koshi::tests {
namespace {

// Values out of range, names without a thing: lattice, body, materials, regions.
TEST(BrokenInput, LatticeAndBody) {
  const std::vector<Broken> inputs{
      {R"(spacing = "0.2 cm")", "spacing = 0", "4:11: error: spacing is 0 m; it must lie between 1e-12 m and 1e+09 m"},
      {R"(spacing = "0.2 cm")", R"(spacing = "-2 mm")",
       "4:11: error: spacing is -0.002 m; it must lie between 1e-12 m and 1e+09 m"},
      {R"(cell = "cube-III")", R"(cell = "cube-II"
calibration = "bending-exact")",
       R"(4:15: error: calibration "bending-exact" needs cell "cube-III", not "cube-II"; take "isotropic", or the cell "cube-III")"},
      {R"(cell = "cube-III")", R"(cell = "cube-I"
springs = "plain"
equations = ["C1122", "C1111"])",
       R"(5:13: error: 2 equations; cube-I takes one, such as ["C1111-C1122"])"},
      {R"(cell = "cube-III")", R"(cell = "cube-II"
springs = "plain"
equations = ["C1122"])",
       R"(5:13: error: 1 equation; cube-II takes two, such as ["C1122", "C1212"])"},
      {R"(cell = "cube-III")", R"(cell = "cube-II"
springs = "plain"
equations = ["C1122", "C1412"])",
       R"(5:23: error: equation "C1412": index "4" is not 1, 2 or 3; expected a sum of entries such as "C1122" or "C1111 - 2 C1212")"},
      {R"(cell = "cube-III")", R"(cell = "cube-II"
springs = "plain"
equations = ["C1122", "mu"])",
       R"(5:23: error: equation "mu": "mu" is no entry; expected a sum of entries such as "C1122" or "C1111 - 2 C1212")"},
      {R"(cell = "cube-III")", R"(cell = "cube-II"
springs = "plain"
axes = "xxz")",
       R"(5:8: error: axes is "xxz"; expected a permutation of "xyz" such as "yxz")"},
      {R"(size = ["0.8 cm", "0.8 cm", "1.6 cm"])", R"(size = ["0.8 cm", "0.85 cm", "1.6 cm"])",
       "6:19: error: size along y is 0.0085 m, no positive multiple of the spacing 0.002 m; the nearest right sizes: "
       "0.008 m, 0.01 m"},
      {R"(size = ["0.8 cm", "0.8 cm", "1.6 cm"])", R"(size = ["0.8 cm", "0.8 cm", "1 mm"])",
       "6:29: error: size along z is 0.001 m, no positive multiple of the spacing 0.002 m; the nearest right size: "
       "0.002 m"},
      {R"(size = ["0.8 cm", "0.8 cm", "1.6 cm"])", R"(size = ["0.8 cm", 0, "1.6 cm"])",
       "6:19: error: size[1] is 0 m; it must lie between 1e-12 m and 1e+12 m"},
      {R"(size = ["0.8 cm", "0.8 cm", "1.6 cm"])", R"(size = ["-0.8 cm", "0.8 cm", "1.6 cm"])",
       "6:9: error: size[0] is -0.008 m; it must lie between 1e-12 m and 1e+12 m"},
      {R"(size = ["0.8 cm", "0.8 cm", "1.6 cm"])", R"(size = ["0.8 cm", "0.8 cm", 1e12])",
       "6:29: error: the body would have more than 1e+15 nodes; use a larger spacing or a smaller body"},
      {R"(size = ["0.8 cm", "0.8 cm", "1.6 cm"])", R"(size = ["0.8 cm", "0.8 cm", "1.6 cm"]
origin = [0, 0, 1e7])",
       "7:17: error: origin along z is 10000000 m, more than 1e+09 cells of 0.002 m away from zero, where coordinates "
       "no "
       "longer tell them apart; move the body nearer"},
      {R"(material = "rock"
)",
       R"(material = "rok"
)",
       R"(7:12: error: there is no material "rok"; did you mean "rock"?)"},
      {R"(size = ["0.8 cm", "0.8 cm", "1.6 cm"]
material = "rock"
)",
       R"(image = "scan.png"
materials = { 0 = "void", 1 = "rock" }
)",
       R"(6:9: error: the image "scan.png" is in no known format; known: ".npy", ".vti", ".mha", ".mhd", ".nrrd", ".nhdr", ".tif", ".tiff", ".nii", ".nii.gz", ".raw")"},
      {R"(size = ["0.8 cm", "0.8 cm", "1.6 cm"]
material = "rock"
)",
       R"(image = "scan.vti"
materials = { 1 = "rock", 01 = "void" }
)",
       "7:27: error: materials gives 1 twice; once is enough"},
      {R"(size = ["0.8 cm", "0.8 cm", "1.6 cm"]
material = "rock"
)",
       R"(image = "scan.vti"
materials = { 1 = "sand" }
)",
       R"(7:19: error: there is no material "sand"; known: "rock", "void")"},
      {R"(youngs_modulus = "1112 MPa")", R"(youngs_modulus = "-1112 MPa")",
       "9:18: error: youngs_modulus is -1112000000 Pa; it must lie between 1e-09 Pa and 1e+18 Pa"},
      {"poissons_ratio = 0.18", "poissons_ratio = 0.5",
       "10:18: error: poissons_ratio is 0.5; it must be above -1 and below 0.5, else the shear or the bulk modulus is "
       "not "
       "positive and finite"},
      {"poissons_ratio = 0.18", "poissons_ratio = -1",
       "10:18: error: poissons_ratio is -1; it must be above -1 and below 0.5, else the shear or the bulk modulus is "
       "not "
       "positive and finite"},
      {R"(density = "2000 kg/m^3")", "density = 0",
       "11:11: error: density is 0 kg/m^3; it must lie between 1e-09 kg/m^3 and 1e+18 kg/m^3"},
      {"[material.rock]", "[material.void]", R"(8:1: error: "void" means no material; choose another name)"},
      {"[material.rock]", R"([material.""])",
       "8:1: error: a material has an empty name; name it, such as [material.rock]"},
      {R"(material = "void")", R"(material = "air")",
       R"(16:12: error: there is no material "air"; known: "rock", "void")"},
      {R"(radius = "1 mm")", R"(radius = "-1 mm")",
       "15:10: error: radius is -0.001 m; it must lie between 1e-12 m and 1e+12 m"},
      {R"(shape = "sphere"
center = [0, 0, 0]
radius = "1 mm")",
       R"(shape = "box"
min = [0, 0, "2 mm"]
max = [1, 1, "1 mm"])",
       "12:1: error: min is above max along z (0.002 m and 0.001 m); exchange them"},
      {R"(shape = "sphere"
center = [0, 0, 0]
)",
       R"(shape = "cylinder"
start = [0, 0, 1]
end = [0, 0, 1]
)",
       "15:7: error: start and end of the cylinder are the same point; its axis needs a length"},
      {R"(shape = "sphere"
center = [0, 0, 0]
radius = "1 mm")",
       R"(shape = "half-space"
point = [0, 0, 0]
normal = [0, 0, 0])",
       "15:10: error: normal is zero; it needs a direction such as [0, 0, 1]"},
      {R"(shape = "sphere"
center = [0, 0, 0]
radius = "1 mm")",
       R"(shape = "stl"
file = "a.stl"
scale = 0)",
       "15:9: error: scale is 0 m; it must lie between 1e-12 m and 1e+12 m"},
      {R"(youngs_modulus = "1112 MPa")", "youngs_modulus = 1e-400",
       "9:18: error: youngs_modulus is 0 Pa; it must lie between 1e-09 Pa and 1e+18 Pa"},
      {R"(youngs_modulus = "1112 MPa")", "youngs_modulus = -9223372036854775808",
       "9:18: error: youngs_modulus is -9.22337203685e+18 Pa; it must lie between 1e-09 Pa and 1e+18 Pa"},
  };
  ASSERT_EQ(inputs.size(), 32u);
  expect_messages(inputs);
}

// Boundaries and loads.
TEST(BrokenInput, Conditions) {
  const std::vector<Broken> inputs{
      {R"(name = "bottom")", R"(name = "")", "18:8: error: name is empty; give it a text or leave it out"},
      {R"(name = "top")", R"(name = "bottom")",
       R"(22:8: error: two boundary tables are called "bottom"; names must differ)"},
      {R"(name = "top")", R"(name = "to\np")",
       "22:8: error: the name of a boundary holds a control character; names are of one line"},
      {R"(face = "z-max"
)",
       "", R"(21:1: error: boundary "top" selects nothing; give one of face, box, point, surface, selection)"},
      {R"(face = "z-max"
)",
       R"(face = "z-max"
point = [0, 0, 0]
)",
       R"(24:9: error: boundary "top" has both face and point; give one of face, box, point, surface, selection)"},
      {R"(face = "z-max"
)",
       "box = { min = [0, 0, 1], max = [1, 1, 0] }\n",
       "23:7: error: min is above max along z (1 m and 0 m); exchange them"},
      {R"(displacement = { z = "-0.1 mm" })", R"(fix = ["z"]
displacement = { z = "-0.1 mm" })",
       R"(25:22: error: boundary "top" prescribes z by fix and by displacement; keep one of them)"},
      {R"(displacement = { z = "-0.1 mm" })", R"(displacement = { z = "-0.1 mm" }
velocity = { z = 1 })",
       R"(25:18: error: boundary "top" prescribes z by displacement and by velocity; keep one of them)"},
      {R"(displacement = { z = "-0.1 mm" })", R"(fix = ["x"]
twist = { z = "1 deg" })",
       R"(25:15: error: boundary "top" prescribes x by fix and by twist about z; keep one of them)"},
      {R"(displacement = { z = "-0.1 mm" })", R"(twist = { z = "1 deg", x = "1 deg" })",
       R"(24:15: error: boundary "top" prescribes y by twist about x and by twist about z; keep one of them)"},
      {R"(displacement = { z = "-0.1 mm" }
)",
       "", R"(21:1: error: boundary "top" prescribes nothing; give it fix, displacement, velocity, twist or support)"},
      {R"(displacement = { z = "-0.1 mm" }
)",
       R"(displacement = { z = "-0.1 mm" }
ramp = "-1 s"
)",
       "25:8: error: ramp is -1 s; it must lie between 0 s and 1e+15 s"},
      {R"(displacement = { z = "-0.1 mm" }
)",
       R"(displacement = { z = "-0.1 mm" }
history = [["0 s", 0], ["1 s", 1], ["1 s", 2]]
)",
       "25:36: error: time 1 s does not come after 1 s; the times of a history must rise"},
      {R"(type = "quasi-static"
damping = { kind = "local", factor = 0.8 })",
       R"(type = "static"
[[boundary]]
face = "y-max"
velocity = { y = "1 m/s" })",
       R"(33:18: error: boundary "boundary 3" prescribes a velocity, but a static analysis knows no time; give displacement, or the type "quasi-static" or "dynamic")"},
      {R"(spacing = "0.2 cm")", R"(spacing = "0.2 cm"
kinematics = "least-squares"
[[boundary]]
face = "y-max"
displacement = { rx = "1 deg" })",
       R"(8:23: error: boundary "boundary 1" prescribes the rotation rx, but least-squares kinematics has no rotations; take twist, or kinematics "rotational")"},
      {R"(force = ["1 N", 0, 0])", "",
       R"(25:1: error: load "push" loads nothing; give it one of force, traction, pressure, acceleration)"},
      {R"(force = ["1 N", 0, 0])", R"(force = ["1 N", 0, 0]
pressure = "1 MPa")",
       R"(29:12: error: load "push" has both force and pressure; give one of force, traction, pressure, acceleration (one load each))"},
      {R"(force = ["1 N", 0, 0])", "acceleration = [0, 0, -9.8]",
       R"(27:8: error: load "push" is an acceleration of the whole body; leave face out)"},
      {R"(face = "x-max"
)",
       "", R"(25:1: error: load "push" selects nothing; give one of face, box, point, surface, selection)"},
      {R"(face = "x-max"
force = ["1 N", 0, 0])",
       R"(point = [0, 0, 0]
pressure = "1 MPa")",
       R"(27:9: error: load "push" is a pressure on a point, which has no area; select a face or box, or give force)"},
      {R"(force = ["1 N", 0, 0])", R"(force = ["1 N", 0, 0]
history = [["1 s", 0], ["0 s", 1]])",
       "29:24: error: time 0 s does not come after 1 s; the times of a history must rise"},
  };
  ASSERT_EQ(inputs.size(), 21u);
  expect_messages(inputs);
}

// Analysis, probes, output.
TEST(BrokenInput, AnalysisProbesOutput) {
  const std::vector<Broken> inputs{
      {R"(type = "quasi-static")", R"(type = "dynamic")",
       R"(29:1: error: a dynamic analysis has no duration; give one, such as duration = "0.1 s")"},
      {R"(type = "quasi-static")", R"(type = "dynamic"
duration = "-1 s")",
       "31:12: error: duration is -1 s; it must lie between 1e-20 s and 1e+15 s"},
      {R"(type = "quasi-static")", R"(type = "quasi-static"
time_step = 0)",
       "31:13: error: time_step is 0 s; it must lie between 1e-20 s and 1e+15 s"},
      {R"(type = "quasi-static")", R"(type = "quasi-static"
tolerance = 0)",
       "31:13: error: tolerance is 0; it must be at least 1e-15 and below 1"},
      {R"(type = "quasi-static")", R"(type = "quasi-static"
safety = 1.5)",
       "31:10: error: safety is 1.5; it must lie between 1e-06 and 1"},
      {"factor = 0.8", "factor = 1", "31:38: error: factor is 1; it must be at least 0 and below 1"},
      {R"(kind = "local", factor = 0.8)", R"(kind = "viscous", rate = "-1 1/s")",
       "31:38: error: rate is -1 1/s; it must lie between 0 1/s and 1e+20 1/s"},
      {R"(name = "tip"
point = [0, 0, 0])",
       R"(name = "tip")",
       R"(32:1: error: probe "tip" selects nothing; give one of face, box, point, surface, selection)"},
      {R"(name = "tip"
)",
       R"(name = "tip"
quantity = "moment"
reduce = "mean"
)",
       R"(35:10: error: probe "tip" is a moment, which is a sum over its nodes; leave reduce out)"},
      {R"(name = "tip"
)",
       R"(name = "tip"
minus = "foot"
)",
       R"(34:9: error: there is no selection "foot"; known: "spot")"},
      {R"(name = "tip"
point = [0, 0, 0])",
       R"(name = "tip"
quantity = "reaction"
minus = "foot"
point = [0, 0, 0]

[[selection]]
name = "foot"
face = "x-min")",
       R"(35:9: error: probe "tip" takes the mean of a selection off, which has a meaning for displacement, rotation and velocity; leave minus out)"},
      {R"(name = "tip"
point = [0, 0, 0])",
       R"(name = "tip"
reduce = "max"
minus = "foot"
point = [0, 0, 0]

[[selection]]
name = "foot"
face = "x-min")",
       R"(35:9: error: probe "tip" takes a mean off; reduce is to be "mean" or "area-mean")"},
      {R"(every = "1 s")", "every = 0", "36:9: error: every is 0 s; it must lie between 1e-20 s and 1e+15 s"},
      {R"(every = "1 s")", R"(checkpoint_every_wall = "-1 min")",
       "36:25: error: checkpoint_every_wall is -60 s; it must lie between 1e-20 s and 1e+15 s"},
      {R"(title = "base")", R"(title = "")", "1:9: error: title is empty; give it a text or leave it out"},
  };
  ASSERT_EQ(inputs.size(), 15u);
  expect_messages(inputs);
}

}  // namespace
}  // namespace koshi::tests
