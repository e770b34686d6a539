#include "io/voxels/byte_source.h"

#include <bzlib.h>
#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <limits>

#include "koshi/error.h"

namespace koshi::io {

/// Turns the bytes of the file into those that count.
class ByteSource::Decoder {
 public:
  virtual ~Decoder() = default;
  /// Fewer bytes than asked for only at the end.
  virtual std::size_t read(std::span<std::byte> out) = 0;
};

namespace {

class Plain : public ByteSource::Decoder {
 public:
  Plain(const InputFile& file, std::uint64_t begin, std::uint64_t end) : file_(file), at_(begin), end_(end) {}
  std::size_t read(std::span<std::byte> out) override {
    out = out.first(static_cast<std::size_t>(std::min<std::uint64_t>(out.size(), end_ - at_)));
    file_.read(at_, out);
    at_ += out.size();
    return out.size();
  }

 private:
  const InputFile& file_;
  std::uint64_t at_, end_;
};

class Zlib : public ByteSource::Decoder {
 public:
  Zlib(const InputFile& file, std::uint64_t begin, std::uint64_t end) : packed_(file, begin, end) {
    constexpr int zlib_or_gzip = 15 + 32;
    if (inflateInit2(&stream_, zlib_or_gzip) != Z_OK) throw std::bad_alloc();
  }
  ~Zlib() override { inflateEnd(&stream_); }

  std::size_t read(std::span<std::byte> out) override {
    std::size_t done = 0;
    while (done < out.size()) {
      fill();
      // A gzip file may consist of several streams; what follows the last one must be nothing.
      if (between_) {
        if (stream_.avail_in == 0) return done;
        if (*stream_.next_in != 0x1f || inflateReset(&stream_) != Z_OK)
          throw InputError("has other bytes behind its compressed values");
        between_ = false;
      }
      constexpr std::size_t step = std::numeric_limits<int>::max();
      const std::size_t room = std::min(out.size() - done, step);
      stream_.next_out = reinterpret_cast<Bytef*>(out.data() + done);
      stream_.avail_out = static_cast<uInt>(room);
      const int result = inflate(&stream_, Z_NO_FLUSH);
      done += room - stream_.avail_out;
      between_ = result == Z_STREAM_END;
      if (result == Z_BUF_ERROR) throw InputError("has compressed values that are cut short");
      if (result != Z_OK && !between_) throw InputError("has compressed values that are damaged");
    }
    return done;
  }

 private:
  void fill() {
    if (stream_.avail_in > 0) return;
    stream_.avail_in = static_cast<uInt>(packed_.read(buffer_));
    stream_.next_in = reinterpret_cast<Bytef*>(buffer_.data());
  }

  Plain packed_;
  z_stream stream_{};
  std::array<std::byte, 1 << 16> buffer_;
  bool between_ = false;  ///< two streams
};

class Bzip2 : public ByteSource::Decoder {
 public:
  Bzip2(const InputFile& file, std::uint64_t begin, std::uint64_t end) : packed_(file, begin, end) {
    if (BZ2_bzDecompressInit(&stream_, 0, 0) != BZ_OK) throw std::bad_alloc();
  }
  ~Bzip2() override { BZ2_bzDecompressEnd(&stream_); }

  std::size_t read(std::span<std::byte> out) override {
    std::size_t done = 0;
    while (done < out.size()) {
      if (stream_.avail_in == 0) {
        stream_.avail_in = static_cast<unsigned>(packed_.read(buffer_));
        stream_.next_in = reinterpret_cast<char*>(buffer_.data());
      }
      if (ended_ && stream_.avail_in > 0) throw InputError("has other bytes behind its compressed values");
      if (ended_) return done;
      if (stream_.avail_in == 0) throw InputError("has compressed values that are cut short");
      constexpr std::size_t step = std::numeric_limits<int>::max();
      const std::size_t room = std::min(out.size() - done, step);
      stream_.next_out = reinterpret_cast<char*>(out.data() + done);
      stream_.avail_out = static_cast<unsigned>(room);
      const int result = BZ2_bzDecompress(&stream_);
      done += room - stream_.avail_out;
      ended_ = result == BZ_STREAM_END;
      if (result != BZ_OK && !ended_) throw InputError("has compressed values that are damaged");
    }
    return done;
  }

 private:
  Plain packed_;
  bz_stream stream_{};
  std::array<std::byte, 1 << 16> buffer_;
  bool ended_ = false;
};

std::unique_ptr<ByteSource::Decoder> make_decoder(const InputFile& file, std::uint64_t begin, std::uint64_t end,
                                                  Compression compression) {
  end = std::min(end, file.size());
  begin = std::min(begin, end);
  if (compression == Compression::zlib) return std::make_unique<Zlib>(file, begin, end);
  if (compression == Compression::bzip2) return std::make_unique<Bzip2>(file, begin, end);
  return std::make_unique<Plain>(file, begin, end);
}

}  // namespace

ByteSource::ByteSource(const InputFile& file, std::uint64_t begin, std::uint64_t end, Compression compression)
    : decoder_(make_decoder(file, begin, end, compression)) {
  // Deflate makes at most 1032 bytes of one, bzip2 46 million of a block of 45.
  const double packed = static_cast<double>(std::min(end, file.size()) - std::min(begin, file.size()));
  const double ratio = compression == Compression::none ? 1 : compression == Compression::zlib ? 1032 : 2e6;
  most_ = static_cast<std::uint64_t>(ratio * packed);
}

ByteSource::~ByteSource() = default;

std::size_t ByteSource::read(std::span<std::byte> out) { return decoder_->read(out); }

std::vector<std::byte> ByteSource::read_rest(std::uint64_t count, const std::string& what) {
  const auto too_few = [&](std::uint64_t found) {
    return InputError(fmt::format("is cut short: {} need {} bytes, at most {} are there", what, count, found));
  };
  if (count > most_) throw too_few(most_);

  // Compressed data may be a lie of the header: memory is taken as they come.
  std::vector<std::byte> bytes;
  constexpr std::uint64_t step = std::uint64_t{64} << 20;
  while (bytes.size() < count) {
    const std::size_t before = bytes.size();
    bytes.resize(static_cast<std::size_t>(std::min(count, before + std::max<std::uint64_t>(step, before))));
    const std::size_t got = read(std::span(bytes).subspan(before));
    if (before + got < bytes.size()) throw too_few(before + got);
  }
  std::byte surplus{};
  if (read({&surplus, 1}) != 0) throw InputError(fmt::format("holds more than the {} bytes that {} need", count, what));
  return bytes;
}

}  // namespace koshi::io
