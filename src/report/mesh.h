// The body of a report: surface, fields and samples as the data block's `mesh` (docs/formats/report-data.md).
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "koshi/definition.h"

namespace koshi::report {

/// A sample of fields on disk and what the page calls it.
struct ReportSample {
  std::filesystem::path path;
  double time = 0;    ///< [s]
  std::string label;  ///< shown instead of the time unless empty
};

/// What a page may carry. Beyond it the surface is thinned, the inside left out and samples skipped, and a note says
/// so.
struct ReportLimits {
  std::int64_t surface_points = 1'000'000;
  double interior_bytes = 5e7;  ///< values of all samples with the inside of the body
  double sample_bytes = 2e8;    ///< values of all samples
};

/// Samples of one body (at least one), in the order they are to be shown, with the fields that all of them have.
/// `materials`: names of the materials 1, 2, ...; they become a field where the body has several.
/// `regions`: of a body that its regions cut, the definition with the contents of its files; the mesh then has the true
/// surface as well. Throws InputError when a sample cannot be read or belongs to another body.
nlohmann::ordered_json mesh_block(std::span<const ReportSample> samples, std::span<const std::string> materials,
                                  const model::Definition* regions = nullptr, const ReportLimits& limits = {});

}  // namespace koshi::report
