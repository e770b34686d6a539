#include "io/checkpoint_index.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <utility>

#include "base/escape.h"
#include "io/checkpoint_seal.h"
#include "koshi/error.h"

namespace koshi::io {
namespace {

// The words of a line; what is left of it is a name.
class Line {
 public:
  explicit Line(std::string_view text) : whole_(text), left_(text) {}

  std::string_view word() {
    const std::size_t end = left_.find(' ');
    const std::string_view word = left_.substr(0, end);
    left_.remove_prefix(end == std::string_view::npos ? left_.size() : end + 1);
    return word;
  }
  template <class T>
  T number() {
    const std::string_view text = word();
    T value{};
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || rest != text.data() + text.size()) fail();
    return value;
  }
  std::string name() {
    if (left_.empty()) fail();
    return std::string(std::exchange(left_, {}));
  }
  void end() const {
    if (!left_.empty()) fail();
  }
  [[noreturn]] void fail() const { throw InputError(fmt::format("its index has the line {}", shown(whole_))); }

 private:
  std::string_view whole_, left_;
};

// A part of the file behind the seal.
Bytes read_bytes(Line& line, std::uint64_t file_size) {
  const Bytes bytes{line.number<std::uint64_t>(), line.number<std::uint64_t>()};
  if (bytes.offset < seal_size || bytes.offset > file_size || bytes.count > file_size - bytes.offset) line.fail();
  return bytes;
}

IndexedField read_field(Line& line, std::uint64_t file_size) {
  IndexedField field{line.number<std::uint64_t>(), {}};
  if (field.offset < seal_size || field.offset > file_size) line.fail();
  // Divided instead of multiplied: no product can overflow.
  std::uint64_t room = (file_size - field.offset) / sizeof(double);
  for (std::int64_t& n : field.shape) {
    n = line.number<std::int64_t>();
    if (n <= 0) line.fail();
    room /= static_cast<std::uint64_t>(n);
  }
  if (room == 0) line.fail();
  return field;
}

}  // namespace

std::string text_of(const CheckpointIndex& index) {
  std::string text = fmt::format("time {}\nstep {}\ncase {} {}\nblob {} {}\n", index.time, index.step,
                                 index.case_text.offset, index.case_text.count, index.blob.offset, index.blob.count);
  for (const auto& [name, value] : index.scalars) text += fmt::format("scalar {} {}\n", value, name);
  for (const auto& [name, field] : index.fields)
    text += fmt::format("field {} {} {}\n", field.offset, fmt::join(field.shape, " "), name);
  return text;
}

CheckpointIndex parse_index(std::string_view text, std::uint64_t file_size) {
  CheckpointIndex index;
  int heads = 0;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    Line line(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    const std::string_view what = line.word();
    if (what == "time") {
      index.time = line.number<double>();
      if (!(index.time >= 0) || std::isinf(index.time)) line.fail();
      heads |= 1;
    } else if (what == "step") {
      index.step = line.number<std::int64_t>();
      if (index.step < 0) line.fail();
      heads |= 2;
    } else if (what == "case") {
      index.case_text = read_bytes(line, file_size);
      heads |= 4;
    } else if (what == "blob") {
      index.blob = read_bytes(line, file_size);
      heads |= 8;
    } else if (what == "scalar") {
      const double value = line.number<double>();
      index.scalars[line.name()] = value;
    } else if (what == "field") {
      const IndexedField field = read_field(line, file_size);
      index.fields[line.name()] = field;
    } else {
      line.fail();
    }
    line.end();
  }
  if (heads != 15) throw InputError("its index lacks time, step, case or blob");
  return index;
}

}  // namespace koshi::io
