// What `koshi calibrate` prints.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "calibration/calibrate.h"
#include "koshi/error.h"

namespace koshi::calibration {
namespace {

using lattice::CellType;
using material::Calibration;
using material::Sharing;
using testing::HasSubstr;

constexpr material::Elastic rock{1112e6, 0.18, 2000};

model::LatticeDefinition lattice_of(CellType cell, Sharing sharing = Sharing::shared) {
  model::LatticeDefinition lattice;
  lattice.cell = cell;
  lattice.spacing = 0.002;
  lattice.springs = sharing;
  return lattice;
}

std::string message_of(const model::LatticeDefinition& lattice, const material::Elastic& elastic,
                       const std::optional<Vec3>& size = std::nullopt) {
  try {
    calibrate(lattice, elastic, size);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

// Table 1 of the paper [N/m], its bond counts, and C of the body with the two entries asked for.
TEST(CalibrateDriver, PaperBody) {
  const Calibrated found = calibrate(lattice_of(CellType::cube_iii, Sharing::plain), rock, Vec3{0.008, 0.008, 0.016});
  EXPECT_EQ(found.lattice.calibration, Calibration::paper);
  const nlohmann::json json = calibration_json(found);
  EXPECT_NEAR(json.at("springs").at("edge").at("kn").get<double>(), 0.345e6, 500);
  EXPECT_NEAR(json.at("springs").at("body").at("kt").get<double>(), 0.129e6, 500);
  EXPECT_EQ(json.at("input").at("bonds"), 2000);
  EXPECT_EQ(json.at("input").at("cells"), (std::vector<int>{4, 4, 8}));
  EXPECT_EQ(json.at("input").at("equations"), (std::vector<std::string>{"C1122", "C1111"}));
  const auto entry = [&](const char* tensor, int row, int column) {
    return json.at(tensor).at(row).at(column).get<double>();
  };
  EXPECT_NEAR(entry("stiffness_tensor", 0, 0) / entry("target_tensor", 0, 0), 1, 1e-12);
  EXPECT_NEAR(entry("stiffness_tensor", 0, 1) / entry("target_tensor", 0, 1), 1, 1e-12);
  EXPECT_GT(entry("stiffness_tensor", 2, 2) / entry("target_tensor", 2, 2), 1.04);
  const std::string report = calibration_report(found);
  EXPECT_THAT(report, HasSubstr("cube-III lattice, plain springs, calibration paper, kinematics rotational"));
  EXPECT_THAT(report, HasSubstr("C1122, C1111; axes 1, 2, 3 = x, y, z"));
  EXPECT_THAT(report, HasSubstr("4 x 4 x 8 cells, 2000 bonds"));
}

// The default: exact constants, speeds sqrt((lambda + 2 mu)/rho), sqrt(mu/rho).
TEST(CalibrateDriver, DefaultSpringsInTheBulk) {
  const Calibrated found = calibrate(lattice_of(CellType::cube_iii), rock);
  EXPECT_EQ(found.lattice.calibration, Calibration::bending_exact);
  EXPECT_EQ(calibrate(lattice_of(CellType::cube_ii), rock).lattice.calibration, Calibration::isotropic);
  const nlohmann::json json = calibration_json(found);
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(json.at("constants").at("youngs_modulus").at(axis).get<double>() / 1112e6, 1, 1e-12);
  EXPECT_NEAR(json.at("constants").at("zener_ratio").get<double>(), 1, 1e-12);
  // lambda + 2 mu = 1.20743e9 Pa, mu = 4.71186e8 Pa.
  EXPECT_NEAR(json.at("wave_speeds").at("p").get<double>(), 776.986, 5e-4);
  EXPECT_NEAR(json.at("wave_speeds").at("s").get<double>(), 485.379, 5e-4);
  EXPECT_NEAR(json.at("time_step").at("d_over_p").get<double>(), 0.002 / 776.986, 1e-11);
  EXPECT_EQ(json.at("self_check").at("verdict"), "ok");
  EXPECT_EQ(json.at("dispersion").size(), 18u);

  const std::string report = calibration_report(found);
  EXPECT_THAT(report, HasSubstr("the unit cell inside the bulk"));
  EXPECT_THAT(report, HasSubstr("x           1112        +0 %     nu_xy  0.180000        +0"));
  EXPECT_THAT(report, HasSubstr("energy of a twisted cell       1.000000 of the solid's"));
  EXPECT_THAT(report, HasSubstr("verdict                        ok"));
  EXPECT_EQ(report.find("remedy"), std::string::npos);

  const std::string csv = dispersion_csv(found);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 19);
  EXPECT_THAT(csv, HasSubstr("\n[100],20,773.79"));  // 776.986 sinc(pi/20)
}

// The springs of a model, and the verdict with its remedy.
TEST(CalibrateDriver, ExaminesGivenSprings) {
  const Calibrated gear =
      examine(lattice_of(CellType::cube_i), rock, material::isotropic_springs(CellType::cube_i, rock, 0.002));
  EXPECT_THAT(calibration_report(gear), HasSubstr("verdict                        warning\n    gear mode"));
  EXPECT_THAT(calibration_report(gear), HasSubstr("remedy: use kinematics \"least-squares\""));
  material::Springs hinges;
  hinges.kn[0] = 1e6;
  const Calibrated mechanism = examine(lattice_of(CellType::cube_i), rock, hinges);
  EXPECT_THAT(calibration_report(mechanism), HasSubstr("C is singular"));
  EXPECT_TRUE(calibration_json(mechanism).at("constants").is_null());
  EXPECT_EQ(calibration_json(mechanism).at("self_check").at("verdict"), "refused");
}

TEST(CalibrateDriver, SaysWhatIsWrong) {
  const auto good = lattice_of(CellType::cube_ii);
  EXPECT_EQ(message_of(good, rock, Vec3{0.002, 0.004, 0.002}), "no error");
  EXPECT_THAT(message_of(good, rock, Vec3{0.002, 0.003, 0.002}), HasSubstr("no positive multiple of the spacing"));
  EXPECT_THAT(message_of(good, {1e9, 0.5, 1}), HasSubstr("Poisson's ratio is 0.5"));
  EXPECT_THAT(message_of(good, {-1e9, 0.2, 1}), HasSubstr("Young's modulus is -1000000000"));
  EXPECT_THAT(message_of(good, {1e9, 0.2, 0}), HasSubstr("density is 0 kg/m^3; it must lie between"));
  EXPECT_THAT(message_of(lattice_of(CellType::cube_ii, Sharing::plain), {1e9, 0.3, 1}),
              HasSubstr("negative stiffness"));
  auto flat = good;
  flat.spacing = 0;
  EXPECT_THAT(message_of(flat, rock), HasSubstr("spacing is 0 m; it must lie between"));
  auto wrong = good;
  wrong.calibration = Calibration::bending_exact;
  EXPECT_THAT(message_of(wrong, rock), HasSubstr("\"cube-III\", not \"cube-II\""));
  auto unread = good;
  unread.equations = {"C1122", "C1212"};
  EXPECT_THAT(message_of(unread, rock), HasSubstr("are for calibration \"paper\""));
  unread.calibration = Calibration::paper;
  EXPECT_EQ(message_of(unread, rock), "no error");
}

}  // namespace
}  // namespace koshi::calibration
