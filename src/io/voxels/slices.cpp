#include "io/voxels/slices.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string>

#include "base/escape.h"
#include "io/voxels/header_text.h"
#include "koshi/error.h"

namespace koshi::io {
namespace {

namespace fs = std::filesystem;

/// What stands before and after the number of a slice.
struct Pattern {
  std::string before, after;
  bool operator==(const Pattern&) const = default;
};

std::string shown_pattern(const Pattern& pattern) { return shown(pattern.before + "*" + pattern.after); }

// The last digits before the ending are the number; none in a name without digits.
std::optional<Pattern> pattern_of(const std::string& name) {
  constexpr const char* digits = "0123456789";
  const std::size_t dot = name.rfind('.');
  const std::size_t last = name.find_last_of(digits, dot);
  if (last == std::string::npos) return std::nullopt;
  const std::size_t other = name.find_last_not_of(digits, last);
  const std::size_t first = other == std::string::npos ? 0 : other + 1;
  return Pattern{name.substr(0, first), name.substr(last + 1)};
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::error_code error;
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder.empty() ? "." : folder, error))
    names.push_back(entry.path().filename().string());
  if (error) throw InputError(fmt::format("is in a folder that cannot be read ({})", error.message()));
  // The order of a folder is any.
  std::sort(names.begin(), names.end());
  return names;
}

// The one pattern that all TIFF files of a folder follow.
Pattern pattern_in(const fs::path& folder) {
  if (!fs::is_directory(folder))
    throw InputError(
        "is no folder of slices; a file needs its format at the end of its name, such as \"scan.tif\" or "
        "\"scan.nrrd\"");
  std::optional<Pattern> pattern;
  std::string first;
  for (const std::string& name : names_in(folder)) {
    const bool hidden = name.starts_with('.');
    if (hidden || !(name.ends_with(".tif") || name.ends_with(".tiff"))) continue;
    const auto own = pattern_of(name);
    if (!own) throw InputError(fmt::format("holds {}, a slice without a number in its name", shown(name)));
    if (pattern && *own != *pattern)
      throw InputError(
          fmt::format("holds {} and {}, which are no slices of one scan; name those you mean by a pattern, "
                      "such as {}",
                      shown(first), shown(name), shown_pattern(*pattern)));
    if (!pattern) first = name;
    pattern = own;
  }
  if (!pattern) throw InputError("is a folder without TIFF files; slices end in \".tif\" or \".tiff\"");
  return *pattern;
}

}  // namespace

std::vector<fs::path> slices_of(const fs::path& pattern_or_folder) {
  fs::path folder = pattern_or_folder.parent_path();
  const std::string name = pattern_or_folder.filename().string();
  Pattern pattern;
  if (const std::size_t star = name.find('*'); star != std::string::npos) {
    pattern = {name.substr(0, star), name.substr(star + 1)};
  } else {
    folder = pattern_or_folder;
    pattern = pattern_in(folder);
  }

  const auto& [before, after] = pattern;
  std::map<std::int64_t, std::string> slices;
  for (const std::string& file : names_in(folder)) {
    if (file.size() <= before.size() + after.size() || !file.starts_with(before) || !file.ends_with(after)) continue;
    const auto number =
        whole_number(std::string_view(file).substr(before.size(), file.size() - before.size() - after.size()));
    if (!number || *number < 0) continue;
    const auto [at, is_new] = slices.emplace(*number, file);
    if (!is_new)
      throw InputError(
          fmt::format("names two files of the number {}: {} and {}", *number, shown(at->second), shown(file)));
  }
  if (slices.empty()) throw InputError("names no file; \"*\" stands for the number of a slice");

  std::vector<fs::path> files;
  std::int64_t next = slices.begin()->first;
  for (const auto& [number, file] : slices) {
    if (number != next)
      throw InputError(
          fmt::format("misses slice {}: {} follows {}", next, shown(file), shown(files.back().filename().string())));
    files.push_back(folder / file);
    ++next;
  }
  return files;
}

}  // namespace koshi::io
