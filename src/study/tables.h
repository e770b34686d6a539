// The paper's study as files: tables, curves and a page.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace koshi::study {

/// One value of the study: as published, of the same lattice at rest (an independent program's), and as found.
struct PaperRow {
  std::string quantity, lattice;  ///< e.g. "k_n" and "Cube-I"
  double paper, limit, value, tolerance;

  bool holds() const;
};

/// Deflection [m] along the beam at y = 0, 2 mm, ... 78 mm.
struct PaperCurve {
  std::string name;
  std::vector<double> deflection;
};

/// An analysis of the study and where its results are.
struct PaperRun {
  std::string lattice;
  std::filesystem::path directory;
};

struct PaperStudy {
  std::vector<PaperRow> springs;     ///< MN/m
  std::vector<PaperRow> uniaxial;    ///< ratios
  std::vector<PaperRow> cantilever;  ///< cm
  std::vector<PaperCurve> curves;    ///< the theory's last
  std::vector<PaperRun> uniaxial_runs;
  std::vector<PaperRun> cantilever_runs;
};

/// A table of the study, how its numbers are shown, and what must be said of them.
struct PaperSection {
  std::string title;
  const std::vector<PaperRow>* rows;
  int decimals;  ///< as printed in the paper; Koshi's have one more
  std::string note;
};
std::vector<PaperSection> paper_sections(const PaperStudy& study);

/// The tables as Markdown.
std::string paper_markdown(const PaperStudy& study);

/// The page's data (docs/formats/report-data.md): the tables, Figs. 6 and 7, and the deformed beams to look at.
nlohmann::ordered_json paper_page(const PaperStudy& study);

/// Writes paper.md, paper.json, fig7.csv and report.html into the directory.
void write_paper(const PaperStudy& study, const std::filesystem::path& directory);

}  // namespace koshi::study
