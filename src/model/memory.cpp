#include "model/memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <random>
#include <set>
#include <string>

#include "base/free_memory.h"
#include "koshi/model.h"
#include "lattice/partition.h"
#include "model/regions.h"

namespace koshi::model {
namespace {

// The static solver beside the model and the state (statics/level.h, solve_static.cpp): PETSc's solution and three
// vectors of conjugate gradients, without ghosts; on each level b, x and y in single precision with ghosts and padding;
// the coarsest level as a matrix of 27 nodes a row and its Cholesky factor, which were measured. Mixed bodies take
// more, see mixed_bytes().
double solver_bytes(const lattice::Grid& grid, int components, int ranks) {
  const double vector = 8.0 * components * static_cast<double>(grid.node_count());
  double bytes = 4 * vector;
  for (lattice::Grid level = grid;; level.d *= 2) {
    const Int3 n = level.nodes();
    const std::int64_t pitch = (n[0] + 2 + 15) / 16 * 16;
    const double values = static_cast<double>(pitch * (n[1] + 2) * (n[2] + 2));
    bytes += 3.0 * 4 * components * values;
    const double unknowns = static_cast<double>(level.node_count() * components);
    if (unknowns <= 8000)
      return bytes + ranks * (12.0 * 27 * components * unknowns + 12e6 * std::pow(unknowns / 4536, 4.0 / 3));
    for (std::int64_t& cells : level.cells) cells = (cells + 1) / 2;
  }
}

// Where materials mix, the static solver keeps the kinds of each distinct row of cells, two bytes a cell, or their
// seven constants where all differ (spring_rows.h), and the inverse blocks of each distinct group of 16 nodes that is
// not uniform, two bytes an element and a unit for each node (node_blocks.h). How many are distinct is told from a
// sample of rows.
double mixed_bytes(const Definition& definition, const lattice::Grid& grid, int components) {
  const bool scattered = definition.varies_in_stiffness();
  if (definition.body.cells.empty() && definition.body.factors.empty() && definition.regions.empty() && !scattered)
    return 0;
  constexpr int rows_sampled = 400;
  constexpr std::int64_t group_nodes = 16;
  const auto material_of = material_of_cells(definition, grid);
  const auto factor_of = definition.cuts() ? fraction_of_cells(definition, grid) : factor_of_cells(definition, grid);
  std::minstd_rand random;  // the same sample every time
  // A number that tells cells of different material or factor apart.
  const auto kind_of = [&](const Int3& cell) -> char32_t {
    const char32_t material = material_of(cell);
    if (material == 0) return material;
    if (scattered) return static_cast<char32_t>(random());  // no two cells are alike
    if (!factor_of) return material;
    return material ^ std::bit_cast<std::uint32_t>(factor_of(cell)) * 2654435761u;
  };
  const Int3& n = grid.cells;
  const std::int64_t groups_per_row = (n[0] + group_nodes) / group_nodes;
  std::set<std::u32string> rows, groups;
  for (int sample = 0; sample < rows_sampled; ++sample) {
    const std::int64_t j = static_cast<std::int64_t>(random()) % n[1], k = static_cast<std::int64_t>(random()) % n[2];
    std::array<std::u32string, 4> around;  // the rows of cells around a row of nodes
    for (std::size_t r = 0; r < around.size(); ++r)
      for (std::int64_t i = 0; i < n[0]; ++i)
        around[r] +=
            kind_of({i, std::min<std::int64_t>(j + (r & 1), n[1] - 1), std::min<std::int64_t>(k + (r >> 1), n[2] - 1)});
    rows.insert(around[0]);
    for (std::int64_t g = 0; g < groups_per_row; ++g) {
      const auto first = static_cast<std::size_t>(std::max<std::int64_t>(g * group_nodes - 1, 0));
      std::u32string group;
      for (const std::u32string& row : around) group += row.substr(first, group_nodes + 1);
      if (group.find_first_not_of(group[0]) == std::string::npos) continue;
      groups.insert(static_cast<char32_t>(g) + group);
    }
  }
  // A body of a few kinds of rows repeats them; up to a dozen say nothing of how many more there are.
  const double part = 1.0 / rows_sampled, count = static_cast<double>((n[1] + 1) * (n[2] + 1));
  const double distinct_rows = rows.size() > 12 ? part * static_cast<double>(rows.size()) : 0;
  const double distinct_groups = rows.size() > 12 ? part * static_cast<double>(groups.size()) : 0;
  const double cell_bytes = scattered && grid.cell_count() > 65535 ? 4.0 * 7 : 2.0;
  const double row_bytes = cell_bytes * static_cast<double>(n[0] + 48);
  const double group_bytes = static_cast<double>((components * (components + 1) + 4) * group_nodes);
  // Coarser levels: an eighth of the nodes each, twice the part of them near an interface.
  return count * (8.0 / 7 * distinct_rows * row_bytes + 4.0 / 3 * distinct_groups * group_bytes);
}

// Cut cells with their moments (koshi/spring_lattice.h), and what the kernels of a run keep of them and the whole cells
// beside them, about three to two (mechanics/cut_forces.h); their number from a sample of rows.
double surface_bytes(const Definition& definition, const lattice::Grid& grid) {
  if (!definition.cuts()) return 0;
  constexpr int rows_sampled = 100;
  constexpr double bytes_per_cut_cell = 950;
  const auto fraction_of = fraction_of_cells(definition, grid);
  std::minstd_rand random;
  const Int3& n = grid.cells;
  std::int64_t cut = 0;
  for (int sample = 0; sample < rows_sampled; ++sample) {
    const std::int64_t j = static_cast<std::int64_t>(random()) % n[1], k = static_cast<std::int64_t>(random()) % n[2];
    for (std::int64_t i = 0; i < n[0]; ++i) {
      const float part = fraction_of({i, j, k});
      cut += part > 0 && part < 1;
    }
  }
  return bytes_per_cut_cell * static_cast<double>(cut) * static_cast<double>(n[1] * n[2]) / rows_sampled;
}

// Bytes per node of the fields of a sample: those that are computed, and the copies that go to the file.
double sample_bytes(const Definition& definition) {
  double bytes = 0;
  for (const std::string& name : definition.output.fields) {
    const bool tensor = name == "stress" || name == "strain";
    const int components = tensor ? 6 : name == "energy" ? 1 : 3;
    const bool in_state = name == "displacement" || name == "velocity" || name == "rotation";
    bytes += 8 * components * (in_state ? 1 : 2);
    if (name == "reaction") bytes += 24;  // moments, which are not written
  }
  return bytes;
}

}  // namespace

double predicted_memory(const Definition& definition, int ranks) {
  const lattice::Grid grid = make_grid(definition);
  const Int3 nodes = grid.nodes();
  const lattice::Layout whole({0, 0, 0}, nodes);
  const bool rotational = definition.lattice.kinematics == material::Kinematics::rotational;
  const bool statics = definition.analysis.type == AnalysisDefinition::Type::statics;
  const int components = rotational ? 6 : 3, inertias = rotational ? 2 : 1;
  const double count = static_cast<double>(nodes[0] * nodes[1]) * static_cast<double>(nodes[2]);

  // The cell's material, its factor and fraction, or with plain springs the bonds; inertia; displacement and velocity.
  // Explicit runs keep the inverse inertia as well.
  const bool plain = definition.lattice.springs == material::Sharing::plain;
  const bool factors = !definition.body.factors.empty() || definition.varies_in_stiffness() || definition.cuts();
  double bytes = 2 + (factors ? 4 : 0) + (definition.varies_in_strength() ? 4 : 0) + (definition.cuts() ? 4 : 0) +
                 (plain ? 17 * lattice::slot_count : 0) + 8 * inertias + 16 * components;
  const bool orients = std::count(definition.output.fields.begin(), definition.output.fields.end(), "orientation") != 0;
  const double sample = sample_bytes(definition) * count + surface_bytes(definition, grid);
  if (definition.analysis.type == AnalysisDefinition::Type::modes) {
    // Vectors, steps and search directions, each with its image, and a few more (modes/eigen_search.h); shapes come
    // when steps and directions are no longer needed, but before their memory is free.
    const int width = definition.analysis.count + std::max(2, definition.analysis.count / 5);
    const double vectors = (6.0 * width + definition.analysis.count + 6) * 8 * components * count;
    const double solver = solver_bytes(grid, components, ranks) + mixed_bytes(definition, grid, components);
    return bytes * static_cast<double>(whole.size()) + solver + vectors + sample;
  }
  // Cracks, forces of their faces and the energies of nodes; three numbers of single precision that follow from them
  // (failure/cracking.h), one of them the factor above, and nine of the cracks' planes (failure/crack_tracks.h).
  if (definition.breaks_bonds())  // of bonds: those that are broken, what they change in forces
    bytes += 8 * (crack_components + components + 2 + 2) + 8 + 2;
  else if (definition.cracks())
    bytes += 8 * (crack_components + 3 + 2) + 8 + 36 + (factors ? 0 : 4);
  if (statics) {
    // The operand and the right-hand side of many solves, beside displacements and velocities, and reactions. In steps
    // the displacements of the step before and, with the forces there, those for the work; of bonds the first of these
    // event by event too, the bonds of the step before, and factors for the levels.
    const bool steps = definition.analysis.steps.has_value();
    if (definition.cracks()) bytes += 24 * components + (steps ? 24 * components : 0);
    if (definition.breaks_bonds()) bytes += (steps ? 16 : 8 * components) + (factors ? 0 : 4);
    // The solver's memory is free again when fields are written.
    const double solver = solver_bytes(grid, components, ranks) + mixed_bytes(definition, grid, components);
    return bytes * static_cast<double>(whole.size()) + std::max(solver, sample);
  }
  bytes += 8 * inertias + (orients ? 32 : 0);
  // Boxes with ghosts and padding; and every rank keeps the materials and factors of all cells where they come from
  // files.
  const lattice::Partition partition = lattice::make_partition(grid, ranks);
  double size = 0;
  for (int rank = 0; rank < ranks; ++rank) size += static_cast<double>(partition.layout(rank).size());
  const model::BodyDefinition& body = definition.body;
  const double image =
      2.0 * static_cast<double>(body.cells.size()) +
      4.0 * static_cast<double>(body.factors.size() + body.density_shares.size() + body.strengths.size());
  return image * ranks + bytes * size + sample;
}

void check_memory(const Definition& definition, int ranks) {
  const double needed = predicted_memory(definition, ranks);
  const FreeMemory free = free_memory(ranks);
  if (needed <= free.bytes) return;
  const double spacing = definition.lattice.spacing * std::cbrt(needed / free.bytes);
  throw InputError(
      definition.places.find("lattice.spacing"),
      fmt::format("the run needs {:.3g} GB of memory and {:.3g} GB are free {}; a spacing of about {:.3g} m would fit",
                  needed / 1e9, free.bytes / 1e9, free.limit, 1.02 * spacing));
}

}  // namespace koshi::model
