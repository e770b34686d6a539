// One file for each slice of a scan, in the order of the numbers in their names.
#pragma once

#include <filesystem>
#include <vector>

namespace koshi::io {

/// The files that a pattern names, "*" in place of the number, or the TIFF files of a folder, whose names must differ
/// by the number alone. Errors: InputError without a place, a predicate such as "misses slice 3"; numbers must follow
/// each other.
std::vector<std::filesystem::path> slices_of(const std::filesystem::path& pattern_or_folder);

}  // namespace koshi::io
