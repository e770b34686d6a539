#include "base/suggest.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <vector>

namespace koshi {
namespace {

bool same_letter(char a, char b) {
  return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
}

bool starts_alike(std::string_view a, std::string_view b, std::size_t length) {
  return a.size() >= length &&
         std::equal(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(length), b.begin(), same_letter);
}

// Levenshtein distance, one row of the table at a time.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (same_letter(a[i - 1], b[j - 1]) ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[b.size()];
}

}  // namespace

std::string quoted_list(std::span<const std::string> names) {
  std::vector<std::string> quoted;
  for (const auto& name : names) quoted.push_back(fmt::format("\"{}\"", name));
  return fmt::format("{}", fmt::join(quoted, ", "));
}

std::optional<std::string> nearest(std::string_view word, std::span<const std::string> known) {
  // Long words are no typing errors of ours, and comparing them would cost time for nothing.
  constexpr std::size_t longest = 64;
  if (word.size() > longest) return std::nullopt;
  const std::string* best = nullptr;
  std::size_t least = longest;
  for (const auto& name : known) {
    // One typing error in three letters, at most three; one in a word of two letters, none in a single letter.
    const std::size_t allowed = std::clamp<std::size_t>(name.size() / 3, name.size() > 1 ? 1 : 0, 3);
    const std::size_t distance = edit_distance(word, name);
    if (distance > allowed || distance >= least) continue;
    best = &name;
    least = distance;
  }
  // Another ending, such as a plural: most of the name is there.
  for (const auto& name : known)
    if (best == nullptr && name.size() >= 6 && starts_alike(word, name, name.size() * 3 / 4)) best = &name;
  if (best == nullptr) return std::nullopt;
  return *best;
}

std::string suggestion(std::string_view word, std::span<const std::string> known) {
  if (known.empty()) return "none is known";
  if (const auto meant = nearest(word, known)) return fmt::format("did you mean \"{}\"?", *meant);
  return "known: " + quoted_list(known);
}

}  // namespace koshi
