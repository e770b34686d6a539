// A right case, and the messages of what breaks it.
#pragma once

#include <gtest/gtest.h>

#include <span>
#include <string>

#include "koshi/input.h"

namespace koshi::tests {

inline const std::string right_case = R"(title = "base"
[lattice]
cell = "cube-III"
spacing = "0.2 cm"
[body]
size = ["0.8 cm", "0.8 cm", "1.6 cm"]
material = "rock"
[material.rock]
youngs_modulus = "1112 MPa"
poissons_ratio = 0.18
density = "2000 kg/m^3"
[[region]]
shape = "sphere"
center = [0, 0, 0]
radius = "1 mm"
material = "void"
[[boundary]]
name = "bottom"
face = "z-min"
fix = ["x", "y", "z"]
[[boundary]]
name = "top"
face = "z-max"
displacement = { z = "-0.1 mm" }
[[load]]
name = "push"
face = "x-max"
force = ["1 N", 0, 0]
[analysis]
type = "quasi-static"
damping = { kind = "local", factor = 0.8 }
[[probe]]
name = "tip"
point = [0, 0, 0]
[output]
every = "1 s"
[[selection]]
name = "spot"
face = "y-min"
)";

/// The right case with one text replaced, and the whole message that must follow "case.toml:".
struct Broken {
  std::string right;
  std::string wrong;
  std::string message;
};

/// The message of an input; empty when it is right.
inline std::string message_of(const std::string& text, std::span<const std::string> overrides = {}) {
  try {
    io::read_case_text(text, "case.toml", overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

inline void expect_messages(std::span<const Broken> inputs) {
  ASSERT_EQ(message_of(right_case), "");
  for (const Broken& input : inputs) {
    // The text to replace must stand exactly once, else the case tests nothing.
    const std::size_t at = right_case.find(input.right);
    ASSERT_NE(at, std::string::npos) << input.right;
    ASSERT_EQ(right_case.find(input.right, at + 1), std::string::npos) << input.right;
    std::string text = right_case;
    text.replace(at, input.right.size(), input.wrong);
    EXPECT_EQ(message_of(text), "case.toml:" + input.message) << input.wrong;
  }
}

}  // namespace koshi::tests
