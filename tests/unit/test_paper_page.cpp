// The paper's page, from the study's own cases cut short; what it writes is then looked at in a browser
// (report/tests/paper.test.mjs).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "driver/run_simulation.h"
#include "io/files.h"
#include "study/paper.h"
#include "study/tables.h"
#include "support/temporary_directory.h"

namespace koshi::study {
namespace {

using driver::Outcome;
using driver::RunOptions;
using driver::Simulation;
using json = nlohmann::ordered_json;
using lattice::CellType;
using testing::HasSubstr;

constexpr int nodes_on_line = 40;

// Runs the case for a few steps; the deflections are those of the line's probes.
PaperRun cut_short(model::Definition definition, const std::string& lattice, const std::filesystem::path& directory,
                   PaperCurve* curve = nullptr) {
  definition.analysis.type = model::AnalysisDefinition::Type::dynamic;
  definition.analysis.duration = 1e-4;
  Simulation simulation(definition, Communicator::world());
  RunOptions options;
  options.directory = directory;
  options.quiet = true;
  const Outcome outcome = run_simulation(simulation, options);
  if (curve) {
    curve->name = lattice;
    for (std::size_t p = 1; p < outcome.measurement.probes.size(); ++p)
      curve->deflection.push_back(outcome.measurement.probes[p][0]);
  }
  return {lattice, directory};
}

TEST(PaperPage, HoldsTablesFiguresAndBodiesOfAllLattices) {
  const test::TemporaryDirectory directory;
  PaperStudy study;
  const std::vector<std::pair<CellType, std::string>> cells{
      {CellType::cube_i, "Cube-I"}, {CellType::cube_ii, "Cube-II"}, {CellType::cube_iii, "Cube-III"}};
  for (const auto& [cell, name] : cells) {
    study.springs.push_back({"k_n", name, 1.34, 1.34, 1.3403, 0.0005});
    study.uniaxial.push_back({"ν/ν_0", name, 0, 0, -1e-9, 0.002});
    study.cantilever.push_back({"u_x", name, 0.0159, 0.01597, 0.0162, 0.00002});
    study.uniaxial_runs.push_back(cut_short(uniaxial_case(cell), name, directory / ("uniaxial-" + name)));
    study.cantilever_runs.push_back(
        cut_short(cantilever_case(cell, false), name, directory / name, &study.curves.emplace_back()));
  }
  study.cantilever_runs.push_back(cut_short(cantilever_case(CellType::cube_iii, true), "exact springs",
                                            directory / "exact", &study.curves.emplace_back()));
  study.curves.push_back({"Euler–Bernoulli", std::vector<double>(nodes_on_line, 1e-4)});

  const json page = paper_page(study);
  // Each lattice's values beside the paper's, difference and per cent: 0.0162 is 1.89 % above 0.0159 and out of bounds.
  ASSERT_EQ(page.at("tables").size(), 3U);
  const json& row = page.at("tables")[2].at("rows")[1];
  EXPECT_EQ(row[1], "Cube-II");
  EXPECT_NEAR(row[5].get<double>(), 0.0003, 1e-12);
  EXPECT_NEAR(row[6].get<double>(), 100 * 0.0003 / 0.0159, 1e-9);
  EXPECT_EQ(row[7], "no");
  EXPECT_TRUE(page.at("tables")[1].at("rows")[0][6].is_null());
  EXPECT_THAT(page.at("tables")[2].at("note"), HasSubstr("reading that comes closest, within 0.5 %"));

  // Fig. 6: three components for each lattice of the paper; the exact springs are a fourth body to look at.
  ASSERT_EQ(page.at("figures").size(), 3U);
  ASSERT_EQ(page.at("mesh").at("samples").size(), 4U);
  for (std::size_t f = 0; f < 3; ++f) {
    EXPECT_THAT(page.at("figures")[f].at("title"), HasSubstr(cells[f].second + ":"));
    ASSERT_EQ(page.at("figures")[f].at("panels").size(), 3U);
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_EQ(page.at("figures")[f].at("panels")[c].at("sample"), f);
      EXPECT_EQ(page.at("figures")[f].at("panels")[c].at("component"), std::string(1, "xyz"[c]));
    }
    EXPECT_EQ(page.at("mesh").at("samples")[f].at("label"), cells[f].second);
  }

  // Fig. 7: y = 0 ... 7.8 cm; three lattices, the exact springs and the theory.
  const json& fig7 = page.at("curves")[0].at("series");
  ASSERT_EQ(fig7.size(), 5U);
  for (const json& curve : fig7) {
    ASSERT_EQ(curve.at("x").size(), nodes_on_line);
    EXPECT_NEAR(curve.at("x").back().get<double>(), 7.8, 1e-12);
  }
  EXPECT_EQ(fig7[1].at("y").back(), 100 * study.curves[1].deflection.back());
  EXPECT_GT(study.curves[1].deflection.back(), 0);
  EXPECT_EQ(fig7[4].at("style"), "dashed");
  EXPECT_EQ(page.at("timing")[0].at("rows").size(), 7U);
  EXPECT_FALSE(page.contains("probes"));

  io::replace_file(PAPER_PAGE, page.dump());
}

}  // namespace
}  // namespace koshi::study
