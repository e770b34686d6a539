// Names of the samples in fields/.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace koshi::io {

/// "sample_000012"
std::string sample_name(std::uint64_t number);

/// The number of the sample that a file or folder of this name belongs to; none for other names.
std::optional<std::uint64_t> sample_number(const std::string& name);

}  // namespace koshi::io
