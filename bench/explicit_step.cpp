// The explicit step, local damping on, in million node-steps per second.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "failure/bond_breaking.h"
#include "failure/cracking.h"
#include "koshi/dynamics.h"
#include "koshi/model.h"

namespace koshi {
namespace {

using lattice::CellType;
using material::Calibration;
using material::Kinematics;

// Whether the cells are looked at for cracks, and whether one in a hundred has one; whether bonds are, and one in a
// hundred is broken.
enum class Cracks { none, looked_for, some, bonds_looked_for, some_bonds };

struct Choice {
  const char* name;
  CellType cell;
  Calibration calibration;
  Kinematics kinematics;
  double nu;
  int materials;         // 1: uniform block; more: every cell one of them at random
  bool factors = false;  // every cell has a factor of its own
  Cracks cracks = Cracks::none;
};

constexpr Choice choices[] = {
    {"Cube-I, rotational", CellType::cube_i, Calibration::isotropic, Kinematics::rotational, 0.0, 1},
    {"Cube-II, rotational", CellType::cube_ii, Calibration::isotropic, Kinematics::rotational, 0.18, 1},
    {"Cube-III, rotational", CellType::cube_iii, Calibration::isotropic, Kinematics::rotational, 0.18, 1},
    {"Cube-III volumetric, rotational", CellType::cube_iii, Calibration::bending_exact, Kinematics::rotational, 0.18,
     1},
    {"Cube-II, least-squares", CellType::cube_ii, Calibration::isotropic, Kinematics::least_squares, 0.18, 1},
    {"Cube-III volumetric, least-squares", CellType::cube_iii, Calibration::bending_exact, Kinematics::least_squares,
     0.18, 1},
    {"Cube-III volumetric, rotational, may crack", CellType::cube_iii, Calibration::bending_exact,
     Kinematics::rotational, 0.18, 1, false, Cracks::looked_for},
    {"Cube-III volumetric, rotational, 1 % of the cells cracked", CellType::cube_iii, Calibration::bending_exact,
     Kinematics::rotational, 0.18, 1, false, Cracks::some},
    {"Cube-III, rotational, bonds may break", CellType::cube_iii, Calibration::isotropic, Kinematics::rotational, 0.18,
     1, false, Cracks::bonds_looked_for},
    {"Cube-III, rotational, 1 % of the bonds broken", CellType::cube_iii, Calibration::isotropic,
     Kinematics::rotational, 0.18, 1, false, Cracks::some_bonds},
    {"Cube-III volumetric, rotational, 2 materials mixed", CellType::cube_iii, Calibration::bending_exact,
     Kinematics::rotational, 0.18, 2},
    {"Cube-III volumetric, rotational, 3 materials mixed", CellType::cube_iii, Calibration::bending_exact,
     Kinematics::rotational, 0.18, 3},
    {"Cube-III volumetric, rotational, 1000 materials mixed", CellType::cube_iii, Calibration::bending_exact,
     Kinematics::rotational, 0.18, 1000},
    {"Cube-III volumetric, rotational, 3 materials and factors mixed", CellType::cube_iii, Calibration::bending_exact,
     Kinematics::rotational, 0.18, 3, true},
    {"Cube-III volumetric, least-squares, 3 materials mixed", CellType::cube_iii, Calibration::bending_exact,
     Kinematics::least_squares, 0.18, 3},
    {"Cube-III volumetric, least-squares, 1000 materials mixed", CellType::cube_iii, Calibration::bending_exact,
     Kinematics::least_squares, 0.18, 1000},
};

bool breaks_bonds(const Choice& choice) {
  return choice.cracks == Cracks::bonds_looked_for || choice.cracks == Cracks::some_bonds;
}

model::Definition block(const Choice& choice, int nodes) {
  model::Definition definition;
  definition.lattice.cell = choice.cell;
  definition.lattice.calibration = choice.calibration;
  definition.lattice.kinematics = choice.kinematics;
  definition.lattice.spacing = 1e-3;
  const double side = 1e-3 * (nodes - 1);
  definition.body.size = {side, side, side};
  definition.body.material = "a";
  for (int m = 0; m < std::max(choice.materials, 3); ++m)
    definition.materials.push_back({m == 0 ? "a" : "a" + std::to_string(m), {1e9 * (1 + m % 100), choice.nu, 2000}});
  if (choice.materials > 1) {
    const auto count = static_cast<std::size_t>(nodes - 1);
    definition.body.cells.resize(count * count * count);
    std::uint32_t random = 1;
    for (auto& cell : definition.body.cells) {
      random = random * 1664525u + 1013904223u;
      cell = static_cast<std::uint16_t>(1 + (random >> 20) % static_cast<std::uint32_t>(choice.materials));
    }
  }
  if (choice.factors) {
    std::uint32_t random = 2;
    definition.body.factors.resize(definition.body.cells.size());
    for (float& factor : definition.body.factors) {
      random = random * 1664525u + 1013904223u;
      factor = static_cast<float>(random >> 8) / (1u << 24);
    }
  }
  // Far stronger than the motion asks for: no cell cracks while the clock runs.
  material::Fracture strong;
  strong.tensile_strength = strong.fracture_energy = 1e6;
  if (breaks_bonds(choice)) strong.law = material::FractureLaw::bonds;
  if (choice.cracks != Cracks::none)
    for (model::MaterialDefinition& material : definition.materials) material.fracture = strong;
  model::BoundaryDefinition bottom;
  bottom.name = "bottom";
  bottom.selection.face = model::Face::z_min;
  bottom.fix.fill(true);
  definition.boundaries = {bottom};
  definition.analysis.type = model::AnalysisDefinition::Type::dynamic;
  definition.analysis.duration = 1;
  definition.analysis.damping = {model::DampingDefinition::Kind::local, 0.8, 0};
  return definition;
}

// Gives one cell in a hundred a crack that is half through, across x: some of them are closed at any time.
void crack_some(const model::Model& model, model::State& motion) {
  lattice::for_each_owned(model.layout(), [&](auto i, auto j, auto k, auto n) {
    if (model.lattice.cell.component(0)[n] == 0 || (7 * i + 31 * j + 57 * k) % 100 != 0) return;
    motion.crack.component(0)[n] = 0.5;
    for (int part = 1; part < 7; ++part) motion.crack.component(part)[n] = 1;
  });
}

// Breaks the bonds of one layer of a hundred, those that cross the plane above every hundredth layer of nodes.
void break_some(model::State& motion, const lattice::Layout& layout) {
  unsigned across = 0;
  for (int slot = 0; slot < lattice::slot_count; ++slot)
    across |= (lattice::slots[static_cast<std::size_t>(slot)].s[2] != 0 ? 1U : 0U) << slot;
  lattice::for_each_owned(layout, [&](auto, auto, auto k, auto n) {
    if (k % 100 == 20) motion.bonds.component(0)[n] = across;
  });
}

void explicit_step(benchmark::State& state, const Choice& choice) {
  const int nodes = static_cast<int>(state.range(0));
  model::Model model = model::make_model(block(choice, nodes), Communicator::world());
  model::State motion(model);
  for (int c = 0; c < model.components(); ++c)
    lattice::for_each_owned(model.layout(), [&](auto i, auto j, auto k, auto n) {
      motion.velocity.component(c)[n] = 1e-6 * static_cast<double>((i + 2 * j + 3 * k + c) % 7 - 3);
    });
  if (choice.cracks == Cracks::some) crack_some(model, motion);
  if (choice.cracks == Cracks::some_bonds) break_some(motion, model.layout());
  std::unique_ptr<failure::Fracturing> cracking;
  if (breaks_bonds(choice))
    cracking = std::make_unique<failure::BondBreaking>(model, motion);
  else if (choice.cracks != Cracks::none)
    cracking = std::make_unique<failure::Cracking>(model, motion);
  dynamics::ExplicitSolver solver(model, motion, 2e-7, cracking.get());
  solver.step();
  // The median step: others may use the machine now and then, and a rank waits for its neighbours.
  std::vector<double> seconds;
  for (auto _ : state) {
    const auto start = std::chrono::steady_clock::now();
    solver.step();
    seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  std::nth_element(seconds.begin(), seconds.begin() + static_cast<std::ptrdiff_t>(seconds.size() / 2), seconds.end());
  const double rate = 1e-6 * static_cast<double>(model.node_count) / seconds[seconds.size() / 2];
  state.counters["Mnode-steps/s"] = rate;
  if (breaks_bonds(choice)) state.counters["Mbonds/s"] = lattice::slot_count * rate;
}

const bool registered = [] {
  for (const Choice& choice : choices) {
    auto* bench =
        benchmark::RegisterBenchmark((std::string("explicit_step/") + choice.name).c_str(), explicit_step, choice);
    bench->Unit(benchmark::kMillisecond)->Arg(64)->Arg(128)->Arg(192);
    if (choice.materials == 1) bench->Arg(256);
    // A fixed number of steps, so that all ranks take the same ones.
    bench->UseRealTime()->Iterations(15);
  }
  return true;
}();

}  // namespace
}  // namespace koshi
