// The paper's study as files: tables, curves and a page.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace koshi::driver {

/// One value of the study: as published, of the same lattice at rest (an independent program's), and as found.
struct PaperRow {
  std::string name;
  double paper, limit, value, tolerance;

  bool holds() const;
};

/// Deflection [m] along the beam at y = 0, 2 mm, ... 78 mm.
struct PaperCurve {
  std::string name;
  std::vector<double> deflection;
};

struct PaperStudy {
  std::vector<PaperRow> springs;     ///< MN/m
  std::vector<PaperRow> uniaxial;    ///< ratios
  std::vector<PaperRow> cantilever;  ///< cm
  std::vector<PaperCurve> curves;
};

/// The tables as Markdown.
std::string paper_markdown(const PaperStudy& study);

/// Writes paper.md, paper.json, fig7.csv and report.html into the directory; the page shows the body of the run in
/// `cantilever`.
void write_paper(const PaperStudy& study, const std::filesystem::path& directory,
                 const std::filesystem::path& cantilever);

}  // namespace koshi::driver
