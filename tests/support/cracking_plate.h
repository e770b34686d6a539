// A plate that cracks, for runs of the program.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "io/history_reader.h"
#include "support/program_test.h"

namespace koshi::test {

/// A plate of 60 mm x 45 mm x 10 mm in cells of 5 mm, with a notch over a third of its height, held at its left end:
/// the first tables of a case. `material` is its name; `fracture` and `lattice` are written into their tables.
inline std::string notched_plate(const std::string& material, const std::string& fracture,
                                 const std::string& lattice = "") {
  return "[lattice]\nspacing = \"5 mm\"\n" + lattice + R"([body]
size = ["60 mm", "45 mm", "10 mm"]
material = ")" +
         material + "\"\n[material." + material + R"(]
youngs_modulus = "30 GPa"
poissons_ratio = 0.2
density = "2400 kg/m^3"
fracture = { )" +
         fracture + R"( }
[[region]]
shape = "box"
min = ["30 mm", "0 mm", "0 mm"]
max = ["35 mm", "15 mm", "10 mm"]
material = "void"
[[boundary]]
name = "wall"
face = "x-min"
fix = ["x", "y", "z", "rx", "ry", "rz"]
)";
}

/// Another material in it, which does not crack; a motion of its right end, out and back; and damping.
inline std::string pulled_with_a_stone(const std::string& displacement) {
  return R"([material.stone]
youngs_modulus = "60 GPa"
poissons_ratio = 0.25
density = "2700 kg/m^3"
[[region]]
shape = "sphere"
center = ["40 mm", "30 mm", "5 mm"]
radius = "8 mm"
material = "stone"
[[boundary]]
name = "pull"
face = "x-max"
displacement = { )" +
         displacement + R"( }
history = [["0 s", 0], ["100 us", 1], ["160 us", -0.3]]
[analysis]
type = "dynamic"
duration = "160 us"
damping = { kind = "local", factor = 0.2 }
)";
}

/// A plate that is pulled until a crack runs from its notch, and pressed again: open and closed faces, friction,
/// damping, two materials.
inline const std::string cracking_plate =
    notched_plate("concrete", R"(tensile_strength = "3 MPa", fracture_energy = "20 J/m^2", cohesion = "8 MPa", )"
                              R"(friction_angle = "40 deg", residual_friction_angle = "30 deg")") +
    pulled_with_a_stone(R"(x = "20 um", y = "5 um")") + R"([output]
fields = ["displacement", "damage"]
history_every = "8 us"
checkpoint_every = "80 us"
)";

/// Runs of the program on it, as plate.toml.
class CrackingPlate : public ProgramTest {
 protected:
  CrackingPlate() { write_file(directory_ / "plate.toml", cracking_plate); }
  std::string file(const std::filesystem::path& name) const { return read_file(directory_ / name); }
  // Values of the last row of a history.
  std::vector<double> last_row(const std::filesystem::path& output) const {
    std::vector<double> row;
    for (const io::HistoryColumn& column : io::read_history(directory_ / output / "history.csv"))
      row.push_back(column.values.back());
    return row;
  }
  std::string refused(const std::string& options) const {
    const Ended ended = koshi("check plate.toml " + options);
    EXPECT_EQ(ended.code, 2) << options << ended.output;
    return ended.error;
  }
};

}  // namespace koshi::test
