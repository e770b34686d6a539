// A run's output directory as the data of a report, and the page around them.
#include "report/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "io/field_writer.h"
#include "io/files.h"
#include "io/history_writer.h"
#include "io/report_block.h"
#include "io/summary.h"
#include "koshi/input.h"
#include "report/history.h"
#include "report/mesh.h"
#include "support/report_array.h"
#include "support/temporary_directory.h"

namespace koshi::report {
namespace {

using test::decoded;

namespace fs = std::filesystem;
using json = nlohmann::ordered_json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr const char* case_text = R"(
title = "Two </script> halves"
[lattice]
spacing = 0.5
[body]
size = [1, 2, 1.5]
material = "soft, \"clay\""
[material."soft, \"clay\""]
youngs_modulus = 1e9
poissons_ratio = 0.2
density = 2000
[material.hard]
youngs_modulus = 3e9
poissons_ratio = 0.3
density = 2500
[[region]]
shape = "box"
min = [0, 1, 0]
max = [1, 2, 1.5]
material = "hard"
[[boundary]]
name = "root"
face = "y-min"
fix = ["x", "y", "z", "rx", "ry", "rz"]
[[boundary]]
name = "top"
face = "y-max"
displacement = {x = 0.01}
ramp = 0.5
[[load]]
name = "weight"
acceleration = [0, 0, -9.8]
[[load]]
name = "push"
box = {min = [0, 0, 1.5], max = [1, 1, 1.5]}
pressure = 100
history = [[0, 0], [1, 3]]
[analysis]
type = "dynamic"
duration = 1
[[probe]]
name = "tip"
face = "y-max"
quantity = "displacement"
reduce = "area-mean"
[[probe]]
name = "press"
face = "y-max"
quantity = "reaction"
)";

// Displacement of a node at a time: no two numbers alike.
double displacement(int component, const Int3& at, double time) {
  return time * (1 + component + 10.0 * static_cast<double>(at[0]) + 100.0 * static_cast<double>(at[1]) +
                 1000.0 * static_cast<double>(at[2]));
}

/// An output directory as a run leaves it.
class Results : public testing::Test {
 protected:
  Results() {
    const model::Definition definition = io::read_case_text(case_text, "case.toml");
    const Communicator world = Communicator::world();
    const model::Model model = model::make_model(definition, world);
    io::write_resolved(world, directory.path(), io::resolved_toml(definition));

    io::HistoryWriter history(world, directory.path(),
                              {"time [s]", "tip.displacement.x [m]", "press.reaction.x [N]", "elastic [J]",
                               "kinetic [J]", "unbalanced ratio"},
                              std::nullopt);
    for (int row = 0; row < 5; ++row) {
      const double t = 0.25 * row;
      history.write(std::array{t, 0.01 * t, 1e5 * t, 500 * t * t, 0.1 * t, 1.0 / (row + 1)});
    }

    io::FieldWriter fields(model, directory.path(), std::nullopt);
    lattice::Field<double> u(model.layout(), 3), stress(model.layout(), 6);
    for (const double time : {0.5, 1.0}) {
      lattice::for_each_owned(model.layout(), [&](auto i, auto j, auto k, auto n) {
        for (int c = 0; c < 3; ++c) u.component(c)[n] = displacement(c, {i, j, k}, time);
        for (int c = 0; c < 6; ++c) stress.component(c)[n] = static_cast<double>(c) + static_cast<double>(i);
      });
      fields.write(time,
                   std::array{io::FieldData{"displacement", &u, 0, 3, {"x", "y", "z"}, false},
                              io::FieldData{"stress", &stress, 0, 6, {"xx", "yy", "zz", "yz", "xz", "xy"}, true}});
    }
    summary = json::parse(R"({"probes": {"tip": {"displacement": [0.01, 0.001, 0]}, "press": {"reaction": [1e5, 0, 3]}},
                              "body": {"solid_cells": 24, "nodes": 60}, "springs": {"hard": {"edge": {"kn": 1, "kt": 2}, "face": {"kn": 3, "kt": 4},
                              "body": {"kn": 5, "kt": 6}, "kappa": 7}},
                              "analysis": {"steps": 321, "converged": true, "reason": "relative residual below the tolerance", "residual_history": [1, 0.1, 1e-9]},
                              "energy": {"elastic": 2.5}, "performance": {"seconds": 0.5, "peak_memory": 34500000}, "version": "0.1.0"})");
    io::write_summary(world, directory.path(), summary);
  }

  test::TemporaryDirectory directory;
  json summary;
};

TEST_F(Results, HeadAndTables) {
  const json data = report_data(directory.path());
  EXPECT_EQ(data.at("format"), "koshi-report/1");
  EXPECT_EQ(data.at("title"), "Two </script> halves");
  EXPECT_EQ(data.at("subtitle"),
            "Cube-III, shared springs, bending-exact calibration, rotational kinematics; dynamic analysis");
  EXPECT_EQ(data.at("summary"), summary);
  EXPECT_EQ(data.at("case"), io::read_file(directory / "resolved.toml"));
  EXPECT_EQ(data.at("facts")[0].at("value"), json({1.0, 2.0, 1.5}));
  EXPECT_EQ(data.at("facts")[3], json({{"label", "Nodes"}, {"value", 60}}));
  EXPECT_EQ(data.at("materials").at("rows"), json({{"soft, \"clay\"", 1e9, 0.2, 2000.0}, {"hard", 3e9, 0.3, 2500.0}}));

  // Bending-exact springs for nu = 0.2 (theory, section 8, rotational): c = 1/6, t = 2/9 (1 - 3 nu)/(1 - nu) = 1/9, so
  // kn of an edge is (2/3 - 2/9) mu d = 4/9 mu d and of a face diagonal (t + c) mu d = 5/18 mu d.
  const double mu_d = 1e9 / 2.4 * 0.5;
  const json& springs = data.at("springs").at("rows");
  ASSERT_EQ(springs.size(), 6U);
  EXPECT_NEAR(springs[0][2].get<double>(), 4.0 / 9 * mu_d, 1e-6 * mu_d);
  EXPECT_NEAR(springs[1][2].get<double>(), 5.0 / 18 * mu_d, 1e-6 * mu_d);
  // What the summary says goes before the calibration.
  EXPECT_EQ(springs[3], json({"hard", "edges", 1.0, 2.0, 7.0}));
  EXPECT_EQ(springs[5], json({"hard", "body diagonals", 5.0, 6.0, ""}));
  const json& achieved = data.at("achieved").at("rows");
  ASSERT_EQ(achieved.size(), 2U);
  EXPECT_NEAR(achieved[1][2].get<double>(), 3e9, 1);
  EXPECT_NEAR(achieved[1][7].get<double>(), 0.3, 1e-9);
  EXPECT_LT(achieved[1][5].get<double>(), 1e-12);

  const json& probes = data.at("probes");
  ASSERT_EQ(probes.size(), 2U);
  EXPECT_EQ(probes[0].at("title"), "Displacement");
  EXPECT_EQ(probes[0].at("rows"), json({{"tip", "y-max, area-mean", 0.01, 0.001, 0}}));
  EXPECT_EQ(probes[1].at("columns")[2], json({{"name", "x"}, {"unit", "N"}}));
  EXPECT_EQ(probes[1].at("rows"), json({{"press", "y-max, sum", 1e5, 0, 3}}));
  const json& timing = data.at("timing");
  ASSERT_EQ(timing.size(), 3U);
  EXPECT_EQ(timing[0].at("title"), "Analysis");
  EXPECT_EQ(timing[0].at("rows"), json::parse(R"([["steps", {"value": 321, "unit": "1"}], ["converged", "yes"],
      ["ended by", "relative residual below the tolerance"]])"));
  EXPECT_EQ(timing[1].at("rows"), json::parse(R"([["elastic", {"value": 2.5, "unit": "J"}]])"));
  EXPECT_EQ(timing[2].at("rows"), json::parse(R"([["wall time", {"value": 0.5, "unit": "s"}],
      ["peak memory", {"value": 34500000, "unit": "B"}]])"));
  EXPECT_EQ(data.at("conditions").at("rows"), json::parse(R"([["root", "y-min", "x, y, z, rx, ry, rz", "fixed", ""],
      ["top", "y-max", "displacement x", {"value": 0.01, "unit": "m"}, "rises from 0 within 0.5 s"],
      ["weight", "whole body", "acceleration", {"value": [0.0, 0.0, -9.8], "unit": "m/s^2"}, "constant"],
      ["push", "box (0, 0, 1.5) to (1, 1, 1.5) m", "pressure", {"value": 100.0, "unit": "Pa"},
       "times a factor given at 2 times, 3 at the end"]])"));
  EXPECT_EQ(data.at("convergence").at("residuals"), json({1, 0.1, 1e-9}));
}

TEST_F(Results, HistoryWithItsPlots) {
  const json history = report_data(directory.path()).at("history");
  const json& columns = history.at("columns");
  ASSERT_EQ(columns.size(), 7U);
  EXPECT_EQ(columns[2].at("name"), "press.reaction.x");
  EXPECT_EQ(columns[2].at("unit"), "N");
  EXPECT_THAT(decoded<double>(columns[2].at("data"), 5), ElementsAre(0, 25000, 50000, 75000, 100000));
  EXPECT_EQ(columns[5].at("unit"), "1");
  const json& plots = history.at("plots");
  ASSERT_EQ(plots.size(), 5U);
  // The press goes 0.01 m along x within 0.5 s; rows are 0.25 s apart.
  EXPECT_EQ(plots[0].at("x"), "top displacement x");
  EXPECT_EQ(columns[6].at("name"), "top displacement x");
  EXPECT_EQ(columns[6].at("unit"), "m");
  EXPECT_THAT(decoded<double>(columns[6].at("data"), 5), ElementsAre(0, 0.005, 0.01, 0.01, 0.01));
  EXPECT_EQ(plots[0].at("y"), json({"press.reaction.x"}));
  EXPECT_EQ(plots[1].at("y"), json({"elastic", "kinetic"}));
  EXPECT_EQ(plots[2].at("y"), json({"unbalanced ratio"}));
  EXPECT_EQ(plots[2].at("log"), true);
  EXPECT_EQ(plots[4].at("title"), "press");
}

TEST_F(Results, HistoryOfAPressWithAVelocityAndOfNone) {
  model::Definition definition = io::read_case(directory / "resolved.toml");
  const std::vector<io::HistoryColumn> columns{{"time", "s", {0, 1, 3}},
                                               {"tip.displacement.x", "m", {0, 0.5, 0.1}},
                                               {"press.reaction.x", "N", {0, 7, 2}},
                                               {"press.reaction.y", "N", {0, 9, 0}}};
  // 2 m/s that rise within 1 s: 1 m at the end of the first second, 5 m two seconds later.
  model::BoundaryDefinition& top = definition.boundaries[1];
  top.displacement = {}, top.velocity[0] = 2, top.ramp = 1;
  json history = history_block(columns, definition);
  EXPECT_EQ(history.at("plots")[0].at("y"), json({"press.reaction.x"}));
  EXPECT_THAT(decoded<double>(history.at("columns")[4].at("data"), 3), ElementsAre(0, 1, 5));
  // Nothing moves: what changes most, each against the other.
  top.velocity = {};
  history = history_block(columns, definition);
  EXPECT_EQ(history.at("columns").size(), 4U);
  EXPECT_EQ(history.at("plots")[0].at("x"), "tip.displacement.x");
  EXPECT_EQ(history.at("plots")[0].at("y"), json({"press.reaction.y"}));
}

TEST_F(Results, MeshCarriesEveryNodeAndSample) {
  const json mesh = report_data(directory.path()).at("mesh");
  // 2 x 4 x 3 cells: 60 nodes; 2 (2 4 + 4 3 + 3 2) = 52 quads.
  EXPECT_EQ(decoded<std::int32_t>(mesh.at("quads"), 208).size(), 4U * 52);
  const auto nodes = decoded<std::int32_t>(mesh.at("lattice").at("point_index"), 60);
  const auto cells = decoded<std::int32_t>(mesh.at("lattice").at("cell_index"), 24);
  const auto points = decoded<float>(mesh.at("points"), 180);
  ASSERT_EQ(nodes.size(), 60U);
  ASSERT_EQ(cells.size(), 24U);
  ASSERT_EQ(points.size(), 180U);
  EXPECT_FALSE(mesh.contains("note"));
  ASSERT_EQ(mesh.at("samples").size(), 2U);
  int checked = 0;
  for (const json& sample : mesh.at("samples")) {
    const double time = sample.at("time");
    const auto u = decoded<float>(sample.at("fields").at("displacement").at("data"), 180);
    const auto stress = decoded<float>(sample.at("fields").at("stress").at("data"), 144);
    const auto material = decoded<float>(sample.at("fields").at("material").at("data"), 24);
    ASSERT_EQ(u.size(), 180U);
    ASSERT_EQ(stress.size(), 6U * 24);
    for (std::size_t p = 0; p < 60; ++p) {
      const Int3 at{nodes[p] % 3, nodes[p] / 3 % 5, nodes[p] / 15};
      for (std::size_t c = 0; c < 3; ++c, ++checked) {
        EXPECT_EQ(points[3 * p + c], 0.5F * static_cast<float>(at[c]));
        EXPECT_EQ(u[3 * p + c], static_cast<float>(displacement(static_cast<int>(c), at, time)));
      }
    }
    for (std::size_t q = 0; q < 24; ++q) {
      EXPECT_EQ(stress[6 * q + 4], 4.0F + static_cast<float>(cells[q] % 2));
      EXPECT_EQ(material[q], cells[q] / 2 % 4 < 2 ? 1.0F : 2.0F);
    }
  }
  EXPECT_EQ(checked, 2 * 180);
  const json& fields = mesh.at("samples")[0].at("fields");
  EXPECT_EQ(fields.at("displacement").at("kind"), "vector");
  EXPECT_EQ(fields.at("stress").at("kind"), "symmetric-tensor");
  EXPECT_EQ(fields.at("stress").at("on"), "cells");
  EXPECT_EQ(fields.at("stress").at("unit"), "Pa");
  EXPECT_EQ(fields.at("material").at("categories"), json({{"1", "soft, \"clay\""}, {"2", "hard"}}));
}

TEST_F(Results, LargeBodiesAreThinnedWithANote) {
  const std::vector<ReportSample> samples{{directory / "fields/sample_000000.vti", 0.5, ""},
                                          {directory / "fields/sample_000001.vti", 1, "loaded"},
                                          {directory / "fields/sample_000001.vti", 2, ""}};
  const std::vector<std::string> materials{"soft", "hard"};
  const json mesh = mesh_block(samples, materials, nullptr, {30, 1e9, 1e9});
  EXPECT_THAT(mesh.at("note"), HasSubstr("The surface has 54 points; it is thinned to "));
  EXPECT_FALSE(mesh.contains("lattice"));
  // Blocks of 2 x 2 x 2 cells: 1 x 2 x 2 of them, 18 corners, all on the surface.
  EXPECT_THAT(mesh.at("note"), HasSubstr("thinned to 18, one for each block of 2 cells"));
  EXPECT_EQ(decoded<float>(mesh.at("points"), 54).size(), 54U);
  EXPECT_EQ(mesh.at("samples")[1].at("label"), "loaded");

  // Values of 54 surface points and 24 cells: (3 x 54 + 6 x 24) x 4 bytes a sample; two of three samples fit.
  const json fewer = mesh_block(samples, materials, nullptr, {1000, 0, 2.5 * 4 * (3 * 54 + 6 * 24)});
  EXPECT_EQ(fewer.at("note"),
            "The inside is too large for this page: a cut shows the body hollow. 2 of 3 samples are shown.");
  ASSERT_EQ(fewer.at("samples").size(), 2U);
  EXPECT_EQ(fewer.at("samples")[0].at("time"), 0.5);
  EXPECT_EQ(fewer.at("samples")[1].at("time"), 2);
}

TEST_F(Results, SurfaceOfCutCellsWithoutItsFileIsThatOfTheCells) {
  std::string text = case_text;
  text.replace(text.find("[material."), 0, "surface = \"cut\"\n");
  const std::size_t shape = text.find("shape = \"box\""), material = text.find("material = \"hard\"");
  text.replace(shape, material - shape, "shape = \"stl\"\nfile = \"lost.stl\"\n");
  io::replace_file(directory / "resolved.toml", text);
  const json mesh = report_data(directory.path()).at("mesh");
  EXPECT_FALSE(mesh.contains("true_surface"));
  EXPECT_THAT(mesh.at("note"), HasSubstr("The surface is that of the cells, because the file "));
  EXPECT_THAT(mesh.at("note"), HasSubstr("lost.stl"));
}

TEST_F(Results, SurfaceOfCutCellsHasValuesOfItsOwn) {
  // The upper part of the body ends at y = 1.7, between the nodes at 1.5 and 2: 4/10 of the way.
  std::string text = case_text;
  text.replace(text.find("[material."), 0, "surface = \"cut\"\n");
  const std::string end =
      "[[region]]\nshape = \"half-space\"\npoint = [0, 1.7, 0]\nnormal = [0, -1, 0]\nmaterial = \"void\"\n";
  text.replace(text.find("[[boundary]]"), 0, end);
  io::replace_file(directory / "resolved.toml", text);
  const json mesh = report_data(directory.path()).at("mesh");
  // The 3 x 4 nodes at y = 2 move.
  const auto at = decoded<float>(mesh.at("true_surface").at("at"), 36);
  const auto points = decoded<std::int32_t>(mesh.at("true_surface").at("point"), 12);
  const auto nodes = decoded<std::int32_t>(mesh.at("lattice").at("point_index"), 60);
  ASSERT_EQ(at.size(), 36U);
  int checked = 0;
  for (const json& sample : mesh.at("samples")) {
    const auto u = decoded<float>(sample.at("fields").at("displacement").at("on_true_surface"), 36);
    ASSERT_EQ(u.size(), 36U);
    EXPECT_FALSE(sample.at("fields").at("stress").contains("on_true_surface"));
    for (std::size_t p = 0; p < 12; ++p) {
      const std::int32_t node = nodes[static_cast<std::size_t>(points[p])];
      const Int3 upper{node % 3, node / 3 % 5, node / 15}, lower{upper[0], 3, upper[2]};
      EXPECT_EQ(upper[1], 4);
      EXPECT_NEAR(at[3 * p + 1], 1.7, 1e-6);
      for (int c = 0; c < 3; ++c, ++checked) {
        const double below = displacement(c, lower, sample.at("time")),
                     above = displacement(c, upper, sample.at("time"));
        EXPECT_NEAR(u[3 * p + static_cast<std::size_t>(c)], 0.6 * below + 0.4 * above,
                    1e-6 * (std::abs(below) + std::abs(above)));
      }
    }
  }
  EXPECT_EQ(checked, 2 * 36);
}

TEST_F(Results, PageHoldsTheDataOnce) {
  io::replace_file(directory / "template.html",
                   "<p>a</p><script type=\"application/json\" id=\"koshi-data\"></script><p>b</p>");
  ASSERT_EQ(::setenv("KOSHI_REPORT_TEMPLATE", (directory / "template.html").c_str(), 1), 0);
  write_report(directory.path());
  const std::string page = io::read_file(directory / "report.html");
  const std::string start = "<p>a</p><script type=\"application/json\" id=\"koshi-data\">", end = "</script><p>b</p>";
  ASSERT_TRUE(page.starts_with(start));
  ASSERT_TRUE(page.ends_with(end));
  const std::string block = page.substr(start.size(), page.size() - start.size() - end.size());
  EXPECT_EQ(block.find('<'), std::string::npos);
  EXPECT_EQ(json::parse(block), report_data(directory.path()));
  EXPECT_FALSE(fs::exists(directory / "report.html.part"));

  io::replace_file(directory / "template.html", "<p>another page</p>");
  EXPECT_THAT([&] { write_report(directory.path()); }, ThrowsMessage<RunError>(HasSubstr("lacks its data block")));
  EXPECT_EQ(io::read_file(directory / "report.html"), page);
  ::unsetenv("KOSHI_REPORT_TEMPLATE");
}

TEST_F(Results, PartsThatAreMissingAreLeftOut) {
  fs::remove(directory / "summary.json");
  fs::remove(directory / "history.csv");
  fs::remove(directory / "fields.pvd");
  const json data = report_data(directory.path());
  for (const char* part : {"history", "mesh", "convergence"}) EXPECT_FALSE(data.contains(part)) << part;
  EXPECT_TRUE(data.at("probes").empty());
  EXPECT_EQ(data.at("springs").at("rows").size(), 6U);
  fs::remove(directory / "resolved.toml");
  EXPECT_THAT([&] { report_data(directory.path()); }, ThrowsMessage<InputError>(HasSubstr("resolved.toml is missing")));
}

TEST_F(Results, BrokenFilesAreNamed) {
  const auto message = [&] {
    try {
      report_data(directory.path());
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  const std::string sample = io::read_file(directory / "fields/sample_000001.vti");
  io::replace_file(directory / "fields/sample_000001.vti", sample.substr(0, sample.size() / 3));
  EXPECT_THAT(message(), HasSubstr("sample_000001.vti is no sample of fields"));
  io::replace_file(directory / "fields.pvd", "not xml");
  EXPECT_THAT(message(), HasSubstr("fields.pvd is no collection"));
  io::replace_file(directory / "history.csv", "time [s],\"a, \"\"b\"\" [m]\"\n1,2\n3,x\n");
  EXPECT_THAT(message(), HasSubstr("history.csv:3:"));
  io::replace_file(directory / "summary.json", "[1, 2");
  EXPECT_THAT(message(), HasSubstr("summary.json is no summary"));
}

}  // namespace
}  // namespace koshi::report
