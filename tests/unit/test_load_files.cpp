// Bodies from image files, regions from surfaces: what is read, and what is refused.
#include <bzlib.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkMetaImageWriter.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkXMLImageDataWriter.h>
#include <zlib.h>

#include <fstream>

#include "koshi/input.h"
#include "support/temporary_directory.h"

namespace koshi::io {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

// 4 x 3 x 2 cells with the values 7 (void), -2 ("soft"), 300 ("hard"), no two axes alike.
constexpr int nx = 4, ny = 3, nz = 2;
int value(int i, int j, int k) { return i == 0 ? 7 : (j + 2 * k + i) % 3 == 0 ? -2 : 300; }
std::vector<std::uint16_t> expected_cells() {
  std::vector<std::uint16_t> cells;
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) cells.push_back(value(i, j, k) == 7 ? 0 : value(i, j, k) == -2 ? 1 : 2);
  return cells;
}

class LoadFilesTest : public testing::Test {
 protected:
  const test::TemporaryDirectory directory;

  model::Definition read(const std::string& body, const std::string& rest = "") const {
    return read_case_text(R"([lattice]
spacing = "1 mm"
[material.soft]
youngs_modulus = 1e6
poissons_ratio = 0.2
density = 1000
[material.hard]
youngs_modulus = 1e9
poissons_ratio = 0.2
density = 1000
[body]
)" + body + "\n" + rest,
                          (directory / "case.toml").native());
  }
  model::Definition read_image(const std::string& file) const {
    return read("image = \"" + file + R"("
materials = { 7 = "void", -2 = "soft", 300 = "hard" })");
  }
  void expect_image(const std::string& file) const {
    SCOPED_TRACE(file);
    const model::Definition loaded = load_files(read_image(file));
    EXPECT_EQ(loaded.body.cells, expected_cells());
    EXPECT_NEAR(loaded.body.size[0], 0.004, 1e-15);
    EXPECT_NEAR(loaded.body.size[1], 0.003, 1e-15);
    EXPECT_NEAR(loaded.body.size[2], 0.002, 1e-15);
  }
  void expect_refused(const std::string& file, const std::string& message) const {
    SCOPED_TRACE(file);
    EXPECT_THAT([&] { load_files(read_image(file)); },
                ThrowsMessage<InputError>(testing::AllOf(
                    HasSubstr("case.toml:12:9: error: the file \"" + (directory / file).native() + "\" " + message))));
  }
  void write(const std::string& file, const std::string& bytes) const { std::ofstream(directory / file) << bytes; }

  // Version 1 of the NumPy format.
  static std::string npy_header(const std::string& dictionary) {
    std::string header = dictionary;
    header.resize(118 - 1, ' ');
    return std::string("\x93NUMPY\x01\x00\x76\x00", 10) + header + "\n";
  }
  template <class T>
  void write_npy(const std::string& file, const std::string& descr, bool fortran) const {
    std::string bytes = npy_header("{'descr': '" + descr + "', 'fortran_order': " + (fortran ? "True" : "False") +
                                   ", 'shape': (2, 3, 4), }");
    const auto add = [&](int i, int j, int k) {
      const T v = static_cast<T>(value(i, j, k));
      std::string raw(reinterpret_cast<const char*>(&v), sizeof v);
      if (descr[0] == '>') std::reverse(raw.begin(), raw.end());
      bytes += raw;
    };
    // [z][y][x]: the last index runs fastest in C order, the first in Fortran order.
    if (fortran)
      for (int i = 0; i < nx; ++i)
        for (int j = 0; j < ny; ++j)
          for (int k = 0; k < nz; ++k) add(i, j, k);
    else
      for (int k = 0; k < nz; ++k)
        for (int j = 0; j < ny; ++j)
          for (int i = 0; i < nx; ++i) add(i, j, k);
    write(file, bytes);
  }

  template <class Array>
  static void fill(vtkNew<Array>& array, const char* name) {
    array->SetName(name);
    for (int k = 0; k < nz; ++k)
      for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) array->InsertNextValue(value(i, j, k));
  }
  void write_vti(const std::string& file, vtkImageData* image) const {
    vtkNew<vtkXMLImageDataWriter> writer;
    writer->SetFileName((directory / file).c_str());
    writer->SetInputData(image);
    writer->Write();
  }
};

TEST_F(LoadFilesTest, NumPyFilesOfEveryIntegerType) {
  write_npy<std::int16_t>("a.npy", "<i2", false);
  write_npy<std::int32_t>("b.npy", "<i4", false);
  write_npy<std::int64_t>("c.npy", "<i8", false);
  write_npy<std::int16_t>("d.npy", ">i2", false);
  write_npy<std::int64_t>("e.npy", "<i8", true);
  for (const char* file : {"a.npy", "b.npy", "c.npy", "d.npy", "e.npy"}) expect_image(file);
}

TEST_F(LoadFilesTest, NumPyFilesOfUnsignedTypesAndBool) {
  for (const auto& [descr, size] : std::vector<std::pair<std::string, int>>{
           {"|b1", 1}, {"|u1", 1}, {"|i1", 1}, {"<u2", 2}, {"<u4", 4}, {"<u8", 8}}) {
    SCOPED_TRACE(descr);
    std::string bytes = npy_header("{'descr': '" + descr + "', 'fortran_order': False, 'shape': (1, 1, 3), }");
    for (const int v : {1, 0, 1}) bytes += std::string(1, static_cast<char>(v)) + std::string(size - 1, '\0');
    write("mask.npy", bytes);
    const auto loaded = load_files(read(R"(image = "mask.npy"
materials = { 0 = "void", 1 = "hard" })"));
    EXPECT_EQ(loaded.body.cells, (std::vector<std::uint16_t>{2, 0, 2}));
  }
}

TEST_F(LoadFilesTest, ImagesThroughVtk) {
  vtkNew<vtkImageData> cells;
  cells->SetDimensions(nx + 1, ny + 1, nz + 1);
  vtkNew<vtkIntArray> values;
  fill(values, "anything");
  cells->GetCellData()->AddArray(values);
  write_vti("only.vti", cells);
  // Koshi's own files carry more arrays; the one called "material" counts.
  values->SetName("material");
  vtkNew<vtkDoubleArray> other;
  fill(other, "strain");
  cells->GetCellData()->AddArray(other);
  write_vti("named.vti", cells);

  vtkNew<vtkImageData> voxels;
  voxels->SetDimensions(nx, ny, nz);
  voxels->GetPointData()->SetScalars(values);
  vtkNew<vtkMetaImageWriter> meta;
  meta->SetInputData(voxels);
  meta->SetFileName((directory / "scan.mha").c_str());
  meta->Write();
  meta->SetFileName((directory / "scan.mhd").c_str());
  meta->SetRAWFileName((directory / "scan.raw").c_str());
  meta->Write();

  std::string nrrd =
      "NRRD0004\ntype: int\ndimension: 3\nsizes: 4 3 2\nkinds: domain domain domain\nencoding: raw\nendian: little\n\n";
  nrrd.append(reinterpret_cast<const char*>(values->GetPointer(0)), nx * ny * nz * sizeof(int));
  write("scan.nrrd", nrrd);
  for (const char* file : {"only.vti", "named.vti", "scan.mha", "scan.mhd", "scan.nrrd"}) expect_image(file);
}

// Every way in which VTK stores the values of an image.
TEST_F(LoadFilesTest, VtkImagesInEveryEncoding) {
  vtkNew<vtkImageData> cells;
  cells->SetExtent(2, 2 + nx, -1, ny - 1, 0, nz);
  vtkNew<vtkIntArray> values;
  fill(values, "material");
  cells->GetCellData()->AddArray(values);
  vtkNew<vtkDoubleArray> other;
  fill(other, "strain");
  cells->GetCellData()->AddArray(other);
  int count = 0;
  for (const int mode : {vtkXMLWriter::Ascii, vtkXMLWriter::Binary, vtkXMLWriter::Appended})
    for (const bool compressed : {false, true})
      for (const bool encoded : {false, true})
        for (const int order : {vtkXMLWriter::LittleEndian, vtkXMLWriter::BigEndian})
          for (const int header : {vtkXMLWriter::UInt32, vtkXMLWriter::UInt64}) {
            vtkNew<vtkXMLImageDataWriter> writer;
            const std::string file = fmt::format("{}.vti", count++);
            writer->SetFileName((directory / file).c_str());
            writer->SetInputData(cells);
            writer->SetDataMode(mode);
            if (!compressed) writer->SetCompressorTypeToNone();
            writer->SetBlockSize(64);  // of 96 bytes
            writer->SetEncodeAppendedData(encoded);
            writer->SetByteOrder(order);
            writer->SetHeaderType(header);
            ASSERT_EQ(writer->Write(), 1);
            expect_image(file);
          }
  EXPECT_EQ(count, 48);
}

// The values of value() as 16-bit numbers.
std::string shorts(bool big_endian) {
  std::string bytes;
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        const auto v = static_cast<std::uint16_t>(value(i, j, k));
        const char low = static_cast<char>(v & 0xff), high = static_cast<char>(v >> 8);
        bytes += big_endian ? high : low;
        bytes += big_endian ? low : high;
      }
  return bytes;
}

std::string deflated(const std::string& bytes) {
  std::string packed(1000, '\0');
  uLongf size = packed.size();
  compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
  return packed.substr(0, size);
}

TEST_F(LoadFilesTest, MetaImagesCompressedDetachedAndBigEndian) {
  const std::string head =
      "ObjectType = Image\nNDims = 3\nDimSize = 4 3 2\nElementSpacing = 0.5 0.5 0.5\nElementType = MET_SHORT\n";
  const std::string packed = deflated(shorts(false));
  write("big.mha", head + "ElementByteOrderMSB = True\nElementDataFile = LOCAL\n" + shorts(true));
  write("packed.mha", head + "CompressedData = True\nElementDataFile = LOCAL\n" + packed);
  write("packed.mhd",
        head + fmt::format("CompressedData = True\nCompressedDataSize = {}\nElementDataFile = packed.zraw\n",
                           packed.size()));
  write("packed.zraw", packed);
  write("skipped.mhd", head + "HeaderSize = 5\nElementDataFile = skipped.raw\n");
  write("last.mhd", head + "HeaderSize = -1\nElementDataFile = skipped.raw\n");
  write("skipped.raw", "12345" + shorts(false));
  for (const char* file : {"big.mha", "packed.mha", "packed.mhd", "skipped.mhd", "last.mhd"}) expect_image(file);
  write("wrong.mhd", head + "CompressedData = True\nCompressedDataSize = 99999999999\nElementDataFile = packed.zraw\n");
  expect_refused("wrong.mhd",
                 fmt::format("names the data file \"packed.zraw\", which has {} bytes of compressed values, but "
                             "its header asks for 99999999999",
                             packed.size()));
  write("behind.mhd", head + "HeaderSize = 500\nElementDataFile = skipped.raw\n");
  expect_refused("behind.mhd", "names the data file \"skipped.raw\", which has 53 bytes, fewer than HeaderSize");
}

TEST_F(LoadFilesTest, NrrdImagesCompressedDetachedAndBigEndian) {
  const std::string head = "NRRD0005\n# a comment\ntype: int16\ndimension: 3\nsizes: 4 3 2\nowner:=nobody: me\n";
  write("big.nrrd", head + "endian: big\nencoding: raw\n\n" + shorts(true));
  write("gzip.nrrd", head + "endian: little\nencoding: gzip\n\n" + deflated(shorts(false)));
  std::string packed(1000, '\0');
  auto size = static_cast<unsigned>(packed.size());
  std::string bytes = shorts(false);
  ASSERT_EQ(BZ2_bzBuffToBuffCompress(packed.data(), &size, bytes.data(), static_cast<unsigned>(bytes.size()), 9, 0, 0),
            BZ_OK);
  write("bzip2.nrrd", head + "endian: little\nencoding: bzip2\n\n" + packed.substr(0, size));
  write("detached.nhdr", head + "endian: little\nencoding: raw\nbyte skip: 3\ndata file: detached.raw\n");
  write("last.nhdr", head + "endian: little\nencoding: raw\nbyteskip: -1\ndatafile: detached.raw\n\n");
  write("detached.raw", "123" + shorts(false));
  // An axis of one value beside the three of space.
  write("scalar.nrrd",
        "NRRD0005\ntype: int16\ndimension: 4\nsizes: 1 4 3 2\nendian: little\nencoding: raw\n\n" + shorts(false));
  for (const char* file : {"big.nrrd", "gzip.nrrd", "bzip2.nrrd", "detached.nhdr", "last.nhdr", "scalar.nrrd"})
    expect_image(file);
  write("cut.nrrd", head + "endian: little\nencoding: bzip2\n\n" + packed.substr(0, size - 1));
  expect_refused("cut.nrrd", "has compressed values that are cut short");
  write("more.nrrd", head + "endian: little\nencoding: bzip2\n\n" + packed.substr(0, size) + "x");
  expect_refused("more.nrrd", "has other bytes behind its compressed values");
  write("colours.nrrd",
        "NRRD0005\ntype: uchar\ndimension: 3\nsizes: 3 4 2\nkinds: RGB-color domain domain\nencoding: raw\n\n" +
            shorts(false));
  expect_refused("colours.nrrd", "has kinds: \"RGB-color domain domain\"; expected domain or space; one value a voxel");
  write("flat.nrrd", head + "spacings: 1 1 2\nendian: little\nencoding: raw\n\n" + shorts(false));
  expect_refused("flat.nrrd",
                 "has voxels of 1 x 1 x 2, but cells are cubes; resample it to voxels of one side first, such "
                 "as with scipy.ndimage.zoom by 1, 1, 2 along x, y, z");
}

TEST_F(LoadFilesTest, WrongImagesAreRefusedAtTheirKey) {
  expect_refused("missing.npy", "cannot be opened (No such file or directory)");
  std::filesystem::create_directory(directory / "folder.npy");
  expect_refused("folder.npy", "is a folder");
  write("text.npy", "hello, world, hello");
  expect_refused("text.npy", "is no NumPy file");
  write("real.npy", npy_header("{'descr': '<f8', 'fortran_order': False, 'shape': (1, 1, 1), }") + "12345678");
  expect_refused("real.npy", "holds values of the type float64, not whole numbers");
  write("half.npy", npy_header("{'descr': '<f2', 'fortran_order': False, 'shape': (1, 1, 1), }") + "12");
  expect_refused("half.npy", "holds values of the type \"'<f2'\", no numbers of 1 to 8 bytes");
  write("flat.npy", npy_header("{'descr': '|u1', 'fortran_order': False, 'shape': (2, 2), }") + "1234");
  expect_refused("flat.npy", "has the shape (2, 2); expected three axes, [z][y][x]");
  write("short.npy", npy_header("{'descr': '|u1', 'fortran_order': False, 'shape': (2, 2, 2), }") + "1234567");
  expect_refused("short.npy", "is cut short: 2 x 2 x 2 voxels of uint8 need 8 bytes, at most 7 are there");
  write("none.npy", npy_header("{'descr': '|u1', 'fortran_order': False, 'shape': (0, 2, 2), }"));
  expect_refused("none.npy", "has the shape (0, 2, 2) and hence no cells");
  write("text.vti", "hello");
  expect_refused("text.vti", "is no XML: ");
  write("text.mha", "hello");
  expect_refused("text.mha", "is not a MetaImage");
  write("text.nrrd", "hello");
  expect_refused("text.nrrd", "is not an NRRD image");
  write("short.nrrd",
        "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 4 3 2\nkinds: domain domain domain\nencoding: raw\n\n12345");
  expect_refused("short.nrrd", "is cut short: 4 x 3 x 2 voxels of uint8 need 24 bytes, at most 5 are there");
  write("ascii.nrrd", "NRRD0004\r\ntype: uchar\r\ndimension: 3\r\nsizes: 3 1 1\r\nencoding: ascii\r\n\r\n1 1 1");
  expect_refused("ascii.nrrd", "has encoding: \"ascii\"; expected \"raw\", \"gzip\" or \"bzip2\"");
  write("short.mha",
        "ObjectType = Image\nNDims = 3\nBinaryData = True\nDimSize = 4 3 2\nElementType = MET_UCHAR\nElementDataFile = "
        "LOCAL\n12345");
  expect_refused("short.mha", "is cut short: 4 x 3 x 2 voxels of uint8 need 24 bytes, at most 5 are there");

  vtkNew<vtkImageData> points;
  points->SetDimensions(nx, ny, nz);
  vtkNew<vtkIntArray> values;
  fill(values, "value");
  points->GetPointData()->SetScalars(values);
  write_vti("points.vti", points);
  expect_refused("points.vti", "holds values on points, but a cell needs one value");
  vtkNew<vtkImageData> reals;
  reals->SetDimensions(nx + 1, ny + 1, nz + 1);
  vtkNew<vtkDoubleArray> real_values;
  fill(real_values, "value");
  reals->GetCellData()->AddArray(real_values);
  write_vti("reals.vti", reals);
  expect_refused("reals.vti", "holds values of the type float64, not whole numbers");
}

TEST_F(LoadFilesTest, ValuesWithoutMaterialAreListed) {
  write_npy<std::int16_t>("a.npy", "<i2", false);
  const std::string body = "image = \"a.npy\"\nmaterials = { 300 = \"hard\" }";
  EXPECT_THAT(
      [&] { load_files(read(body)); },
      ThrowsMessage<InputError>(HasSubstr(
          "case.toml:13:13: error: the image also has the values -2, 7; name a material, or \"void\", for each")));
}

TEST_F(LoadFilesTest, SizeOfAProgramMustFit) {
  write_npy<std::int16_t>("a.npy", "<i2", false);
  model::Definition definition = read_image("a.npy");
  definition.body.size = {0.004, 0.003, 0.002};
  EXPECT_EQ(load_files(definition).body.cells.size(), 24u);
  definition.body.size = {0.004, 0.003, 0.003};
  EXPECT_THAT([&] { load_files(definition); }, ThrowsMessage<InputError>(HasSubstr("the image has 4 x 3 x 2 cells")));
}

}  // namespace
}  // namespace koshi::io
