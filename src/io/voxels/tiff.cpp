// TIFF: the pages of one file, or one file for each slice, through libtiff.
#include <fmt/format.h>
#include <tiffio.h>

#include <algorithm>
#include <map>
#include <memory>

#include "base/escape.h"
#include "io/voxels/formats.h"
#include "io/voxels/slices.h"
#include "koshi/error.h"

namespace koshi::io {
namespace {

using Tiff = std::unique_ptr<TIFF, void (*)(TIFF*)>;

int keep_silent(TIFF*, void*, const char*, const char*, va_list) { return 1; }

Tiff open(const std::filesystem::path& path) {
  const std::unique_ptr<TIFFOpenOptions, void (*)(TIFFOpenOptions*)> options(TIFFOpenOptionsAlloc(),
                                                                             TIFFOpenOptionsFree);
  if (!options) throw std::bad_alloc();
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), keep_silent, nullptr);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), keep_silent, nullptr);
  Tiff tiff(TIFFOpenExt(path.c_str(), "rm", options.get()), TIFFClose);  // m: no mapping into memory
  if (!tiff) throw InputError("is no TIFF image that can be read");
  return tiff;
}

// Pages of the file by its chain of directories: libtiff takes a chain that leaves the file for one that ends.
std::int64_t count_pages(const InputFile& file) {
  const bool little = file.text(0, 1) == "I";
  const auto number = [&](std::uint64_t offset, std::size_t width) {
    std::string bytes = file.text(offset, offset + width);
    if (bytes.size() != width) throw InputError("is cut short: its list of pages leaves the file");
    if (little) std::reverse(bytes.begin(), bytes.end());
    std::uint64_t value = 0;
    for (const char byte : bytes) value = value << 8 | static_cast<unsigned char>(byte);
    return value;
  };
  // Version 43 has 64 bits where 42 has 32: offset of the first directory, number of entries, size of one, next offset.
  const bool big = number(2, 2) == 43;
  const std::size_t width = big ? 8 : 4;
  std::int64_t pages = 0;
  for (std::uint64_t at = number(width, width); at != 0; ++pages) {
    // A chain may also bite its tail.
    if (pages == 65535) throw InputError("has more than 65535 pages");
    const std::uint64_t entries = number(at, big ? 8 : 2);
    if (entries > 65535) throw InputError("has a page that cannot be read");
    at = number(at + (big ? 8 + 20 * entries : 2 + 12 * entries), width);
  }
  return pages;
}

ValueType type_of(TIFF* tiff) {
  std::uint16_t bits = 1, format = SAMPLEFORMAT_UINT, samples = 1;
  TIFFGetFieldDefaulted(tiff, TIFFTAG_BITSPERSAMPLE, &bits);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLEFORMAT, &format);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLESPERPIXEL, &samples);
  if (samples != 1) throw InputError(fmt::format("has {} values a pixel; save it as grey values", samples));
  using enum ValueType;
  static const std::map<std::pair<int, int>, ValueType> types{
      {{SAMPLEFORMAT_UINT, 8}, uint8},      {{SAMPLEFORMAT_UINT, 16}, uint16},   {{SAMPLEFORMAT_UINT, 32}, uint32},
      {{SAMPLEFORMAT_INT, 8}, int8},        {{SAMPLEFORMAT_INT, 16}, int16},     {{SAMPLEFORMAT_INT, 32}, int32},
      {{SAMPLEFORMAT_IEEEFP, 32}, float32}, {{SAMPLEFORMAT_IEEEFP, 64}, float64}};
  const auto at = types.find({format, bits});
  if (at == types.end()) throw InputError(fmt::format("has values of {} bits; save it with 8, 16 or 32", bits));
  return at->second;
}

// Size and type of the page, held against the length of the file: what is not packed must be there, and the packings
// that are read make no more than 1400 bytes of one.
VoxelHeader page_header(TIFF* tiff, std::uint64_t file_size) {
  std::uint32_t width = 0, height = 0;
  std::uint16_t packing = COMPRESSION_NONE;
  TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &width);
  TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &height);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_COMPRESSION, &packing);
  if (TIFFIsTiled(tiff) != 0) throw InputError("has tiles; save it in strips");
  const bool known = packing == COMPRESSION_NONE || packing == COMPRESSION_LZW || packing == COMPRESSION_PACKBITS ||
                     packing == COMPRESSION_ADOBE_DEFLATE || packing == COMPRESSION_DEFLATE;
  if (!known)
    throw InputError(fmt::format("is packed by scheme {}; save it unpacked, or with LZW or deflate", packing));
  const VoxelHeader header{{width, height, 1}, type_of(tiff), false, {}};
  if (bytes_of(header) / (packing == COMPRESSION_NONE ? 1 : 1400) > file_size)
    throw InputError(fmt::format("is cut short: a page of {} cannot be in {} bytes", words_of(header), file_size));
  return header;
}

// Appends the values of the page, in the machine's order.
void append_page(TIFF* tiff, const VoxelHeader& page, std::vector<std::byte>& bytes) {
  std::size_t at = bytes.size();
  bytes.resize(at + static_cast<std::size_t>(bytes_of(page)));
  std::uint32_t rows = 0;
  TIFFGetFieldDefaulted(tiff, TIFFTAG_ROWSPERSTRIP, &rows);
  const auto height = static_cast<std::uint32_t>(page.size[1]);
  rows = std::min(rows, height);
  if (rows == 0) throw InputError("has a page without rows");
  const std::size_t row = static_cast<std::size_t>(page.size[0]) * size_of(page.type);
  for (std::uint32_t first = 0, strip = 0; first < height; first += rows, ++strip) {
    const std::size_t wanted = row * std::min(rows, height - first);
    const tmsize_t got = TIFFReadEncodedStrip(tiff, strip, bytes.data() + at, static_cast<tmsize_t>(wanted));
    if (got != static_cast<tmsize_t>(wanted)) throw InputError("has a page that is damaged or cut short");
    at += wanted;
  }
}

void append_pages(const std::filesystem::path& path, VoxelImage& image) {
  const InputFile file(path);  // refuses what is no regular file
  const Tiff tiff = open(path);
  const std::int64_t pages = count_pages(file);
  std::int64_t read = 0;
  do {
    const VoxelHeader page = page_header(tiff.get(), file.size());
    if (image.size[2] == 0) {
      image.size = page.size;
      image.type = page.type;
    } else if (image.size[0] != page.size[0] || image.size[1] != page.size[1] || image.type != page.type) {
      throw InputError(fmt::format("has a page of {} x {} {}, but those before are of {} x {} {}", page.size[0],
                                   page.size[1], name_of(page.type), image.size[0], image.size[1],
                                   name_of(image.type)));
    } else {
      ++image.size[2];
    }
    // A page may be a lie that repeats one strip; memory is bounded by the number of pages.
    if (image.size[2] > 65535) throw InputError("has more than 65535 pages");
    ++read;
    append_page(tiff.get(), page, image.bytes);
  } while (TIFFReadDirectory(tiff.get()) == 1);
  if (read != pages) throw InputError("has a page that cannot be read");
}

}  // namespace

VoxelImage read_tiff(const std::filesystem::path& path) {
  VoxelImage image;
  const bool pages = !path.extension().empty() && path.filename().string().find('*') == std::string::npos;
  if (pages) {
    append_pages(path, image);
  } else {
    for (const std::filesystem::path& slice : slices_of(path)) {
      try {
        append_pages(slice, image);
      } catch (const InputError& error) {
        throw InputError(
            fmt::format("names the slice {}, which {}", shown(slice.filename().string()), error.message()));
      }
    }
  }
  image.stride = {1, image.size[0], image.size[0] * image.size[1]};
  return image;
}

}  // namespace koshi::io
