// How many materials may touch: bonds are bytes, so a body knows at most 255 kinds of them.
#include <gtest/gtest.h>

#include "koshi/model.h"

namespace koshi::model {
namespace {

// Cells of `count` materials and voids at random.
Definition mixture(int count) {
  constexpr int side = 24;
  Definition definition;
  definition.lattice.spacing = 1e-3;
  definition.body.size = {side * 1e-3, side * 1e-3, side * 1e-3};
  definition.body.material = "m1";
  for (int m = 1; m <= count; ++m) definition.materials.push_back({"m" + std::to_string(m), {m * 1e9, 0.2, 2000}});
  definition.body.cells.resize(side * side * side);
  std::uint32_t random = 1;
  for (auto& cell : definition.body.cells) {
    random = random * 1664525u + 1013904223u;
    cell = static_cast<std::uint8_t>((random >> 16) % static_cast<std::uint32_t>(count + 1));
  }
  definition.places.set("body", {"case.toml", 4, 1});
  return definition;
}

// Kinds are unordered choices, with repetition, of what lies around a bond: of 6 materials and void, C(10,4) = 210 for
// the four cells of an edge, C(8,2) = 28 for the two of a face diagonal, 7 for the one of a body diagonal; less the
// three of void alone, 242. Kind 0 is no bond.
TEST(BondClasses, SixMaterialsAndVoidsInEveryCombination) {
  EXPECT_EQ(make_model(mixture(6), Communicator::world()).lattice.classes.size(), 1u + 242u);
}

// With 7 materials: 330 + 36 + 8.
TEST(BondClasses, SaysWhereAndWhatToDoBeyond) {
  try {
    make_model(mixture(7), Communicator::world());
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_STREQ(
        error.what(),
        "case.toml:4:1: error: the mixtures of materials around bonds need more than 255 kinds of bonds; merge "
        "similar materials (about 6 may touch each other in every combination)");
  }
}

}  // namespace
}  // namespace koshi::model
