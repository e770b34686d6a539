#include "io/stl.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <optional>

#include "base/escape.h"
#include "io/input_file.h"
#include "io/voxels/header_text.h"
#include "koshi/error.h"

namespace koshi::io {
namespace {

using Triangles = std::vector<std::array<Vec3, 3>>;

constexpr std::uint64_t head = 84, facet = 50;  // bytes of a binary file's start and of each triangle

void add(Triangles& triangles, std::size_t number, const std::array<Vec3, 3>& triangle) {
  for (const Vec3& corner : triangle)
    for (const double x : corner)
      if (!std::isfinite(x))
        throw InputError(fmt::format("has a corner that is no place, at triangle {} from the start", number));
  if (triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0])
    triangles.push_back(triangle);
}

// Each facet: the normal, three corners, all of three floats, and two bytes without meaning.
Triangles read_binary(const std::string& bytes) {
  static_assert(std::endian::native == std::endian::little);
  Triangles triangles;
  std::size_t number = 0;
  for (std::size_t at = head; at < bytes.size(); at += facet) {
    std::array<Vec3, 3> triangle;
    for (std::size_t v = 0; v < 3; ++v)
      for (std::size_t a = 0; a < 3; ++a) {
        float x = 0;
        std::memcpy(&x, bytes.data() + at + 12 + 12 * v + 4 * a, sizeof x);
        triangle[v][a] = x + 0.0F;  // -0 and 0 are one place
      }
    add(triangles, ++number, triangle);
  }
  return triangles;
}

/// The words of a text, one by one.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {}
  std::string_view next() {
    constexpr std::string_view blanks = " \t\r\n";
    at_ = std::min(text_.find_first_not_of(blanks, at_), text_.size());
    const std::size_t end = std::min(text_.find_first_of(blanks, at_), text_.size());
    const std::string_view word = text_.substr(at_, end - at_);
    at_ = end;
    return word;
  }
  // The rest of a line: the name of a solid.
  void skip_line() { at_ = std::min(text_.find('\n', at_), text_.size()); }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
};

bool same_word(std::string_view word, std::string_view lower) {
  if (word.size() != lower.size()) return false;
  for (std::size_t i = 0; i < word.size(); ++i)
    if (std::tolower(static_cast<unsigned char>(word[i])) != lower[i]) return false;
  return true;
}

// solid NAME { facet normal x y z  outer loop  vertex x y z (3)  endloop  endfacet } endsolid NAME, any number of them.
Triangles read_text(const std::string& text) {
  Triangles triangles;
  Words words(text);
  std::size_t number = 0;
  const auto expect = [&](std::string_view wanted) {
    if (const auto word = words.next(); !same_word(word, wanted))
      throw InputError(
          fmt::format("has {} where \"{}\" is expected, at triangle {} from the start; it may be cut short",
                      shown(word), wanted, number));
  };
  const auto numbers = [&] {
    Vec3 x{};
    for (double& component : x) {
      const auto word = words.next();
      const auto value = real_number(word.starts_with('+') ? word.substr(1) : word);
      if (!value)
        throw InputError(
            fmt::format("has {} where a number is expected, at triangle {} from the start", shown(word), number));
      component = *value + 0.0;
    }
    return x;
  };
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    if (!same_word(word, "solid")) throw InputError(fmt::format("has {} where \"solid\" is expected", shown(word)));
    words.skip_line();
    for (word = words.next(); same_word(word, "facet"); word = words.next()) {
      ++number;
      expect("normal");
      numbers();
      expect("outer");
      expect("loop");
      std::array<Vec3, 3> triangle;
      for (Vec3& corner : triangle) {
        expect("vertex");
        corner = numbers();
      }
      expect("endloop");
      expect("endfacet");
      add(triangles, number, triangle);
    }
    if (!same_word(word, "endsolid"))
      throw InputError(
          fmt::format("has {} where \"facet\" or \"endsolid\" is expected, at triangle {} from the start; it "
                      "may be cut short",
                      shown(word), number));
    words.skip_line();
  }
  return triangles;
}

}  // namespace

std::vector<std::array<Vec3, 3>> read_stl(const std::filesystem::path& path) {
  const InputFile file(path);
  const std::string start = file.text(0, head);
  std::uint32_t count = 0;
  if (start.size() == head) std::memcpy(&count, start.data() + 80, sizeof count);
  const bool fits = start.size() == head && head + facet * count == file.size();

  // Binary files may begin with "solid" as well: their length tells.
  Triangles triangles;
  if (fits)
    triangles = read_binary(file.text(0, file.size()));
  else if (start.starts_with("solid"))
    triangles = read_text(file.text(0, file.size()));
  else if (start.size() == head)
    throw InputError(fmt::format("is no STL file: {} triangles make {} bytes, but it has {}", count,
                                 head + facet * count, file.size()));
  else
    throw InputError("is no STL file");
  if (triangles.empty()) throw InputError("holds no triangles");
  return triangles;
}

}  // namespace koshi::io
