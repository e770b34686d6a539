// The study of Nishimura et al.: uniaxial compression and cantilever with Cube-I, -II, -III.
#pragma once

#include <filesystem>
#include <vector>

#include "koshi/communicator.h"
#include "koshi/definition.h"

namespace koshi::study {

/// Runs all six analyses and the cantilever with exact springs, prints and writes the tables (paper.md, paper.json),
/// the curves of Fig. 7 (fig7.csv) and an output directory for each analysis. Throws RunError when a value leaves its
/// tolerance.
void run_paper(const std::filesystem::path& directory, bool quiet, const Communicator& communicator);

/// The body, boundaries and probes of the uniaxial compression (Fig. 4, Table 1).
model::Definition uniaxial_case(lattice::CellType cell);

/// The cantilever (Figs. 5-7), as published or with exact springs; its first probe is the tip, the others lie along the
/// line x = 0.8 cm, z = 1.0 cm at y = 0, 0.2, ..., 7.8 cm.
model::Definition cantilever_case(lattice::CellType cell, bool exact);

}  // namespace koshi::study
