// Text headers of image files: their lines, words and numbers.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/input_file.h"

namespace koshi::io {

/// The lines at the start of a file, one by one.
class HeaderLines {
 public:
  explicit HeaderLines(const InputFile& file);

  /// The next line without its end ("\n" or "\r\n"); none at the end of the file. Errors: InputError for a line or a
  /// header that is too long to be one.
  std::optional<std::string> next();

  int number() const { return number_; }        ///< of the last line, from 1
  std::uint64_t offset() const { return at_; }  ///< of the byte behind it

 private:
  const InputFile& file_;
  std::uint64_t at_ = 0;
  int number_ = 0;
};

/// Without blanks at both ends.
std::string_view trimmed(std::string_view text);

/// The parts between blanks.
std::vector<std::string_view> words(std::string_view text);
std::vector<std::string_view> words(std::string&&) = delete;  // the parts would outlive it

/// A number that is the whole text; none for any other text and what does not fit the type.
std::optional<std::int64_t> whole_number(std::string_view text);
std::optional<double> real_number(std::string_view text);

}  // namespace koshi::io
