// Bytes of a part of a file, decompressed on the way.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "io/input_file.h"

namespace koshi::io {

enum class Compression {
  none,
  zlib,  ///< or gzip; the stream says which
  bzip2
};

class ByteSource {
 public:
  /// The bytes [begin, end) of the file, which must outlive the source. Errors: InputError without a place.
  ByteSource(const InputFile& file, std::uint64_t begin, std::uint64_t end, Compression compression);
  ~ByteSource();

  /// Fills as much of `out` as there is and returns how much that was. Errors: InputError for damaged data.
  std::size_t read(std::span<std::byte> out);

  /// Exactly `count` bytes, the last of the source. Memory grows only with what is really there. Errors: InputError
  /// that begins with `what` when there are more or fewer.
  std::vector<std::byte> read_rest(std::uint64_t count, const std::string& what);

  class Decoder;

 private:
  std::unique_ptr<Decoder> decoder_;
  std::uint64_t most_;  ///< bytes that may come out of these
};

}  // namespace koshi::io
