// Images as scanners and their programs write them: NIfTI, TIFF of many pages, one TIFF for each slice.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tiffio.h>

#include <cstring>
#include <fstream>

#include "io/cell_image.h"
#include "koshi/error.h"
#include "support/temporary_directory.h"

namespace koshi::io {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

// 4 x 3 x 2 voxels; no two are alike.
constexpr int nx = 4, ny = 3, nz = 2;
int value(int i, int j, int k) { return 100 * k + 10 * j + i; }

class Scans : public testing::Test {
 protected:
  const test::TemporaryDirectory directory;

  void expect_scan(const std::string& file) const {
    SCOPED_TRACE(file);
    const CellImage image = read_cell_image(directory / file);
    ASSERT_EQ(image.cells, (Int3{nx, ny, nz}));
    int count = 0;
    for (int k = 0; k < nz; ++k)
      for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i, ++count)
          ASSERT_EQ(image.value(i * image.stride[0] + j * image.stride[1] + k * image.stride[2]), value(i, j, k));
    EXPECT_EQ(count, 24);
  }
  void expect_refused(const std::string& file, const std::string& message) const {
    EXPECT_THAT([&] { read_cell_image(directory / file); }, ThrowsMessage<InputError>(HasSubstr(message)));
  }

  // Layers [first, last) as pages.
  void write_tiff(const std::string& file, int first, int last, int packing, const char* mode, int width = nx) const {
    TIFF* tiff = TIFFOpen((directory / file).c_str(), mode);
    ASSERT_NE(tiff, nullptr);
    for (int k = first; k < last; ++k) {
      TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, width);
      TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, ny);
      TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 16);
      TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, 1);
      TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
      TIFFSetField(tiff, TIFFTAG_COMPRESSION, packing);
      TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, 2);
      for (int j = 0; j < ny; ++j) {
        std::vector<std::uint16_t> row;
        for (int i = 0; i < width; ++i) row.push_back(static_cast<std::uint16_t>(value(i, j, k)));
        TIFFWriteScanline(tiff, row.data(), static_cast<std::uint32_t>(j), 0);
      }
      TIFFWriteDirectory(tiff);
    }
    TIFFClose(tiff);
  }

  // A header of NIfTI-1, 16-bit values behind it.
  void write_nifti(const std::string& file, float depth, float slope, std::size_t values) const {
    std::string bytes(352, '\0');
    const auto put = [&](std::size_t at, auto number) { std::memcpy(bytes.data() + at, &number, sizeof number); };
    put(0, std::int32_t{348});
    const std::int16_t dim[] = {3, nx, ny, nz};
    std::memcpy(bytes.data() + 40, dim, sizeof dim);
    put(70, std::int16_t{4});
    put(72, std::int16_t{16});
    const float sides[] = {1, 0.5F, 0.5F, depth};
    std::memcpy(bytes.data() + 76, sides, sizeof sides);
    put(108, 352.0F);
    put(112, slope);
    std::memcpy(bytes.data() + 344, "n+1", 4);
    for (std::size_t n = 0; n < values; ++n) {
      const int i = static_cast<int>(n) % nx, j = static_cast<int>(n) / nx % ny, k = static_cast<int>(n) / (nx * ny);
      const auto v = static_cast<std::int16_t>(value(i, j, k));
      bytes.append(reinterpret_cast<const char*>(&v), sizeof v);
    }
    std::ofstream(directory / file, std::ios::binary) << bytes;
  }
};

TEST_F(Scans, PagesOfATiffAreLayers) {
  write_tiff("plain.tif", 0, nz, COMPRESSION_NONE, "w");
  write_tiff("lzw.tiff", 0, nz, COMPRESSION_LZW, "w");
  write_tiff("deflate.tif", 0, nz, COMPRESSION_ADOBE_DEFLATE, "w");
  write_tiff("big_endian.tif", 0, nz, COMPRESSION_PACKBITS, "wb");
  for (const char* file : {"plain.tif", "lzw.tiff", "deflate.tif", "big_endian.tif"}) expect_scan(file);
}

TEST_F(Scans, SlicesAreOrderedByTheirNumbers) {
  write_tiff("slice_9.tif", 0, 1, COMPRESSION_NONE, "w");
  write_tiff("slice_10.tif", 1, 2, COMPRESSION_NONE, "w");
  write_tiff("slice_ab.tif", 1, 2, COMPRESSION_NONE, "w");  // no number: not of them
  expect_scan("slice_*.tif");
  write_tiff("slice_12.tif", 0, 1, COMPRESSION_NONE, "w");
  expect_refused("slice_*.tif", "misses slice 11: \"slice_12.tif\" follows \"slice_10.tif\"");
  write_tiff("slice_11.tif", 0, 1, COMPRESSION_NONE, "w", nx + 1);
  expect_refused(
      "slice_*.tif",
      "names the slice \"slice_11.tif\", which has a page of 5 x 3 uint16, but those before are of 4 x 3 uint16");
  expect_refused("other_*.tif", "names no file; \"*\" stands for the number of a slice");
}

TEST_F(Scans, AFolderIsAllItsSlices) {
  std::filesystem::create_directory(directory / "ct");
  write_tiff("ct/run2_0009.tif", 0, 1, COMPRESSION_NONE, "w");
  write_tiff("ct/run2_0010.tif", 1, 2, COMPRESSION_LZW, "w");
  std::ofstream(directory / "ct/notes.txt") << "80 kV";
  std::ofstream(directory / "ct/.run2_0011.tif") << "";
  expect_scan("ct");
  expect_scan("ct/");
  write_tiff("ct/run2_0012.tif", 0, 1, COMPRESSION_NONE, "w");
  expect_refused("ct", "misses slice 11: \"run2_0012.tif\" follows \"run2_0010.tif\"");
  write_tiff("ct/run2_0011.tif", 0, 1, COMPRESSION_NONE, "w", nx + 1);
  expect_refused("ct",
                 "names the slice \"run2_0011.tif\", which has a page of 5 x 3 uint16, but those before are of 4 x 3");
  write_tiff("ct/run2_11.tif", 0, 1, COMPRESSION_NONE, "w");
  expect_refused("ct", "names two files of the number 11: \"run2_0011.tif\" and \"run2_11.tif\"");
  write_tiff("ct/run3_0011.tif", 0, 1, COMPRESSION_NONE, "w");
  expect_refused("ct",
                 "\"run2_0009.tif\" and \"run3_0011.tif\", which are no slices of one scan; name those you mean by a "
                 "pattern, such as \"run2_*.tif\"");
  write_tiff("ct/flat.tif", 0, 1, COMPRESSION_NONE, "w");
  expect_refused("ct", "holds \"flat.tif\", a slice without a number in its name");
  std::filesystem::create_directory(directory / "empty");
  expect_refused("empty", "is a folder without TIFF files");
  expect_refused("absent", "is no folder of slices; a file needs its format at the end of its name");
}

TEST_F(Scans, TiffsThatAreCutShortAreRefused) {
  write_tiff("whole.tif", 0, nz, COMPRESSION_NONE, "w");
  std::ifstream stream(directory / "whole.tif", std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(stream), {}};
  int refused = 0;
  // Every length at which the last directory (2 + 12 entries of 12 bytes + 4) is not whole.
  for (std::size_t size = 0; size + 20 < whole.size(); size += 7, ++refused) {
    std::ofstream(directory / "cut.tif", std::ios::binary) << whole.substr(0, size);
    EXPECT_THROW(read_cell_image(directory / "cut.tif"), InputError) << size;
  }
  EXPECT_GT(refused, 20);
}

TEST_F(Scans, NiftiImages) {
  write_nifti("scan.nii", 0.5F, 1, nx * ny * nz);
  expect_scan("scan.nii");
  write_nifti("short.nii", 0.5F, 1, nx * ny * nz - 1);
  expect_refused("short.nii", "is cut short: 4 x 3 x 2 voxels of int16 need 48 bytes, at most");
  write_nifti("long.nii", 0.5F, 1, nx * ny * nz + 1);
  expect_refused("long.nii", "holds more than the 48 bytes that 4 x 3 x 2 voxels of int16 need");
  write_nifti("scaled.nii", 0.5F, 2, nx * ny * nz);
  expect_refused("scaled.nii", "has values that are to be scaled by 2 and shifted by 0");
  write_nifti("flat.nii", 2, 1, nx * ny * nz);
  expect_refused("flat.nii", "has voxels of 0.5 x 0.5 x 2, but cells are cubes");
}

}  // namespace
}  // namespace koshi::io
