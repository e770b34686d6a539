// The data block of a report as text (docs/formats/report-data.md): arrays, and the page around the block.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>

namespace koshi::io {

/// An Array of the format: {dtype, encoding, data}, deflated. Throws RunError when the memory does not suffice.
nlohmann::ordered_json encoded(std::span<const float> values);
nlohmann::ordered_json encoded(std::span<const double> values);
nlohmann::ordered_json encoded(std::span<const std::int32_t> values);

/// The page with the data in its empty block. Throws RunError unless the template holds that block exactly once.
std::string filled_template(std::string_view page, const nlohmann::ordered_json& data);

}  // namespace koshi::io
