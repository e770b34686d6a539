// Values of an array of a VTK XML file in their four encodings.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "io/input_file.h"
#include "io/voxels/image.h"

namespace koshi::io {

/// Bytes that come one after another.
class ByteStream {
 public:
  virtual ~ByteStream() = default;
  virtual void read(std::span<std::byte> out) = 0;  ///< InputError when there are fewer
  virtual std::uint64_t left() const = 0;           ///< at least as many as can still come
};

/// Bytes of a file from `begin` up to at most `end`.
class FileStream : public ByteStream {
 public:
  FileStream(const InputFile& file, std::uint64_t begin, std::uint64_t end);
  void read(std::span<std::byte> out) override;
  std::uint64_t left() const override { return end_ - at_; }
  std::uint64_t position() const { return at_; }

 private:
  const InputFile& file_;
  std::uint64_t at_, end_;
};

/// Bytes of a text in base64; blanks between its characters do not count.
class Base64Stream : public ByteStream {
 public:
  explicit Base64Stream(std::string_view text) : text_(text) {}
  void read(std::span<std::byte> out) override;
  std::uint64_t left() const override { return (text_.size() - at_) / 4 * 3 + 6; }
  /// Characters that are behind, blanks included; InputError when only a part of the last group was asked for.
  std::size_t position();

 private:
  bool next_group();

  std::string_view text_;
  std::size_t at_ = 0;
  std::vector<std::byte> ready_;  ///< decoded, in reverse
};

/// How a file stores its blocks of values.
struct VtiEncoding {
  bool zlib = false;        ///< blocks are compressed
  bool wide = false;        ///< numbers of the block headers have 8 bytes, not 4
  bool big_endian = false;  ///< header and values
};

/// `count` bytes of values behind their header, in the file's byte order. Errors: InputError without a place.
std::vector<std::byte> read_block(ByteStream& stream, const VtiEncoding& encoding, std::uint64_t count);

/// `count` numbers of a text, in the machine's byte order. Errors likewise.
std::vector<std::byte> read_ascii(std::string_view text, ValueType type, std::uint64_t count);

}  // namespace koshi::io
