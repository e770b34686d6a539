// Broken inputs that the form of the input forbids: each message whole, with line and column.
#include <gtest/gtest.h>

#include <vector>

#include "support/broken_input.h"

namespace koshi::tests {
namespace {

// Text that is no TOML: the parser says where, the message what would be right.
TEST(BrokenInput, Syntax) {
  const std::vector<Broken> inputs{
      {R"(title = "base")", "title = base",
       R"(1:9: error: cannot read value: could not determine value type; text and quantities with a unit need quotes, such as "0.2 cm")"},
      {R"(title = "base")", R"(title = "base)",
       "1:14: error: cannot read string: unescaped control characters other than TAB (U+0009) are explicitly "
       "prohibited; a text ends with a quote on its own line"},
      {"[lattice]", "[lattice", "2:9: error: cannot read table header: expected ']', saw '\\n'"},
      {R"(cell = "cube-III")", R"(cell = "cube-III"
cell = "cube-I")",
       "4:8: error: cannot read key-value pair: cannot redefine existing string 'cell'; every key and table may stand "
       "once"},
      {"[output]", "[body]",
       "35:1: error: cannot read table header: cannot redefine existing table 'body'; every key and table may stand "
       "once"},
      {"[0, 0, 0]\nradius", "[0, 0, 0\nradius",
       "15:1: error: cannot read array: expected comma or closing ']', saw 'r'"},
      {R"(spacing = "0.2 cm")", "spacing = 0.2 cm",
       R"(4:15: error: cannot read key-value pair: expected a comment or whitespace, saw 'c'; text and quantities with a unit need quotes, such as "0.2 cm")"},
      {"poissons_ratio = 0.18", "poissons_ratio = 1e999",
       "10:23: error: cannot read floating-point: '1e999' could not be interpreted as a value"},
      {"poissons_ratio = 0.18", "poissons_ratio = 99999999999999999999",
       "10:38: error: cannot read decimal integer: '99999999999999999999' is not representable in 64 bits"},
      {R"([[boundary]]
name = "bottom")",
       R"([boundary]
name = "bottom")",
       "21:1: error: cannot read table header: cannot redefine existing table 'boundary' as array-of-tables; every key "
       "and table may stand once"},
      {R"(fix = ["x", "y", "z"])", R"(fix = ["x", "y", "z"]
face.a = 1)",
       "21:1: error: cannot read key-value pair: cannot redefine existing string as dotted key-value pair; every key "
       "and table may stand once"},
      {R"(title = "base")",
       "title.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a."
       "a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a = 1",
       "1:206: error: more than 100 dots in a row; keys have a few"},
      {R"(every = "1 s")", R"(every = "1 s)",
       "36:13: error: cannot read string: unescaped control characters other than TAB (U+0009) are explicitly "
       "prohibited; a text ends with a quote on its own line"},
      {R"(spacing = "0.2 cm")", "spacing = \u201C0.2 cm\u201D",
       R"(4:11: error: cannot read value: could not determine value type; quotes are straight, as in "0.2 cm", not those of a word processor)"},
      {R"(title = "base")", R"(title = "base" // of all)",
       "1:16: error: cannot read key-value pair: expected a comment or whitespace, saw '/'; a comment begins with #"},
      {R"(title = "base")", "title = True",
       "1:9: error: cannot read boolean: expected 'true', saw 'T'; it is written true or false, in small letters"},
      {R"(title = "base")",
       "title = \"Gr\xFC\xDF"
       "e\"",
       "1:11: error: cannot read the file: Encountered invalid utf-8 sequence; save it as UTF-8"},
      {R"(spacing = "0.2 cm")", R"(spacing: "0.2 cm")",
       "4:8: error: cannot read key-value pair: expected '=', saw ':'"},
  };
  ASSERT_EQ(inputs.size(), 18u);
  expect_messages(inputs);
}

// Unknown and missing keys and tables.
TEST(BrokenInput, Keys) {
  const std::vector<Broken> inputs{
      {"[lattice]", "[latice]", R"(2:2: error: unknown key "latice" in the input; did you mean "lattice"?)"},
      {"[[boundary]]\nname = \"bottom\"", "[[boundaries]]\nname = \"bottom\"",
       R"(17:3: error: unknown key "boundaries" in the input; did you mean "boundary"?)"},
      {R"(spacing = "0.2 cm")", R"(spacin = "0.2 cm")",
       R"(4:1: error: unknown key "spacin" in [lattice]; did you mean "spacing"?)"},
      {R"(spacing = "0.2 cm")", R"(spacing = "0.2 cm"
colour = "red")",
       R"(5:1: error: unknown key "colour" in [lattice]; known: "cell", "spacing", "springs", "calibration", "kinematics", "equations", "axes")"},
      {R"(spacing = "0.2 cm")", "",
       R"(2:1: error: [lattice] has no "spacing"; expected a length such as "0.2 cm" (a bare number is in m))"},
      {R"([lattice]
cell = "cube-III"
spacing = "0.2 cm"
)",
       "",
       R"(1:1: error: the input has no "lattice"; expected a table with "cell", "spacing", "springs", "calibration", "kinematics", "equations", "axes")"},
      {R"(size = ["0.8 cm", "0.8 cm", "1.6 cm"]
)",
       "",
       R"(5:1: error: [body] has no "size"; expected a list of three (x, y, z), each a length such as "0.2 cm" (a bare number is in m))"},
      {"[material.rock]", "[material]",
       R"(9:1: error: "youngs_modulus" stands in [material] itself; materials have a name: [material.rock])"},
      {R"([material.rock]
youngs_modulus = "1112 MPa"
poissons_ratio = 0.18
density = "2000 kg/m^3"
)",
       "", R"(1:1: error: the input has no "material"; expected tables with a name such as [material.rock])"},
      {R"(title = "base"
)",
       R"(title = "base"
lattice = 3
#)",
       R"(4:1: error: unknown key "cell" in the input; known: "title", "lattice", "body", "material", "region", "crack", "selection", "boundary", "load", "macroscopic", "analysis", "probe", "output")"},
      {"[analysis]", "[[analysis]]", "29:1: error: [analysis] is a list of 1; expected a table"},
      {"[[region]]", "[region]", "12:1: error: region is a table; expected tables, each under [[region]]"},
      {R"(title = "base")", R"(title = "base"
probes = 1)",
       R"(2:1: error: unknown key "probes" in the input; did you mean "probe"?)"},
      {R"(face = "z-max"
)",
       "box = { min = [0, 0, 0] }\n",
       R"(23:7: error: box has no "max"; expected a table { min = [x, y, z], max = [x, y, z] })"},
      {R"(size = ["0.8 cm", "0.8 cm", "1.6 cm"]
material = "rock"
)",
       R"(image = "scan.vti"
)",
       R"(5:1: error: [body] has no "materials"; expected a table of whole numbers and materials such as { 0 = "void", 1 = "rock" })"},
      {R"(density = "2000 kg/m^3"
)",
       "",
       R"(8:1: error: [material.rock] has no "density"; expected a density such as "2000 kg/m^3" (a bare number is in kg/m^3))"},
      {R"(radius = "1 mm"
)",
       "", R"(12:1: error: [[region]] has no "radius"; expected a length such as "0.2 cm" (a bare number is in m))"},
      {R"(shape = "sphere"
)",
       R"(shape = "box"
)",
       R"(12:1: error: [[region]] has no "min"; expected a list of three (x, y, z), each a length such as "0.2 cm" (a bare number is in m))"},
      {R"(shape = "sphere"
center = [0, 0, 0]
radius = "1 mm")",
       R"(shape = "stl"
scale = "1 mm")",
       R"(12:1: error: [[region]] has no "file"; expected a text in quotes)"},
      {R"(kind = "local", factor = 0.8)", R"(kind = "viscous")",
       R"(31:11: error: damping has no "rate"; expected a rate such as "100 1/s" (a bare number is in 1/s))"},
      {R"(name = "tip"
)",
       "", R"(32:1: error: [[probe]] has no "name"; expected a text in quotes)"},
      {R"(title = "base")", R"(title = "base"
[a.b.c])",
       R"(2:2: error: unknown key "a" in the input; known: "title", "lattice", "body", "material", "region", "crack", "selection", "boundary", "load", "macroscopic", "analysis", "probe", "output")"},
      {R"(title = "base")", R"("" = 1)",
       R"(1:1: error: unknown key "" in the input; known: "title", "lattice", "body", "material", "region", "crack", "selection", "boundary", "load", "macroscopic", "analysis", "probe", "output")"},
      {R"(name = "top")", R"(name = "top"
nodes = "all")",
       R"(23:1: error: unknown key "nodes" in [[boundary]]; known: "name", "face", "box", "point", "surface", "selection", "fix", "displacement", "velocity", "twist", "center", "ramp", "history", "support")"},
      {"[output]", R"([output]
format = "vtk")",
       R"(36:1: error: unknown key "format" in [output]; known: "fields", "every", "every_events", "history_every", "checkpoint_every", "checkpoint_every_wall", "report", "crack_surface", "surface")"},
      {R"(size = ["0.8 cm", "0.8 cm", "1.6 cm"]
)",
       R"(size = ["0.8 cm", "0.8 cm", "1.6 cm"]
position = [0, 0, 0]
)",
       R"(7:1: error: unknown key "position" in [body]; known: "origin", "size", "material", "periodic", "surface", "image", "materials", "scan", "factor", "strength", "grain_boundary")"},
  };
  ASSERT_EQ(inputs.size(), 26u);
  expect_messages(inputs);
}

// Values of another form.
TEST(BrokenInput, Types) {
  const std::vector<Broken> inputs{
      {R"(title = "base")", "title = 3", "1:9: error: title is the number 3; expected a text in quotes"},
      {R"(spacing = "0.2 cm")", "spacing = true",
       R"(4:11: error: spacing is true; expected a length such as "0.2 cm" (a bare number is in m))"},
      {R"(spacing = "0.2 cm")", R"(spacing = ["0.2 cm"])",
       R"(4:11: error: spacing is a list of 1; expected a length such as "0.2 cm" (a bare number is in m))"},
      {R"(spacing = "0.2 cm")", "spacing = 2020-01-01",
       R"(4:11: error: spacing is a date or time; expected a length such as "0.2 cm" (a bare number is in m))"},
      {"poissons_ratio = 0.18", "poissons_ratio = nan",
       "10:18: error: poissons_ratio is the number nan; expected a finite number"},
      {"poissons_ratio = 0.18", "poissons_ratio = inf",
       "10:18: error: poissons_ratio is the number inf; expected a finite number"},
      {R"(size = ["0.8 cm", "0.8 cm", "1.6 cm"])", R"(size = ["0.8 cm", "0.8 cm"])",
       R"(6:8: error: size is a list of 2; expected a list of three (x, y, z), each a length such as "0.2 cm" (a bare number is in m))"},
      {R"(size = ["0.8 cm", "0.8 cm", "1.6 cm"])", R"(size = "0.8 cm")",
       R"(6:8: error: size is the text "0.8 cm"; expected a list of three (x, y, z), each a length such as "0.2 cm" (a bare number is in m))"},
      {R"(size = ["0.8 cm", "0.8 cm", "1.6 cm"])", R"(size = ["0.8 cm", "0.8 cm", false])",
       R"(6:29: error: size[2] is false; expected a length such as "0.2 cm" (a bare number is in m))"},
      {R"(material = "rock"
)",
       R"(material = "rock"
periodic = [true, false, 1]
)",
       "8:26: error: periodic[2] is the number 1; expected true or false"},
      {R"(fix = ["x", "y", "z"])", R"(fix = "x")",
       R"(20:7: error: fix is the text "x"; expected a list with some of "x", "y", "z", "rx", "ry", "rz")"},
      {R"(fix = ["x", "y", "z"])", R"(fix = ["x", "y", "x"])", R"(20:18: error: fix lists "x" twice; once is enough)"},
      {R"(fix = ["x", "y", "z"])", R"(fix = ["x", 2])",
       R"(20:13: error: fix[1] is the number 2; expected a list with some of "x", "y", "z", "rx", "ry", "rz")"},
      {R"(displacement = { z = "-0.1 mm" })", R"(displacement = "-0.1 mm")",
       R"(24:16: error: displacement is the text "-0.1 mm"; expected a table such as { z = "0.2 cm" } with some of "x", "y", "z", "rx", "ry", "rz")"},
      {R"(displacement = { z = "-0.1 mm" })", "displacement = {}",
       R"(24:16: error: displacement is an empty table; expected a table such as { z = "0.2 cm" } with some of "x", "y", "z", "rx", "ry", "rz")"},
      {R"(face = "z-max"
)",
       "box = [0, 0, 0, 1, 1, 1]\n",
       "23:7: error: box is a list of 6; expected a table { min = [x, y, z], max = [x, y, z] }"},
      {R"(force = ["1 N", 0, 0])", R"(force = ["1 N", 0, 0]
history = [0, 1])",
       R"(29:12: error: history[0] is the number 0; expected a pair [time, factor] such as ["1 s", 0.5])"},
      {R"(force = ["1 N", 0, 0])", R"(force = ["1 N", 0, 0]
history = [[0, 1, 2]])",
       R"(29:12: error: history[0] is a list of 3; expected a pair [time, factor] such as ["1 s", 0.5])"},
      {R"(force = ["1 N", 0, 0])", R"(force = ["1 N", 0, 0]
history = [])",
       R"(29:11: error: history is an empty list; expected a list of pairs such as [["0 s", 0], ["1 s", 1]])"},
      {R"(damping = { kind = "local", factor = 0.8 })", R"(damping = "local")",
       R"(31:11: error: damping is the text "local"; expected a table)"},
      {R"(cell = "cube-III")", "cell = 3",
       R"(3:8: error: cell is the number 3; expected one of "cube-I", "cube-II", "cube-III")"},
      {R"(every = "1 s")", R"(fields = ["displacement", "displacement"])",
       R"(36:27: error: fields lists "displacement" twice; once is enough)"},
      {R"(size = ["0.8 cm", "0.8 cm", "1.6 cm"]
material = "rock"
)",
       R"(image = "scan.vti"
materials = { one = "rock" }
)",
       R"(7:15: error: materials has the key "one"; expected a table of whole numbers and materials such as { 0 = "void", 1 = "rock" })"},
      {R"(size = ["0.8 cm", "0.8 cm", "1.6 cm"]
material = "rock"
)",
       R"(image = "scan.vti"
materials = { 99999999999 = "rock" }
)",
       R"(7:15: error: materials has the key "99999999999"; expected a table of whole numbers and materials such as { 0 = "void", 1 = "rock" })"},
      {R"(type = "quasi-static")", R"(type = "quasi-static"
time_step = "fast")",
       R"(31:13: error: time_step is the text "fast"; expected "auto" or a time such as "1e-7 s" (a bare number is in s))"},
      {"point = [0, 0, 0]\n", "point = [0, 0]\n",
       R"(34:9: error: point is a list of 2; expected a list of three (x, y, z), each a length such as "0.2 cm" (a bare number is in m))"},
      {R"(every = "1 s")", R"(report = "yes")", R"(36:10: error: report is the text "yes"; expected true or false)"},
  };
  ASSERT_EQ(inputs.size(), 27u);
  expect_messages(inputs);
}

// Quantities.
TEST(BrokenInput, Units) {
  const std::vector<Broken> inputs{
      {R"(displacement = { z = "-0.1 mm" })", R"(displacement = { rz = "-0.1 mm" })",
       R"(24:23: error: "-0.1 mm" is a length; expected an angle such as "10 deg" (a bare number is in rad))"},
      {R"(force = ["1 N", 0, 0])", R"(force = ["1 N", 0, 0]
history = [["0 m", 1]])",
       R"(29:13: error: "0 m" is a length; expected a time such as "1e-7 s" (a bare number is in s))"},
      {R"(spacing = "0.2 cm")", R"(spacing = "0.2 s")",
       R"(4:11: error: "0.2 s" is a time; expected a length such as "0.2 cm" (a bare number is in m))"},
      {R"(spacing = "0.2 cm")", R"(spacing = "0.2 cmm")",
       R"(4:11: error: unknown unit "cmm" in "0.2 cmm" (did you mean "mm"?); expected a length such as "0.2 cm" (a bare number is in m))"},
      {R"(spacing = "0.2 cm")", R"(spacing = "two cm")",
       R"(4:11: error: "two cm" does not start with a number; expected a length such as "0.2 cm" (a bare number is in m))"},
      {R"(youngs_modulus = "1112 MPa")", R"(youngs_modulus = "1112 mpa")",
       R"(9:18: error: unknown unit "mpa" in "1112 mpa" (did you mean "MPa"?); expected a pressure such as "1112 MPa" (a bare number is in Pa))"},
      {R"(density = "2000 kg/m^3")", R"(density = "2000 kg")",
       R"(11:11: error: "2000 kg" is a quantity in kg; expected a density such as "2000 kg/m^3" (a bare number is in kg/m^3))"},
      {R"(force = ["1 N", 0, 0])", R"(force = ["1 N", 0, "2 kg"])",
       R"(28:20: error: "2 kg" is a quantity in kg; expected a force such as "9.8 N" (a bare number is in N))"},
      {R"(every = "1 s")", R"(every = "1 sek")",
       R"(36:9: error: unknown unit "sek" in "1 sek"; expected a time such as "1e-7 s" (a bare number is in s))"},
      {R"(shape = "sphere"
center = [0, 0, 0]
radius = "1 mm")",
       R"(shape = "half-space"
point = [0, 0, 0]
normal = ["1 m", 0, 0])",
       R"(15:11: error: "1 m" is a length; expected a plain number such as 0.18)"},
      {R"(radius = "1 mm")", R"(radius = "1 1000 mm")",
       R"(15:10: error: unknown unit "1000 mm" in "1 1000 mm"; expected a length such as "0.2 cm" (a bare number is in m))"},
      {R"(youngs_modulus = "1112 MPa")", R"(youngs_modulus = "1e308 MPa")",
       R"(9:18: error: "1e308 MPa" is out of the range of numbers; expected a pressure such as "1112 MPa" (a bare number is in Pa))"},
  };
  ASSERT_EQ(inputs.size(), 12u);
  expect_messages(inputs);
}

// Words that must be among known ones.
TEST(BrokenInput, Words) {
  const std::vector<Broken> inputs{
      {R"(fix = ["x", "y", "z"])", R"(fix = ["x", "y", "w"])",
       R"(20:18: error: unknown entry of fix "w"; allowed: "x", "y", "z", "rx", "ry", "rz")"},
      {R"(displacement = { z = "-0.1 mm" })", R"(displacement = { r = "-0.1 mm" })",
       R"(24:18: error: unknown displacement component "r"; did you mean "rx"? allowed: "x", "y", "z", "rx", "ry", "rz")"},
      {R"(displacement = { z = "-0.1 mm" })", R"(twist = { rz = "1 deg" })",
       R"(24:11: error: unknown twist component "rz"; allowed: "x", "y", "z")"},
      {R"(face = "z-max"
)",
       "box = { min = [0, 0, 0], top = [1, 1, 1] }\n", R"(23:26: error: unknown box key "top"; allowed: "min", "max")"},
      {R"(cell = "cube-III")", R"(cell = "cube-IV")",
       R"(3:8: error: unknown cell "cube-IV"; did you mean "cube-I"? allowed: "cube-I", "cube-II", "cube-III")"},
      {R"(cell = "cube-III")", R"(cell = "Cube-III")",
       R"(3:8: error: unknown cell "Cube-III"; did you mean "cube-III"? allowed: "cube-I", "cube-II", "cube-III")"},
      {R"(type = "quasi-static")", R"(type = "quasistatic")",
       R"(30:8: error: unknown type "quasistatic"; did you mean "quasi-static"? allowed: "static", "quasi-static", "dynamic", "modes")"},
      {R"(shape = "sphere")", R"(shape = "torus")",
       R"(13:9: error: unknown shape "torus"; allowed: "box", "sphere", "cylinder", "half-space", "stl")"},
      {R"(face = "x-max")", R"(face = "x-top")",
       R"(27:8: error: unknown face "x-top"; allowed: "x-min", "x-max", "y-min", "y-max", "z-min", "z-max")"},
      {R"(name = "tip"
)",
       R"(name = "tip"
quantity = "force"
)",
       R"(34:12: error: unknown quantity "force"; allowed: "displacement", "rotation", "velocity", "reaction", "moment", "stress", "strain")"},
      {R"(every = "1 s")", R"(fields = ["displacment"])",
       R"(36:11: error: unknown entry of fields "displacment"; did you mean "displacement"? allowed: "displacement", "rotation", "orientation", "velocity", "reaction", "strain", "stress", "material", "energy", "damage", "crack_opening")"},
      {R"(kind = "local")", R"(kind = "rayleigh")",
       R"(31:20: error: unknown kind "rayleigh"; allowed: "local", "viscous", "none")"},
  };
  ASSERT_EQ(inputs.size(), 12u);
  expect_messages(inputs);
}

// Keys that nothing would read.
TEST(BrokenInput, Meaningless) {
  const std::vector<Broken> inputs{
      {R"(type = "quasi-static")", R"(type = "static")",
       R"(31:1: error: "damping" has no meaning here; it goes with type "quasi-static" or "dynamic")"},
      {R"(cell = "cube-III")", R"(cell = "cube-III"
equations = ["C1122", "C1111"])",
       R"(4:1: error: "equations" has no meaning here; it goes with calibration "paper")"},
      {R"(cell = "cube-III")", R"(cell = "cube-III"
axes = "yxz")",
       R"(4:1: error: "axes" has no meaning here; it goes with calibration "paper")"},
      {R"(material = "rock"
)",
       R"(material = "rock"
image = "scan.vti"
)",
       R"(6:1: error: "size" has no meaning here; it goes with a body without an image)"},
      {R"(material = "rock"
)",
       R"(material = "rock"
materials = { 1 = "rock" }
)",
       R"(8:1: error: "materials" has no meaning here; it goes with a body with an image and without scan.grey)"},
      {R"(displacement = { z = "-0.1 mm" }
)",
       R"(ramp = "1 s"
fix = ["z"]
)",
       R"(24:1: error: "ramp" has no meaning here; it goes with a boundary with displacement, velocity or twist)"},
      {R"(displacement = { z = "-0.1 mm" }
)",
       R"(displacement = { z = "-0.1 mm" }
center = [0, 0, 0]
)",
       R"(25:1: error: "center" has no meaning here; it goes with a boundary with twist)"},
      {R"(name = "tip"
)",
       R"(name = "tip"
center = [0, 0, 0]
)",
       R"(34:1: error: "center" has no meaning here; it goes with quantity "moment")"},
      {R"(force = ["1 N", 0, 0])", R"(pressure = "1 MPa"
distribution = "nodes")",
       R"(29:1: error: "distribution" has no meaning here; it goes with a load with force)"},
      {R"(type = "quasi-static")", R"(type = "dynamic"
tolerance = 1e-6
duration = 1)",
       R"(31:1: error: "tolerance" has no meaning here; it goes with type "static", "quasi-static" or "modes")"},
      {"factor = 0.8", R"(rate = "1 1/s")", R"(31:29: error: "rate" has no meaning here; it goes with kind "viscous")"},
      {R"(kind = "local")", R"(kind = "none")",
       R"(31:28: error: "factor" has no meaning here; it goes with kind "local")"},
  };
  ASSERT_EQ(inputs.size(), 12u);
  expect_messages(inputs);
}

}  // namespace
}  // namespace koshi::tests
