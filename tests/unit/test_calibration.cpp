// The paper's calibration (N21): bond counts, Table 1, errors.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "koshi/calibration.h"
#include "koshi/error.h"

namespace koshi::material {
namespace {

using lattice::CellType;
using testing::HasSubstr;

constexpr double d = 0.002;                              // 0.2 cm
constexpr Elastic rock{1112e6, 0.18, 2000};              // the paper's material
constexpr Int3 uniaxial{4, 4, 8}, cantilever{9, 39, 9};  // cells of its two bodies
constexpr std::array all_cells{CellType::cube_i, CellType::cube_ii, CellType::cube_iii};

double total(const std::vector<BondGroup>& bonds) {
  double sum = 0;
  for (const BondGroup& bond : bonds) sum += bond.count;
  return sum;
}

BondStiffness paper(CellType cell, const Int3& cells, const std::string& axes) {
  return calibrate(box_bonds(cell, Sharing::plain, cells, d), box_volume(cells, d), rock, default_equations(cell),
                   axes);
}

std::string message_of(const std::vector<std::string>& equations, const std::string& axes = "xyz",
                       CellType cell = CellType::cube_ii, const Elastic& elastic = rock) {
  try {
    calibrate(bulk_bonds(cell, d), d * d * d, elastic, equations, axes);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

// Nishimura et al., section 3: 5 x 5 x 9 and 10 x 40 x 10 nodes.
TEST(Bonds, CountsOfThePaper) {
  const std::array<double, 3> small{560, 1488, 2000}, large{11100, 31620, 44256};
  for (std::size_t i = 0; i < all_cells.size(); ++i) {
    EXPECT_EQ(total(box_bonds(all_cells[i], Sharing::plain, uniaxial, d)), small[i]);
    EXPECT_EQ(total(box_bonds(all_cells[i], Sharing::plain, cantilever, d)), large[i]);
  }
}

// Counted one by one: a bond of a box belongs to it when both ends do; its share is the number of the box's cells that
// contain it over the number in the bulk.
TEST(Bonds, CountsBySlotAgreeWithCountingOneByOne) {
  constexpr std::array<int, 3> n{3, 1, 4};
  const auto plain = box_bonds(CellType::cube_iii, Sharing::plain, {3, 1, 4}, d);
  const auto shared = box_bonds(CellType::cube_iii, Sharing::shared, {3, 1, 4}, d);
  ASSERT_EQ(plain.size(), 13u);
  ASSERT_EQ(shared.size(), 13u);
  for (int slot = 0; slot < lattice::slot_count; ++slot) {
    const lattice::Slot& bond = lattice::slots[slot];
    double count = 0, share = 0;
    for (int x = 0; x <= n[0]; ++x)
      for (int y = 0; y <= n[1]; ++y)
        for (int z = 0; z <= n[2]; ++z) {
          const std::array<int, 3> start{x, y, z};
          int cells = 1;  // cells of the box that hold both ends
          bool inside = true;
          for (int axis = 0; axis < 3; ++axis) {
            const int end = start[axis] + bond.s[axis];
            inside = inside && end >= 0 && end <= n[axis];
            if (bond.s[axis] == 0) cells *= (start[axis] > 0) + (start[axis] < n[axis]);
          }
          if (!inside) continue;
          count += 1;
          share += static_cast<double>(cells) / lattice::cells_per_bond[bond.family];
        }
    EXPECT_EQ(plain[slot].count, count) << slot;
    EXPECT_EQ(shared[slot].count, share) << slot;
    for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(plain[slot].D[axis], -d * bond.s[axis]);
  }
}

// Table 1 of the paper [MN/m], to its last digit.
TEST(Calibrate, UniaxialSpringsOfThePaper) {
  const std::array<double, 3> kn{1.340, 0.605, 0.345}, kt{1.340, 0.134, 0.129};
  for (std::size_t i = 0; i < all_cells.size(); ++i) {
    const BondStiffness k = paper(all_cells[i], uniaxial, "xyz");
    EXPECT_NEAR(k.kn / 1e6, kn[i], 0.0005) << i;
    EXPECT_NEAR(k.kt / 1e6, kt[i], 0.0005) << i;
  }
  // Cube-I of the table follows from C1212 just as well.
  const std::vector<std::string> shear{"C1212"};
  const BondStiffness k =
      calibrate(box_bonds(CellType::cube_i, Sharing::plain, uniaxial, d), box_volume(uniaxial, d), rock, shear);
  EXPECT_NEAR(k.kn, paper(CellType::cube_i, uniaxial, "xyz").kn, 1e-6);
}

// Theory, section 5 [MN/m]; axis 1 along the beam.
TEST(Calibrate, CantileverSpringsOfThePaper) {
  const std::array<double, 3> kn{1.5266, 0.6258, 0.3590}, kt{1.5266, 0.1487, 0.1422};
  for (std::size_t i = 0; i < all_cells.size(); ++i) {
    const BondStiffness k = paper(all_cells[i], cantilever, "yxz");
    EXPECT_NEAR(k.kn / 1e6, kn[i], 0.00005) << i;
    EXPECT_NEAR(k.kt / 1e6, kt[i], 0.00005) << i;
  }
}

// The chosen entries, and no others, equal those of the elastic tensor.
TEST(Calibrate, MeetsItsEquations) {
  const ElasticTensor target = elastic_tensor(rock);
  const auto tensor = [&](CellType cell, const std::string& axes) {
    const Springs springs = uniform_springs(cell, paper(cell, cantilever, axes));
    return lattice_tensor(box_bonds(cell, Sharing::plain, cantilever, d, springs), box_volume(cantilever, d));
  };
  const double tight = 1e-12 * target(0, 0, 0, 0), apart = 1e-3 * target(0, 0, 0, 0);
  const ElasticTensor I = tensor(CellType::cube_i, "xyz");
  EXPECT_NEAR(I(0, 0, 0, 0) - I(0, 0, 1, 1), target(0, 0, 0, 0) - target(0, 0, 1, 1), tight);
  const ElasticTensor II = tensor(CellType::cube_ii, "yxz");  // 1 = y, 2 = x
  EXPECT_NEAR(II(1, 1, 0, 0), target(1, 1, 0, 0), tight);
  EXPECT_NEAR(II(1, 0, 1, 0), target(1, 0, 1, 0), tight);
  EXPECT_GT(std::abs(II(0, 0, 2, 2) - target(0, 0, 2, 2)), apart);
  const ElasticTensor III = tensor(CellType::cube_iii, "zxy");  // 1 = z, 2 = x
  EXPECT_NEAR(III(2, 2, 0, 0), target(2, 2, 0, 0), tight);
  EXPECT_NEAR(III(2, 2, 2, 2), target(2, 2, 2, 2), tight);
  EXPECT_GT(std::abs(III(1, 1, 1, 1) - target(1, 1, 1, 1)), apart);
}

// Factors and signs: C1111 - 2 C1212 = lambda in an isotropic solid, so it replaces C1122 where the lattice is
// isotropic.
TEST(Calibrate, LinearCombinations) {
  const auto bonds = bulk_bonds(CellType::cube_ii, d);
  const std::vector<std::string> entries{"C1122", "C1212"}, combined{" C1111 - 2*C1212", "-.5C2323+1.5 C1313"};
  const BondStiffness a = calibrate(bonds, d * d * d, rock, entries), b = calibrate(bonds, d * d * d, rock, combined);
  EXPECT_NEAR(a.kn / b.kn, 1, 1e-12);
  EXPECT_NEAR(a.kt / b.kt, 1, 1e-12);
  // In the bulk Cube-II with equal bonds is isotropic: the closed form gives the same springs.
  const Springs exact = isotropic_springs(CellType::cube_ii, rock, d);
  EXPECT_NEAR(a.kn / exact.kn[0], 1, 1e-12);
  EXPECT_NEAR(a.kt / exact.kt[1], 1, 1e-12);
}

// (N21) knows no lattice: six bonds along the face normals of an icosahedron's dual are isotropic. With n bonds of
// length L, mean(I_i I_j) = delta/3 and mean(I_1^2 I_2^2) = 1/15: C_1122 = n L^2/V (kn - kt)/15, C_1212 = n L^2/V (kt/6
// + (kn - kt)/15).
TEST(Calibrate, AnySetOfBonds) {
  const double golden = (1 + std::sqrt(5.0)) / 2, V = 3, L2 = 1 + golden * golden;
  std::vector<BondGroup> bonds;
  for (const double sign : {1.0, -1.0}) {
    bonds.push_back({{0, 1, sign * golden}, 2.5});
    bonds.push_back({{1, sign * golden, 0}, 2.5});
    bonds.push_back({{sign * golden, 0, 1}, 2.5});
  }
  const double s = 15 * L2 / V;  // n = 6 x 2.5
  const double normal = 15 * rock.lambda() / s;
  const double kt = 6 * (rock.mu() - rock.lambda()) / s;
  const std::vector<std::string> equations{"C2233", "C1313"};
  const BondStiffness k = calibrate(bonds, V, rock, equations);
  EXPECT_NEAR(k.kt / kt, 1, 1e-12);
  EXPECT_NEAR(k.kn / (kt + normal), 1, 1e-12);
  for (BondGroup& bond : bonds) {
    bond.kn = k.kn;
    bond.kt = k.kt;
  }
  EXPECT_NEAR(engineering_constants(lattice_tensor(bonds, V)).value().zener_ratio, 1, 1e-12);
}

TEST(Calibrate, SaysWhatIsWrong) {
  EXPECT_THAT(message_of({}), HasSubstr("0 equations; expected one"));
  EXPECT_THAT(message_of({"C1122", "C1212", "C1111"}), HasSubstr("3 equations"));
  EXPECT_THAT(message_of({"C1122", ""}), HasSubstr("equation \"\": it is empty"));
  EXPECT_THAT(message_of({"C1142", "C1212"}), HasSubstr("equation \"C1142\": index \"4\" is not 1, 2 or 3"));
  EXPECT_THAT(message_of({"lambda"}), HasSubstr("equation \"lambda\": \"lambda\" is no entry"));
  EXPECT_THAT(message_of({"C11"}), HasSubstr("\"C11\" is no entry"));
  EXPECT_THAT(message_of({"2"}), HasSubstr("\"\" is no entry"));
  EXPECT_THAT(message_of({"C1111C1122"}), HasSubstr("\"C1122\" is not joined by + or -"));
  EXPECT_THAT(message_of({"C1122", "C1212"}, "xyy"), HasSubstr("axes = \"xyy\"; expected a permutation"));
  EXPECT_THAT(message_of({"C1112", "C1212"}), HasSubstr("equation \"C1112\" holds no stiffness"));
  EXPECT_THAT(message_of({"C1122", "C2233"}), HasSubstr("\"C1122\" and \"C2233\" do not determine kn and kt"));
  // Without diagonals C1122 = 0 whatever the springs.
  EXPECT_THAT(message_of({"C1122"}, "xyz", CellType::cube_i), HasSubstr("equation \"C1122\" holds no stiffness"));
  EXPECT_THAT(message_of({"C1122"}), HasSubstr("equation \"C1122\" does not determine kn = kt: their parts cancel"));
  // kt = 2/5 (mu - lambda) d < 0 beyond nu = 1/4: 2/5 (1/2.6 - 0.3/0.52) 1e9 Pa 0.002 m.
  EXPECT_THAT(message_of({"C1122", "C1212"}, "xyz", CellType::cube_ii, {1e9, 0.3, 1}),
              HasSubstr("kt = -153846 N/m at nu = 0.3"));
  EXPECT_EQ(message_of({"C1122", "C1212"}, "xyz", CellType::cube_ii, {1e9, 0.25, 1}), "no error");
  EXPECT_EQ(message_of({"C1122", "C1212"}), "no error");
}

}  // namespace
}  // namespace koshi::material
