// `koshi report DIR`: the results of a run as one page (docs/formats/report-data.md).
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace koshi::report {

/// The data block for the results in an output directory: input, springs, probes, history, convergence and fields, as
/// far as the directory holds them. Throws InputError when it is no output directory or a file in it cannot be read.
nlohmann::ordered_json report_data(const std::filesystem::path& directory);

/// Writes a page that shows these data: beside, then renamed. Throws RunError when the page's template is not installed
/// or the file cannot be written.
void write_report_page(const std::filesystem::path& file, const nlohmann::ordered_json& data);

/// Throws RunError when the page's template is not installed.
void check_report_template();

/// Both: `report.html` in the output directory.
void write_report(const std::filesystem::path& directory);

}  // namespace koshi::report
