#include "study/tables.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/log.h"
#include "io/files.h"
#include "koshi/error.h"
#include "report/report.h"

namespace koshi::study {
namespace {

using Json = nlohmann::ordered_json;

// Adding zero turns -0 into 0.
std::string number(double x, int digits) {
  const double scale = std::pow(10.0, digits);
  return fmt::format("{:.{}f}", std::round(x * scale) / scale + 0.0, digits);
}

std::string markdown(const PaperSection& section) {
  std::string out = fmt::format(
      "## {}\n\n| | | paper | expected | Koshi | Koshi - paper | within tolerance "
      "|\n|---|---|---|---|---|---|---|\n",
      section.title);
  for (const PaperRow& row : *section.rows)
    out += fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", row.quantity, row.lattice,
                       number(row.paper, section.decimals), number(row.limit, section.decimals + 1),
                       number(row.value, section.decimals + 1), number(row.value - row.paper, section.decimals + 1),
                       row.holds() ? "yes" : "NO");
  return fmt::format("{}\n{}\n\n", out, section.note);
}

Json json_rows(const std::vector<PaperRow>& rows) {
  Json all = Json::array();
  for (const PaperRow& row : rows)
    all.push_back({{"quantity", row.quantity},
                   {"lattice", row.lattice},
                   {"paper", row.paper},
                   {"static_limit", row.limit},
                   {"koshi", row.value},
                   {"tolerance", row.tolerance},
                   {"holds", row.holds()}});
  return all;
}

std::string curves_csv(const PaperStudy& study) {
  std::string out = "y [cm]";
  for (const PaperCurve& curve : study.curves) out += fmt::format(",{} [cm]", curve.name);
  out += '\n';
  for (std::size_t j = 0; j < study.curves[0].deflection.size(); ++j) {
    out += fmt::format("{:.1f}", 0.2 * static_cast<double>(j));
    for (const PaperCurve& curve : study.curves) out += fmt::format(",{:.9g}", 100 * curve.deflection[j]);
    out += '\n';
  }
  return out;
}

}  // namespace

bool PaperRow::holds() const { return std::abs(value - limit) <= tolerance; }

std::vector<PaperSection> paper_sections(const PaperStudy& study) {
  const std::string limit = "Expected is what the same lattice gives at rest, by an independent program.";
  return {{"Table 1: spring stiffnesses [MN/m]", &study.springs, 3, "By (N21) from E = 1112 MPa and ν = 0.18."},
          {"Table 1: uniaxial compression, u/h_0 = 0.02", &study.uniaxial, 3,
           "The paper's values come out when one platen holds the rotations and the other leaves them free; the paper "
           "does not say so. " +
               limit},
          {"Cantilever: end deflection u_x [cm]", &study.cantilever, 4,
           "Euler-Bernoulli 0.01594 cm. The paper does not say how it loads the end nor which entries of C it uses "
           "here. This is the reading that comes closest, within 0.5 %: the load spread evenly over the 100 nodes of "
           "the end face, axis 1 of C along the beam, and C1111 - C1122 (Cube-I), C1122 and C1212 (Cube-II), C1122 and "
           "C1111 (Cube-III) equal to the elastic tensor. " +
               limit}};
}

std::string paper_markdown(const PaperStudy& study) {
  std::string out = "# Nishimura et al. with Koshi\n\n";
  for (const PaperSection& section : paper_sections(study)) out += markdown(section);
  return out;
}

void write_paper(const PaperStudy& study, const std::filesystem::path& directory) {
  const Json json{{"version", KOSHI_VERSION},
                  {"springs", json_rows(study.springs)},
                  {"uniaxial", json_rows(study.uniaxial)},
                  {"cantilever", json_rows(study.cantilever)}};
  io::replace_file(directory / "paper.md", paper_markdown(study));
  io::replace_file(directory / "paper.json", json.dump(2) + "\n");
  io::replace_file(directory / "fig7.csv", curves_csv(study));
  // The numbers stand without the page, whose template is only there when it was built.
  try {
    report::write_report_page(directory / "report.html", paper_page(study));
  } catch (const RunError& error) {
    log_warning(error.what());
  }
}

}  // namespace koshi::study
