#include "driver/paper_report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/log.h"
#include "driver/report.h"
#include "io/files.h"
#include "koshi/error.h"

namespace koshi::driver {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* reading =
    "The paper does not say how it loads the cantilever's end nor which entries of C it uses there. Here the load is "
    "spread evenly over the 100 nodes of the end face, and C's axis 1 lies along the beam, with C1111 - C1122 "
    "(Cube-I), "
    "C1122 and C1212 (Cube-II), C1122 and C1111 (Cube-III): the reading that comes closest, within 0.5 %. In the "
    "uniaxial test one platen holds the rotations, the other leaves them free. \"Static limit\" is the same lattice at "
    "rest, from an independent program.";

/// A table of the study and how its numbers are shown.
struct Section {
  const char* title;
  const std::vector<PaperRow>& rows;
  int digits;
};

std::vector<Section> sections(const PaperStudy& study) {
  return {{"Table 1: springs [MN/m]", study.springs, 4},
          {"Table 1: uniaxial compression, u/h0 = 0.02", study.uniaxial, 4},
          {"Cantilever, end deflection u_x [cm] (Euler-Bernoulli 0.01594)", study.cantilever, 5}};
}

// Adding zero turns -0 into 0.
std::string number(double x, int digits) {
  const double scale = std::pow(10.0, digits);
  return fmt::format("{:.{}f}", std::round(x * scale) / scale + 0.0, digits);
}

std::string markdown(const Section& section) {
  std::string out = fmt::format(
      "## {}\n\n| | paper | static limit | Koshi | Koshi - paper | within tolerance |\n|---|---|---|---|---|---|\n",
      section.title);
  for (const PaperRow& row : section.rows)
    out += fmt::format("| {} | {} | {} | {} | {} | {} |\n", row.name, number(row.paper, section.digits),
                       number(row.limit, section.digits), number(row.value, section.digits),
                       number(row.value - row.paper, section.digits), row.holds() ? "yes" : "NO");
  return out + "\n";
}

Json json_rows(const std::vector<PaperRow>& rows) {
  Json all = Json::array();
  for (const PaperRow& row : rows)
    all.push_back({{"name", row.name},
                   {"paper", row.paper},
                   {"static_limit", row.limit},
                   {"koshi", row.value},
                   {"tolerance", row.tolerance},
                   {"holds", row.holds()}});
  return all;
}

double position(std::size_t j) { return 0.002 * static_cast<double>(j); }

std::string curves_csv(const PaperStudy& study) {
  std::string out = "y [cm]";
  for (const PaperCurve& curve : study.curves) out += fmt::format(",{} [cm]", curve.name);
  out += '\n';
  for (std::size_t j = 0; j < study.curves[0].deflection.size(); ++j) {
    out += fmt::format("{:.1f}", 100 * position(j));
    for (const PaperCurve& curve : study.curves) out += fmt::format(",{:.9g}", 100 * curve.deflection[j]);
    out += '\n';
  }
  return out;
}

// The page: that of the cantilever's run, with the study's tables, Fig. 6 and Fig. 7.
Json page(const PaperStudy& study, const std::filesystem::path& cantilever) {
  Json data = report_data(cantilever);
  data["title"] = "Nishimura et al. with Koshi";
  data["subtitle"] =
      "Uniaxial compression and cantilever with Cube-I, -II and -III; the body shown is the Cube-II cantilever";
  data["tables"] = Json::array();
  for (const Section& section : sections(study)) {
    Json rows = Json::array();
    for (const PaperRow& row : section.rows)
      rows.push_back({row.name, number(row.paper, section.digits), number(row.limit, section.digits),
                      number(row.value, section.digits), row.holds() ? "yes" : "no"});
    data["tables"].push_back({{"title", section.title},
                              {"columns",
                               {{{"name", ""}},
                                {{"name", "paper"}},
                                {{"name", "static limit"}},
                                {{"name", "Koshi"}},
                                {{"name", "within tolerance"}}}},
                              {"rows", rows}});
  }
  data["tables"].back()["note"] = reading;

  Json series = Json::array();
  for (const PaperCurve& curve : study.curves) {
    Json y = Json::array();
    for (std::size_t j = 0; j < curve.deflection.size(); ++j) y.push_back(position(j));
    series.push_back({{"name", curve.name},
                      {"x", y},
                      {"y", curve.deflection},
                      {"style", &curve == &study.curves.back() ? "dashed" : "line"}});
  }
  data["curves"] = {{{"title", "Fig. 7: deflection along x = 0.8 cm, z = 1.0 cm"},
                     {"x", {{"label", "y"}, {"unit", "m"}}},
                     {"y", {{"label", "u_x"}, {"unit", "m"}}},
                     {"series", series}}};
  Json panels = Json::array();
  for (const char* component : {"x", "y", "z"})
    panels.push_back(
        {{"field", "displacement"}, {"component", component}, {"caption", fmt::format("u_{}", component)}});
  data["figures"] = {{{"title", "Fig. 6: displacements on the deformed bar"}, {"panels", panels}}};
  return data;
}

}  // namespace

bool PaperRow::holds() const { return std::abs(value - limit) <= tolerance; }

std::string paper_markdown(const PaperStudy& study) {
  std::string out = "# Nishimura et al. with Koshi\n\n";
  for (const Section& section : sections(study)) out += markdown(section);
  return out + reading + "\n";
}

void write_paper(const PaperStudy& study, const std::filesystem::path& directory,
                 const std::filesystem::path& cantilever) {
  const Json json{{"version", KOSHI_VERSION},
                  {"springs", json_rows(study.springs)},
                  {"uniaxial", json_rows(study.uniaxial)},
                  {"cantilever", json_rows(study.cantilever)}};
  io::replace_file(directory / "paper.md", paper_markdown(study));
  io::replace_file(directory / "paper.json", json.dump(2) + "\n");
  io::replace_file(directory / "fig7.csv", curves_csv(study));
  // The numbers stand without the page, whose template is only there when it was built.
  try {
    write_report_page(directory / "report.html", page(study, cantilever));
  } catch (const RunError& error) {
    log_warning(error.what());
  }
}

}  // namespace koshi::driver
