// A step takes no memory: everything it needs is there before the first one.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <new>

#include "failure/bond_breaking.h"
#include "failure/cracking.h"
#include "koshi/dynamics.h"
#include "support/cases.h"

namespace {
std::int64_t allocations = 0;

void* counted(std::size_t size, std::size_t alignment) {
  ++allocations;
  void* memory = std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
}  // namespace

// The counting versions of what all other forms of new and delete end in.
void* operator new(std::size_t size) { return counted(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return counted(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace koshi {
namespace {

// Two materials, a hole, a moved and a loaded face, orientations; joined to itself along z, so that values are
// exchanged.
model::Definition busy_block(material::Kinematics kinematics, material::Sharing sharing) {
  model::Definition definition = test::block({12, 5, 4}, 0.1);
  definition.lattice.kinematics = kinematics;
  definition.lattice.springs = sharing;
  definition.body.periodic = {false, false, true};
  definition.materials.push_back({"clay", {1e8, 0.2, 1500}});
  for (const char* material : {"clay", "void"}) {
    model::RegionDefinition region;
    region.material = material;
    region.min = {material[0] == 'c' ? 0.8 : 0.2, 0.1, 0};
    region.max = {material[0] == 'c' ? 1.1 : 0.4, 0.3, 0.4};
    definition.regions.push_back(region);
  }
  model::BoundaryDefinition wall = test::fixed("wall", model::Face::x_min, {1, 2});
  wall.displacement[0] = 1e-3;
  wall.ramp = 1;
  definition.boundaries = {wall};
  model::LoadDefinition wind, weight;
  wind.name = "wind";
  wind.selection.face = model::Face::x_max;
  wind.pressure = 1e3;
  wind.history = {{0, 0}, {1, 1}};
  weight.name = "weight";
  weight.acceleration = Vec3{0, -9.81, 0};
  definition.loads = {wind, weight};
  definition.analysis.damping.kind = model::DampingDefinition::Kind::local;
  return definition;
}

class Allocation : public testing::TestWithParam<std::tuple<material::Kinematics, material::Sharing>> {};

TEST_P(Allocation, NoneInAStep) {
  const auto [kinematics, sharing] = GetParam();
  const model::Model model = model::make_model(busy_block(kinematics, sharing), Communicator::world());
  model::State state(model);
  if (model.components() == 6) {
    state.orientation = lattice::Field<double>(model.layout(), 4);
    std::fill_n(state.orientation.component(0), state.orientation.stride(), 1.0);
  }
  dynamics::ExplicitSolver solver(model, state, 1e-6);
  solver.step();  // the first exchange sizes its messages
  const std::int64_t before = allocations;
  EXPECT_GT(before, 100) << "the counter works";
  for (int step = 0; step < 100; ++step) solver.step();
  EXPECT_EQ(allocations, before);
  EXPECT_EQ(state.step, 101);
}

// Nor do cracks, neither the cells that crack in a step nor those that are closed and slide.
TEST(CrackingAllocation, NoneInAStep) {
  model::Definition definition = busy_block(material::Kinematics::rotational, material::Sharing::shared);
  material::Fracture& fracture = definition.materials[0].fracture.emplace();
  fracture.tensile_strength = 1e5;
  fracture.fracture_energy = 1;
  fracture.cohesion = 2e5;
  fracture.residual_friction_angle = 0.5;
  // Pulled by 1 mm and back: strains of some 1e-3, beyond 1e5 Pa / 1112 MPa = 9e-5.
  definition.boundaries[0].ramp = 0;
  definition.boundaries[0].history = {{0, 0}, {1e-5, 0}, {5e-4, -1}, {1.5e-3, 1}};
  model::Model model = model::make_model(definition, Communicator::world());
  model::State state(model);
  failure::Cracking cracking(model, state);
  dynamics::ExplicitSolver solver(model, state, 1e-5, &cracking);
  solver.step();
  const auto cracked = [&] {
    std::int64_t count = 0;
    lattice::for_each_owned(model.layout(),
                            [&](auto, auto, auto, auto n) { count += state.crack.component(0)[n] > 0; });
    return count;
  };
  EXPECT_EQ(cracked(), 0);
  const std::int64_t before = allocations;
  for (int step = 0; step < 140; ++step) solver.step();
  EXPECT_EQ(allocations, before);
  EXPECT_GT(cracked(), 10);
}

// Nor do bonds that break, nor those that carry pressure.
TEST(BondBreakingAllocation, NoneInAStep) {
  model::Definition definition = busy_block(material::Kinematics::rotational, material::Sharing::shared);
  definition.lattice.calibration = material::Calibration::isotropic;
  material::Fracture& fracture = definition.materials[0].fracture.emplace();
  fracture.law = material::FractureLaw::bonds;
  fracture.critical_stretch = 1e-4;
  fracture.critical_shear = 3e-4;
  definition.boundaries[0].ramp = 0;
  definition.boundaries[0].history = {{0, 0}, {1e-5, 0}, {5e-4, -1}, {1.5e-3, 1}};
  model::Model model = model::make_model(definition, Communicator::world());
  model::State state(model);
  failure::BondBreaking breaking(model, state);
  dynamics::ExplicitSolver solver(model, state, 1e-5, &breaking);
  solver.step();
  EXPECT_EQ(breaking.count(), 0);
  const std::int64_t before = allocations;
  for (int step = 0; step < 140; ++step) solver.step();
  EXPECT_EQ(allocations, before);
  EXPECT_GT(breaking.count(), 10);
}

INSTANTIATE_TEST_SUITE_P(All, Allocation,
                         testing::Combine(testing::Values(material::Kinematics::rotational,
                                                          material::Kinematics::least_squares),
                                          testing::Values(material::Sharing::shared, material::Sharing::plain)));

}  // namespace
}  // namespace koshi
