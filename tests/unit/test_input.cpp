// The reader on right input: the examples, defaults, overrides, the way back.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "koshi/input.h"

namespace koshi::io {
namespace {

using namespace model;

std::filesystem::path example(const std::string& name) {
  return std::filesystem::path(KOSHI_SOURCE_DIR) / "examples" / name / "case.toml";
}

constexpr std::array<bool, 6> all_fixed{true, true, true, true, true, true};

TEST(ReadCase, UniaxialPaper) {
  const Definition d = read_case(example("01_uniaxial_paper"));
  EXPECT_EQ(d.title, "Uniaxial compression, Cube-III, as in the paper");
  EXPECT_EQ(d.lattice.cell, lattice::CellType::cube_iii);
  EXPECT_EQ(d.lattice.spacing, 0.002);
  EXPECT_EQ(d.lattice.springs, material::Sharing::plain);
  EXPECT_EQ(d.lattice.calibration, material::Calibration::paper);
  EXPECT_EQ(d.lattice.kinematics, material::Kinematics::rotational);
  // Not given: the equations of the paper for Cube-III, axes as they are.
  EXPECT_EQ(d.lattice.equations, (std::vector<std::string>{"C1122", "C1111"}));
  EXPECT_EQ(d.lattice.axes, "xyz");
  EXPECT_EQ(d.body.origin, Vec3{});
  EXPECT_EQ(d.body.size, (Vec3{0.008, 0.008, 0.016}));
  EXPECT_EQ(d.body.material, "rock");
  ASSERT_EQ(d.materials.size(), 1u);
  EXPECT_EQ(d.materials[0].name, "rock");
  EXPECT_EQ(d.materials[0].elastic.youngs_modulus, 1.112e9);
  EXPECT_EQ(d.materials[0].elastic.poissons_ratio, 0.18);
  EXPECT_EQ(d.materials[0].elastic.density, 2000);
  EXPECT_TRUE(d.regions.empty());
  ASSERT_EQ(d.boundaries.size(), 2u);
  EXPECT_EQ(d.boundaries[0].name, "bottom platen");
  EXPECT_EQ(d.boundaries[0].selection.face, Face::z_min);
  EXPECT_EQ(d.boundaries[0].fix, (std::array<bool, 6>{false, false, true, true, true, true}));
  EXPECT_EQ(d.boundaries[1].selection.face, Face::z_max);
  EXPECT_EQ(d.boundaries[1].velocity[2], -0.001);
  EXPECT_FALSE(d.boundaries[1].velocity[0]);
  EXPECT_FALSE(d.boundaries[1].displacement[2]);
  EXPECT_TRUE(d.loads.empty());
  EXPECT_EQ(d.analysis.type, AnalysisDefinition::Type::dynamic);
  EXPECT_EQ(d.analysis.duration, 0.32);
  EXPECT_EQ(d.analysis.time_step, 1e-7);
  EXPECT_EQ(d.analysis.damping.kind, DampingDefinition::Kind::local);
  EXPECT_EQ(d.analysis.damping.factor, 0.8);
  ASSERT_EQ(d.probes.size(), 3u);
  EXPECT_EQ(d.probes[0].name, "top force");
  EXPECT_EQ(d.probes[0].quantity, ProbeDefinition::Quantity::reaction);
  EXPECT_EQ(d.probes[0].reduce, ProbeDefinition::Reduce::sum);
  EXPECT_EQ(d.probes[2].selection.point, (Vec3{0.008, 0.004, 0.008}));
  EXPECT_EQ(d.probes[2].quantity, ProbeDefinition::Quantity::displacement);
  EXPECT_EQ(d.probes[2].reduce, ProbeDefinition::Reduce::mean);
  EXPECT_EQ(d.output.fields, (std::vector<std::string>{"displacement", "rotation", "stress", "strain"}));
  EXPECT_EQ(d.output.every, 0.08);
  EXPECT_FALSE(d.output.checkpoint_every);
  EXPECT_EQ(d.directory, example("01_uniaxial_paper").parent_path());
}

TEST(ReadCase, CantileverPaper) {
  const Definition d = read_case(example("02_cantilever_paper"));
  EXPECT_EQ(d.lattice.cell, lattice::CellType::cube_ii);
  EXPECT_EQ(d.lattice.axes, "yxz");
  EXPECT_EQ(d.lattice.equations, (std::vector<std::string>{"C1122", "C1212"}));
  EXPECT_EQ(d.body.size, (Vec3{0.018, 0.078, 0.018}));
  ASSERT_EQ(d.boundaries.size(), 1u);
  EXPECT_EQ(d.boundaries[0].fix, all_fixed);
  ASSERT_EQ(d.loads.size(), 1u);
  EXPECT_EQ(d.loads[0].name, "tip load");
  EXPECT_EQ(d.loads[0].selection.face, Face::y_max);
  EXPECT_EQ(d.loads[0].force, (Vec3{9.8, 0, 0}));
  EXPECT_EQ(d.loads[0].distribution, LoadDefinition::Distribution::nodes);
  EXPECT_FALSE(d.loads[0].traction || d.loads[0].pressure || d.loads[0].acceleration);
  EXPECT_EQ(d.analysis.type, AnalysisDefinition::Type::quasi_static);
  EXPECT_EQ(d.analysis.tolerance, 1e-6);
  EXPECT_FALSE(d.analysis.time_step);
  ASSERT_EQ(d.probes.size(), 1u);
  EXPECT_EQ(d.probes[0].selection.point, (Vec3{0.008, 0.078, 0.01}));
}

TEST(ReadCase, CantileverExact) {
  const Definition d = read_case(example("03_cantilever_exact"));
  EXPECT_EQ(d.lattice.springs, material::Sharing::shared);
  EXPECT_EQ(d.lattice.calibration, material::Calibration::bending_exact);
  EXPECT_TRUE(d.lattice.equations.empty());
  EXPECT_EQ(d.loads.at(0).distribution, LoadDefinition::Distribution::area);
  EXPECT_EQ(d.analysis.type, AnalysisDefinition::Type::statics);
  EXPECT_EQ(d.analysis.tolerance, 1e-10);
  EXPECT_EQ(d.probes.at(0).reduce, ProbeDefinition::Reduce::area_mean);
  EXPECT_EQ(d.output.fields, std::vector<std::string>{"displacement"});
}

TEST(ReadCase, TwoPhaseBlock) {
  const Definition d = read_case(example("04_two_phase_block"));
  EXPECT_EQ(d.lattice.spacing, 0.001);
  EXPECT_EQ(d.lattice.calibration, material::Calibration::isotropic);
  EXPECT_EQ(d.body.size, (Vec3{0.04, 0.04, 0.08}));
  // Materials keep the order of the file: it is their index in the cells.
  ASSERT_EQ(d.materials.size(), 3u);
  EXPECT_EQ(d.materials[0].name, "mortar");
  EXPECT_EQ(d.materials[1].name, "aggregate");
  EXPECT_EQ(d.materials[2].name, "clay");
  EXPECT_EQ(d.materials[1].elastic.youngs_modulus, 60e9);
  ASSERT_EQ(d.regions.size(), 3u);
  EXPECT_EQ(d.regions[0].shape, RegionDefinition::Shape::sphere);
  EXPECT_EQ(d.regions[0].center, (Vec3{0.02, 0.02, 0.05}));
  EXPECT_EQ(d.regions[0].radius, 0.012);
  EXPECT_EQ(d.regions[2].shape, RegionDefinition::Shape::cylinder);
  EXPECT_EQ(d.regions[2].start, (Vec3{0.03, 0, 0.025}));
  EXPECT_EQ(d.regions[2].end, (Vec3{0.03, 0.04, 0.025}));
  EXPECT_EQ(d.regions[2].material, "void");
  EXPECT_EQ(d.boundaries.at(1).displacement[2], -8e-5);
  EXPECT_EQ(d.boundaries.at(1).fix, (std::array<bool, 6>{true, true, false, true, true, true}));
  EXPECT_EQ(d.output.fields.at(3), "material");
}

}  // namespace
}  // namespace koshi::io
