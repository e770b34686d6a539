#include "io/vti_values.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstring>

#include "base/escape.h"
#include "koshi/error.h"

namespace koshi::io {
namespace {

constexpr std::string_view blanks = " \t\r\n";

InputError cut_short() { return InputError("holds an array that is cut short"); }

InputError wrong_length(std::uint64_t found, std::uint64_t wanted) {
  return InputError(fmt::format("holds an array of {} bytes, but its extent asks for {}", found, wanted));
}

std::uint64_t read_number(ByteStream& stream, const VtiEncoding& encoding) {
  std::vector<std::byte> bytes(encoding.wide ? 8 : 4);
  stream.read(bytes);
  if (encoding.big_endian) std::reverse(bytes.begin(), bytes.end());
  std::uint64_t number = 0;
  for (std::size_t b = bytes.size(); b-- > 0;) number = (number << 8) | std::to_integer<std::uint64_t>(bytes[b]);
  return number;
}

// Blocks of equal length, the last one perhaps shorter, each compressed for itself. Header: number of blocks, length of
// a block, length of a shorter last one or 0, then the compressed lengths.
std::vector<std::byte> read_compressed(ByteStream& stream, const VtiEncoding& encoding, std::uint64_t count) {
  const std::uint64_t blocks = read_number(stream, encoding), length = read_number(stream, encoding),
                      last = read_number(stream, encoding);
  if (blocks > stream.left() / (encoding.wide ? 8 : 4)) throw cut_short();
  if (blocks == 0 && count == 0) return {};
  // Blocks and lengths are compared so that their product cannot overflow.
  const std::uint64_t whole = last == 0 ? blocks : blocks - 1;
  if (blocks == 0 || length == 0 || last >= length || whole > count / length || whole * length + last != count)
    throw InputError(fmt::format("holds an array of {} compressed blocks of {} bytes, but its extent asks for {} bytes",
                                 blocks, length, count));
  std::vector<std::uint64_t> packed(static_cast<std::size_t>(blocks));
  std::uint64_t sum = 0;
  for (std::uint64_t& size : packed) {
    size = read_number(stream, encoding);
    if (size > stream.left() || (sum += size) > stream.left()) throw cut_short();
  }
  if (count / 1032 > sum + blocks) throw InputError("holds an array with compressed values that are damaged");

  std::vector<std::byte> values(static_cast<std::size_t>(count)), block;
  std::size_t at = 0;
  for (const std::uint64_t size : packed) {
    block.resize(static_cast<std::size_t>(size));
    stream.read(block);
    const auto wanted = static_cast<uLongf>(std::min<std::uint64_t>(length, count - at));
    uLongf got = wanted;
    const auto* from = reinterpret_cast<const Bytef*>(block.data());
    if (uncompress(reinterpret_cast<Bytef*>(values.data() + at), &got, from, static_cast<uLong>(size)) != Z_OK ||
        got != wanted)
      throw InputError("holds an array with compressed values that are damaged");
    at += wanted;
  }
  return values;
}

template <class T>
bool parse_as(std::string_view word, std::byte* out) {
  T value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  std::memcpy(out, &value, sizeof value);
  return error == std::errc() && end == word.data() + word.size();
}

bool parse_value(std::string_view word, ValueType type, std::byte* out) {
  switch (type) {
    case ValueType::int8:
      return parse_as<std::int8_t>(word, out);
    case ValueType::uint8:
      return parse_as<std::uint8_t>(word, out);
    case ValueType::int16:
      return parse_as<std::int16_t>(word, out);
    case ValueType::uint16:
      return parse_as<std::uint16_t>(word, out);
    case ValueType::int32:
      return parse_as<std::int32_t>(word, out);
    case ValueType::uint32:
      return parse_as<std::uint32_t>(word, out);
    case ValueType::int64:
      return parse_as<std::int64_t>(word, out);
    case ValueType::uint64:
      return parse_as<std::uint64_t>(word, out);
    case ValueType::float32:
      return parse_as<float>(word, out);
    case ValueType::float64:
      return parse_as<double>(word, out);
  }
  return false;
}

int digit_of(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

}  // namespace

FileStream::FileStream(const InputFile& file, std::uint64_t begin, std::uint64_t end)
    : file_(file), at_(std::min(begin, end)), end_(end) {}

void FileStream::read(std::span<std::byte> out) {
  if (out.size() > left()) throw cut_short();
  file_.read(at_, out);
  at_ += out.size();
}

void Base64Stream::read(std::span<std::byte> out) {
  for (std::byte& byte : out) {
    while (ready_.empty())
      if (!next_group()) throw cut_short();
    byte = ready_.back();
    ready_.pop_back();
  }
}

// Four characters are three bytes, or two or one where "=" ends a block; the next block follows at once.
bool Base64Stream::next_group() {
  std::uint32_t bits = 0;
  int digits = 0, ends = 0;
  while (digits + ends < 4) {
    at_ = std::min(text_.find_first_not_of(blanks, at_), text_.size());
    if (at_ == text_.size()) break;
    const char c = text_[at_++];
    const int digit = digit_of(c);
    if ((digit < 0 && c != '=') || (digit >= 0 && ends > 0)) throw InputError("holds an array that is no base64");
    bits = bits << 6 | static_cast<std::uint32_t>(std::max(digit, 0));
    ++(digit < 0 ? ends : digits);
  }
  if (digits + ends == 0) return false;
  if (digits + ends < 4 || digits < 2) throw InputError("holds an array that is no base64");
  for (int b = 3 - ends; b-- > 0;) ready_.push_back(static_cast<std::byte>(bits >> (16 - 8 * b) & 0xffU));
  return true;
}

std::size_t Base64Stream::position() {
  if (!ready_.empty()) throw InputError("holds an array with more bytes than its header says");
  return std::min(text_.find_first_not_of(blanks, at_), text_.size());
}

std::vector<std::byte> read_block(ByteStream& stream, const VtiEncoding& encoding, std::uint64_t count) {
  if (encoding.zlib) return read_compressed(stream, encoding, count);
  const std::uint64_t length = read_number(stream, encoding);
  if (length != count) throw wrong_length(length, count);
  if (count > stream.left()) throw cut_short();
  std::vector<std::byte> values(static_cast<std::size_t>(count));
  stream.read(values);
  return values;
}

std::vector<std::byte> read_ascii(std::string_view text, ValueType type, std::uint64_t count) {
  // A number and a blank are two characters at least.
  const std::uint64_t size = size_of(type);
  if (count > text.size()) throw wrong_length(text.size() / 2 * size, count * size);
  std::vector<std::byte> values(static_cast<std::size_t>(count * size));
  std::uint64_t done = 0;
  for (std::size_t at = text.find_first_not_of(blanks); at < text.size();) {
    const std::size_t end = std::min(text.find_first_of(blanks, at), text.size());
    const std::string_view word = text.substr(at, end - at);
    if (done == count) throw InputError(fmt::format("holds an array of more than the {} values of its extent", count));
    if (!parse_value(word, type, values.data() + done * size))
      throw InputError(fmt::format("holds an array with {}, no {}", shown(word), name_of(type)));
    ++done;
    at = text.find_first_not_of(blanks, end);
  }
  if (done != count)
    throw InputError(fmt::format("holds an array of {} values, but its extent asks for {}", done, count));
  return values;
}

}  // namespace koshi::io
