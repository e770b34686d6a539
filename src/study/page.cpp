#include <fmt/format.h>

#include "io/field_reader.h"
#include "io/files.h"
#include "io/history_reader.h"
#include "koshi/error.h"
#include "koshi/input.h"
#include "report/mesh.h"
#include "report/tables.h"
#include "study/paper.h"
#include "study/tables.h"

namespace koshi::study {
namespace {

using Json = nlohmann::ordered_json;

Json summary_of(const PaperRun& run) { return Json::parse(io::read_file(run.directory / "summary.json")); }

std::vector<double> column(const PaperRun& run, const std::string& name) {
  for (io::HistoryColumn& column : io::read_history(run.directory / "history.csv"))
    if (column.name == name) return std::move(column.values);
  throw RunError(fmt::format("{} has no column \"{}\"", (run.directory / "history.csv").native(), name));
}

std::vector<double> times(double factor, std::vector<double> values) {
  for (double& value : values) value *= factor;
  return values;
}

// One curve of a plot.
Json series(const std::string& name, const std::vector<double>& x, const std::vector<double>& y,
            const char* style = "line") {
  return {{"name", name}, {"x", x}, {"y", y}, {"style", style}};
}

// Table 1 and the cantilever, a row for each value.
Json tables(const PaperStudy& study) {
  Json all = Json::array();
  for (const PaperSection& section : paper_sections(study)) {
    Json columns = Json::array({{{"name", "quantity"}}, {{"name", "lattice"}}});
    columns.push_back({{"name", "paper"}, {"decimals", section.decimals}});
    for (const char* name : {"expected", "Koshi", "Koshi – paper"})
      columns.push_back({{"name", name}, {"decimals", section.decimals + 1}});
    columns.push_back({{"name", "deviation [%]"}, {"decimals", 2}});
    columns.push_back({{"name", "within tolerance"}});
    Json rows = Json::array();
    for (const PaperRow& row : *section.rows) {
      const double difference = row.value - row.paper;
      rows.push_back({row.quantity, row.lattice, row.paper, row.limit, row.value, difference,
                      row.paper != 0 ? Json(100 * difference / row.paper) : Json(), row.holds() ? "yes" : "no"});
    }
    all.push_back({{"title", section.title}, {"columns", columns}, {"rows", rows}, {"note", section.note}});
  }
  return all;
}

// Fig. 6, for each lattice of the paper. The samples of the mesh are the beams in the order of the runs.
Json figure_6(const PaperStudy& study) {
  Json figures = Json::array();
  for (std::size_t run = 0; run < study.cantilever_runs.size() - 1; ++run) {
    Json panels = Json::array();
    for (const char* panel : {"(a) u_x", "(b) u_y", "(c) u_z"})
      panels.push_back(
          {{"field", "displacement"}, {"component", std::string(1, panel[6])}, {"sample", run}, {"caption", panel}});
    figures.push_back(
        {{"title", fmt::format("Fig. 6, {}: displacements on the deformed bar", study.cantilever_runs[run].lattice)},
         {"panels", panels}});
  }
  figures[0]["note"] = "No bond of Cube-I couples the directions: u_z is zero but for rounding.";
  figures.back()["note"] = "The paper does not say which lattice it draws. The colours mean the same for all three.";
  return figures;
}

Json figure_7(const PaperStudy& study) {
  Json all = Json::array();
  std::vector<double> y;
  for (std::size_t j = 0; j < study.curves[0].deflection.size(); ++j) y.push_back(0.2 * static_cast<double>(j));
  for (const PaperCurve& curve : study.curves)
    all.push_back(
        series(curve.name, y, times(100, curve.deflection), &curve == &study.curves.back() ? "dashed" : "line"));
  return {{"title", "Fig. 7: deflection u_x along the line x = 0.8 cm, z = 1.0 cm"},
          {"x", {{"label", "y"}, {"unit", "cm"}}},
          {"y", {{"label", "u_x"}, {"unit", "cm"}}},
          {"series", all},
          {"note",
           "Exact springs: shared, bending-exact, Cube-III, the load by area; converged three-dimensional "
           "elasticity gives 0.016447 cm for the end face's mean."}};
}

// How the six analyses went: press curve of the compression, settling of the beam.
Json compression(const PaperStudy& study) {
  const model::Definition definition = uniaxial_case(lattice::CellType::cube_i);
  const double height = definition.body.size[2], area = definition.body.size[0] * definition.body.size[1];
  const double speed = -*definition.boundaries[1].velocity[2];
  Json all = Json::array();
  std::vector<double> strain;
  for (const PaperRun& run : study.uniaxial_runs) {
    strain = times(100 * speed / height, column(run, "time"));
    all.push_back(series(run.lattice, strain, times(-1 / area, column(run, "top force.reaction.z"))));
  }
  all.push_back(series("E_0 times strain", strain, times(definition.materials[0].elastic.youngs_modulus / 100, strain),
                       "dashed"));
  return {{"title", "Uniaxial compression: stress on the platen"},
          {"x", {{"label", "strain u/h_0"}, {"unit", "%"}}},
          {"y", {{"label", "stress"}, {"unit", "Pa"}}},
          {"series", all}};
}

Json settling(const PaperStudy& study) {
  Json all = Json::array();
  for (const PaperRun& run : study.cantilever_runs)
    all.push_back(series(run.lattice, column(run, "time"), times(100, column(run, "tip.displacement.x"))));
  return {{"title", "Cantilever: the damped beam comes to rest"},
          {"x", {{"label", "time"}, {"unit", "s"}}},
          {"y", {{"label", "u_x at the end"}, {"unit", "cm"}}},
          {"series", all}};
}

Json beams(const PaperStudy& study) {
  std::vector<report::ReportSample> samples;
  for (const PaperRun& run : study.cantilever_runs)
    samples.push_back({io::list_samples(run.directory).back().path, 0, run.lattice});
  return report::mesh_block(samples, {});
}

Json beam_springs(const PaperStudy& study) {
  Json block;
  for (const PaperRun& run : study.cantilever_runs) {
    const Json springs = report::spring_tables(io::read_case(run.directory / "resolved.toml"), summary_of(run)).springs;
    if (block.is_null()) block = {{"columns", springs["columns"]}, {"rows", Json::array()}};
    for (Json row : springs["rows"]) {
      row[0] = run.lattice;
      block["rows"].push_back(std::move(row));
    }
  }
  block["columns"][0]["name"] = "cantilever";
  return block;
}

Json run_table(const PaperStudy& study) {
  Json rows = Json::array();
  const auto append = [&](const char* analysis, const std::vector<PaperRun>& runs) {
    for (const PaperRun& run : runs) {
      const Json summary = summary_of(run);
      rows.push_back({analysis, run.lattice, summary["body"]["nodes"], summary["analysis"]["steps"],
                      summary["analysis"]["time_step"], summary["performance"]["seconds"],
                      run.directory.filename().native()});
    }
  };
  append("uniaxial compression", study.uniaxial_runs);
  append("cantilever", study.cantilever_runs);
  return {{"columns",
           {{{"name", "analysis"}},
            {{"name", "lattice"}},
            {{"name", "nodes"}},
            {{"name", "steps"}},
            {{"name", "time step"}, {"unit", "s"}},
            {{"name", "wall time [s]"}, {"decimals", 2}},
            {{"name", "results in"}}}},
          {"rows", rows},
          {"note", "koshi report DIR makes the page of one analysis."}};
}

Json facts() {
  return Json::parse(R"([{"label": "Young's modulus E₀", "value": 1.112e9, "unit": "Pa"},
    {"label": "Poisson's ratio ν₀", "value": 0.18}, {"label": "Spacing d", "value": 0.2, "unit": "cm"},
    {"label": "Compressed block", "value": [0.8, 0.8, 1.6], "unit": "cm"},
    {"label": "Cantilever", "value": [1.8, 7.8, 1.8], "unit": "cm"}])");
}

}  // namespace

nlohmann::ordered_json paper_page(const PaperStudy& study) {
  return {{"format", "koshi-report/1"},
          {"version", KOSHI_VERSION},
          {"title", "Nishimura et al. with Koshi"},
          {"subtitle",
           "Spring stiffness formulation of distinct element-based method for modeling of elastic continua: "
           "its two analyses, stepped in time"},
          {"facts", facts()},
          {"tables", tables(study)},
          {"figures", figure_6(study)},
          {"curves", {figure_7(study), compression(study), settling(study)}},
          {"mesh", beams(study)},
          {"springs", beam_springs(study)},
          {"timing", Json::array({run_table(study)})}};
}

}  // namespace koshi::study
