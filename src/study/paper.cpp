#include "study/paper.h"

#include <fmt/format.h>

#include <array>

#include "driver/run_simulation.h"
#include "io/output_directory.h"
#include "study/tables.h"

namespace koshi::study {
namespace {

using lattice::CellType;

constexpr std::array<CellType, 3> cells{CellType::cube_i, CellType::cube_ii, CellType::cube_iii};

// The paper's Table 1 and Fig. 7, and the static limits of the same lattices, found with an independent program; a run
// must come within the tolerance of the latter.
struct Expected {
  double paper, limit;
};
constexpr std::array<Expected, 3> youngs_ratio{{{0.942, 0.9416}, {1.151, 1.1517}, {1.030, 1.0301}}};
constexpr std::array<Expected, 3> poisson_ratio{{{0, 0}, {1.067, 1.0671}, {1.089, 1.0895}}};
constexpr std::array<Expected, 3> tip{{{0.0159, 0.01597}, {0.0140, 0.01402}, {0.0151, 0.01503}}};  // [cm]
constexpr double ratio_tolerance = 0.002;
constexpr double tip_tolerance = 0.00002;  // [cm]

constexpr double E = 1112e6, nu = 0.18;

std::string text(CellType cell) { return std::string(lattice::name(cell)); }

// "Cube-II", as the paper writes it.
std::string title(CellType cell) {
  std::string name = text(cell);
  name[0] = 'C';
  return name;
}

driver::Outcome analyse(const model::Definition& definition, const std::filesystem::path& directory, bool quiet,
                        const Communicator& communicator, material::Springs* springs = nullptr) {
  driver::Simulation simulation(definition, communicator);
  if (springs) *springs = simulation.model().lattice.springs[1];
  driver::RunOptions options;
  options.directory = directory;
  options.quiet = quiet;
  return driver::run_simulation(simulation, options);
}

void add_uniaxial(std::size_t c, const std::filesystem::path& directory, bool quiet, const Communicator& communicator,
                  PaperStudy& study) {
  material::Springs springs;
  const model::Definition definition = uniaxial_case(cells[c]);
  const PaperRun run{title(cells[c]), directory / ("uniaxial-" + text(cells[c]))};
  const driver::Outcome outcome = analyse(definition, run.directory, quiet, communicator, &springs);
  study.uniaxial_runs.push_back(run);
  // Table 1 prints the springs to three decimals of MN/m.
  constexpr std::array<std::array<double, 2>, 3> table{{{1.340, 1.340}, {0.605, 0.134}, {0.345, 0.129}}};
  study.springs.push_back({"k_n", run.lattice, table[c][0], table[c][0], 1e-6 * springs.kn[0], 0.0005});
  study.springs.push_back({"k_t", run.lattice, table[c][1], table[c][1], 1e-6 * springs.kt[0], 0.0005});

  // E from the top reaction on the section of 0.64 cm^2, nu from the distance of the mid-points of two sides.
  const auto& probes = outcome.measurement.probes;
  const double strain = 0.02;
  const double youngs = -probes[0][2] / (definition.body.size[0] * definition.body.size[1]) / strain;
  const double poisson = (probes[2][0] - probes[1][0]) / definition.body.size[0] / strain;
  study.uniaxial.push_back(
      {"E/E_0", run.lattice, youngs_ratio[c].paper, youngs_ratio[c].limit, youngs / E, ratio_tolerance});
  study.uniaxial.push_back(
      {"ν/ν_0", run.lattice, poisson_ratio[c].paper, poisson_ratio[c].limit, poisson / nu, ratio_tolerance});
}

void add_cantilever(CellType cell, bool exact, const std::filesystem::path& directory, bool quiet,
                    const Communicator& communicator, PaperStudy& study) {
  const PaperRun run{exact ? "exact springs" : title(cell),
                     directory / ("cantilever-" + (exact ? "exact" : text(cell)))};
  const driver::Outcome outcome = analyse(cantilever_case(cell, exact), run.directory, quiet, communicator);
  study.cantilever_runs.push_back(run);
  const auto& probes = outcome.measurement.probes;
  if (!exact)
    study.cantilever.push_back({"u_x", run.lattice, tip[static_cast<std::size_t>(cell)].paper,
                                tip[static_cast<std::size_t>(cell)].limit, 100 * probes[0][0], tip_tolerance});
  PaperCurve curve{run.lattice, {}};
  for (std::size_t p = 1; p < probes.size(); ++p) curve.deflection.push_back(probes[p][0]);
  study.curves.push_back(curve);
}

// Deflection of a clamped beam under a force at its end (Euler-Bernoulli): P y^2 (3 L - y) / (6 E I).
PaperCurve theory() {
  PaperCurve curve{"Euler–Bernoulli", {}};
  const double P = 9.8, L = 0.078, side = 0.018, I = side * side * side * side / 12;
  for (int j = 0; j <= 39; ++j) {
    const double y = 0.002 * j;
    curve.deflection.push_back(P * y * y * (3 * L - y) / (6 * E * I));
  }
  return curve;
}

}  // namespace

void run_paper(const std::filesystem::path& directory, bool quiet, const Communicator& communicator) {
  const io::OutputDirectory held(communicator, directory);
  PaperStudy study;
  for (std::size_t c = 0; c < cells.size(); ++c) add_uniaxial(c, directory, quiet, communicator, study);
  for (const CellType cell : cells) add_cantilever(cell, false, directory, quiet, communicator, study);
  add_cantilever(CellType::cube_iii, true, directory, quiet, communicator, study);
  study.curves.push_back(theory());

  if (communicator.is_root()) {
    write_paper(study, directory);
    fmt::print("{}\ntables, curves, fields and report.html in {}\n", paper_markdown(study), directory.string());
  }
  std::string wrong;
  for (const auto* rows : {&study.springs, &study.uniaxial, &study.cantilever})
    for (const PaperRow& row : *rows)
      if (!row.holds())
        wrong += fmt::format("\n  {} {} = {:.6g}, expected {:.6g} +- {:.2g}", row.lattice, row.quantity, row.value,
                             row.limit, row.tolerance);
  if (!wrong.empty()) throw RunError("values out of tolerance:" + wrong);
}

}  // namespace koshi::study
