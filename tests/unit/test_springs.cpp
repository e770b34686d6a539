// The closed forms for springs (theory, sections 7 and 8): reference springs, exact elastic tensors, ranges.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "koshi/calibration.h"
#include "koshi/error.h"
#include "support/reference_cells.h"

namespace koshi::material {
namespace {

using lattice::CellType;

struct Choice {
  CellType cell;
  Calibration calibration;
  Kinematics kinematics;
};

constexpr std::array choices{
    Choice{CellType::cube_i, Calibration::isotropic, Kinematics::rotational},
    Choice{CellType::cube_ii, Calibration::isotropic, Kinematics::rotational},
    Choice{CellType::cube_iii, Calibration::isotropic, Kinematics::rotational},
    Choice{CellType::cube_iii, Calibration::bending_exact, Kinematics::rotational},
    Choice{CellType::cube_iii, Calibration::bending_exact, Kinematics::least_squares},
};

constexpr double poissons_ratios[]{-0.9, -0.5, -0.3, 0, 0.18, 0.25, 0.3, 0.304, 1.0 / 3, 0.4, 0.45, 0.49, 0.499};

// The file prints 12 decimals.
TEST(Springs, ReferenceSprings) {
  const auto cells = test::reference_cells();
  ASSERT_EQ(cells.size(), 39u);
  for (const auto& reference : cells) {
    const Springs k = springs_for(reference.cell, reference.calibration, reference.kinematics, reference.elastic, 1);
    for (int family = 0; family < lattice::family_count; ++family) {
      EXPECT_NEAR(k.kn[family], reference.springs.kn[family], 1e-12) << reference.name;
      EXPECT_NEAR(k.kt[family], reference.springs.kt[family], 1e-12) << reference.name;
    }
    EXPECT_NEAR(k.kappa, reference.springs.kappa, 1e-12) << reference.name;
  }
}

// C of the bulk equals the elastic tensor, so E, nu and the Zener ratio are those asked for. Near nu = 1/2 the
// compliance loses digits in the ratio lambda/mu (500 at nu = 0.499): tolerances 1e-12 and 1e-15 lambda/mu.
TEST(Springs, ElasticTensorIsExact) {
  const double d = 0.003;
  int checked = 0;
  for (const Choice& choice : choices)
    for (const double nu : poissons_ratios) {
      const Elastic elastic{70e9, nu, 2700};
      const Springs k = springs_for(choice.cell, choice.calibration, choice.kinematics, elastic, d);
      const ElasticTensor C = lattice_tensor(k, d), target = elastic_tensor(elastic);
      const double scale = elastic.lambda() + 2 * elastic.mu();
      for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j) EXPECT_NEAR(C.voigt[i][j] / scale, target.voigt[i][j] / scale, 1e-15);

      const EngineeringConstants found = engineering_constants(C).value();
      const double tolerance = 1e-12 + 1e-15 * std::abs(elastic.lambda()) / elastic.mu();
      for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(found.youngs_modulus[i] / 70e9, 1, tolerance) << nu;
        EXPECT_NEAR(found.shear_modulus[i] / elastic.mu(), 1, 1e-12) << nu;
        for (int j = 0; j < 3; ++j)
          if (i != j) EXPECT_NEAR(found.poissons_ratio[i][j], nu, tolerance) << nu;
      }
      EXPECT_NEAR(found.zener_ratio, 1, 1e-12) << nu;
      ++checked;
    }
  EXPECT_EQ(checked, 65);
}

// Springs of a box shared between its cells give the same tensor whatever the box; full springs at the surface do not.
TEST(Springs, SharedSpringsAreExactForAnyBox) {
  const Elastic elastic{1, 0.2, 1};
  const Springs k = isotropic_springs(CellType::cube_iii, elastic, 0.5);
  const ElasticTensor target = elastic_tensor(elastic);
  for (const Int3& cells : {Int3{1, 1, 1}, Int3{2, 5, 3}}) {
    const auto tensor = [&](Sharing sharing) {
      return lattice_tensor(box_bonds(CellType::cube_iii, sharing, cells, 0.5, k), box_volume(cells, 0.5), k.kappa);
    };
    EXPECT_NEAR(tensor(Sharing::shared)(0, 0, 0, 0), target(0, 0, 0, 0), 1e-14);
    EXPECT_NEAR(tensor(Sharing::shared)(0, 1, 0, 1), target(0, 1, 0, 1), 1e-14);
    EXPECT_GT(tensor(Sharing::plain)(0, 0, 0, 0), 1.1 * target(0, 0, 0, 0));
  }
}

// Signs promised by the theory: isotropic springs are never negative for a bulk modulus >= 0 (all nu > -1), Cube-I's
// volumetric spring aside; bending-exact rotational springs are positive everywhere, kappa for nu >= 0;
// bending-exact least-squares springs for 0 <= nu <= 1/3.
TEST(Springs, Signs) {
  int checked = 0;
  for (const Choice& choice : choices)
    for (double nu = -0.99; nu < 0.4995; nu += 0.01) {
      const Springs k = springs_for(choice.cell, choice.calibration, choice.kinematics, {1, nu, 1}, 1);
      const bool least_squares = choice.kinematics == Kinematics::least_squares;
      if (least_squares && (nu < 0 || nu > 1.0 / 3)) continue;
      for (int family = 0; family < lattice::families_of(choice.cell); ++family) {
        EXPECT_GE(k.kn[family], 0) << nu;
        EXPECT_GT(k.kt[family], 0) << nu;
      }
      if (nu >= 0 && !least_squares) EXPECT_GE(k.kappa, -1e-15) << nu;
      ++checked;
    }
  EXPECT_EQ(checked, 4 * 149 + 34);
}

// The anisotropy of equal springs in Cube-III (theory, section 3): with kn = kt = k in the bulk,
// C1111 = (1 + 2 + 4/3) k + (2 + 8/3) k = 9 k, C1122 = 0, C1212 = (1/2 + 2 + 2) k = 9/2 k: ratio 1. With kt = 0:
// C1111 = 13/3, C1122 = C1212 = 7/3, so the ratio is 2 x 7/3 / 2 = 7/3.
TEST(Springs, ZenerRatioOfEqualSprings) {
  const auto ratio = [](double kn, double kt) {
    return engineering_constants(lattice_tensor(uniform_springs(CellType::cube_iii, {kn, kt}), 1)).value().zener_ratio;
  };
  EXPECT_NEAR(ratio(1, 1), 1, 1e-14);
  EXPECT_NEAR(ratio(1, 0), 7.0 / 3, 1e-14);
}

TEST(Springs, SaysWhatIsWrong) {
  const auto message = [](CellType cell, Calibration calibration, const Elastic& elastic) -> std::string {
    try {
      springs_for(cell, calibration, Kinematics::rotational, elastic, 1);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  };
  using testing::HasSubstr;
  const Elastic good{1, 0.2, 1};
  EXPECT_EQ(message(CellType::cube_iii, Calibration::bending_exact, good), "no error");
  EXPECT_THAT(message(CellType::cube_ii, Calibration::bending_exact, good), HasSubstr("\"cube-III\", not \"cube-II\""));
  EXPECT_THAT(message(CellType::cube_ii, Calibration::paper, good), HasSubstr("needs the bonds of a body"));
  EXPECT_THAT(message(CellType::cube_ii, Calibration::isotropic, {0, 0.2, 1}), HasSubstr("must be positive"));
  EXPECT_THAT(message(CellType::cube_ii, Calibration::isotropic, {1, 0.5, 1}), HasSubstr("between -1 and 0.5"));
  EXPECT_THAT(message(CellType::cube_ii, Calibration::isotropic, {1, -1, 1}), HasSubstr("between -1 and 0.5"));
}

}  // namespace
}  // namespace koshi::material
