// Bodies from image files, regions from surfaces: what is read, and what is refused.
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

#include <fstream>
#include <numbers>
#include <numeric>

#include "io/files.h"
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

TEST_F(LoadFilesTest, WrongImagesAreRefusedAtTheirKey) {
  expect_refused("missing.npy", "cannot be opened (No such file or directory)");
  std::filesystem::create_directory(directory / "folder.npy");
  expect_refused("folder.npy", "is a folder");
  write("text.npy", "hello, world, hello");
  expect_refused("text.npy", "is no NumPy file");
  write("real.npy", npy_header("{'descr': '<f8', 'fortran_order': False, 'shape': (1, 1, 1), }") + "12345678");
  expect_refused("real.npy", "holds values of the type '<f8', not whole numbers");
  write("flat.npy", npy_header("{'descr': '|u1', 'fortran_order': False, 'shape': (2, 2), }") + "1234");
  expect_refused("flat.npy", "has the shape (2, 2); expected three axes, [z][y][x]");
  write("short.npy", npy_header("{'descr': '|u1', 'fortran_order': False, 'shape': (2, 2, 2), }") + "1234567");
  expect_refused("short.npy", "is not as long as its shape (2, 2, 2) asks for; it may be cut short");
  write("none.npy", npy_header("{'descr': '|u1', 'fortran_order': False, 'shape': (0, 2, 2), }"));
  expect_refused("none.npy", "has the shape (0, 2, 2) and hence no cells");
  write("text.vti", "hello");
  expect_refused("text.vti", "is not a VTK image");
  write("text.mha", "hello");
  expect_refused("text.mha", "is not a MetaImage");
  write("text.nrrd", "hello");
  expect_refused("text.nrrd", "is not an NRRD image");
  write("short.nrrd",
        "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 4 3 2\nkinds: domain domain domain\nencoding: raw\n\n12345");
  expect_refused("short.nrrd", "cannot be read as an NRRD image: File operation failed");
  write("ascii.nrrd", "NRRD0004\r\ntype: uchar\r\ndimension: 3\r\nsizes: 3 1 1\r\nencoding: ascii\r\n\r\n1 1 1");
  expect_refused("ascii.nrrd", "has the encoding \"ascii\"; save it as \"raw\" or \"gzip\"");
  write("short.mha",
        "ObjectType = Image\nNDims = 3\nBinaryData = True\nDimSize = 4 3 2\nElementType = MET_UCHAR\nElementDataFile = "
        "LOCAL\n12345");
  expect_refused("short.mha", "cannot be read as a MetaImage");

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
  expect_refused("reals.vti", "holds values of the type double, not whole numbers");
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

using Triangle = std::array<Vec3, 3>;

// Triangles of a closed surface over a rectangle of parameters, `rows` x `columns` quadrangles wide; those that shrink
// to a line are left out.
std::vector<Triangle> surface_of(int rows, int columns, const std::function<Vec3(int, int)>& point) {
  std::vector<Triangle> triangles;
  const auto add = [&](const Triangle& t) {
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) triangles.push_back(t);
  };
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      const Vec3 a = point(r, c), b = point(r + 1, c), x = point(r, (c + 1) % columns),
                 y = point(r + 1, (c + 1) % columns);
      add({a, b, y});
      add({a, y, x});
    }
  return triangles;
}

// A box as a surface of revolution with four sides: from one pole over the lower and upper corners to the other.
std::vector<Triangle> box_surface(const Vec3& lo, const Vec3& hi) {
  return surface_of(3, 4, [=](int row, int side) -> Vec3 {
    const double z = row < 2 ? lo[2] : hi[2];
    if (row == 0 || row == 3) return {0.5 * (lo[0] + hi[0]), 0.5 * (lo[1] + hi[1]), z};
    return {side == 0 || side == 3 ? lo[0] : hi[0], side < 2 ? lo[1] : hi[1], z};
  });
}

std::vector<Triangle> sphere_surface(const Vec3& center, double radius) {
  return surface_of(60, 60, [=](int row, int side) -> Vec3 {
    if (row == 0 || row == 60) return center + Vec3{0, 0, row == 0 ? -radius : radius};
    const double theta = std::numbers::pi * row / 60, phi = 2 * std::numbers::pi * side / 60;
    return center + radius * Vec3{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), -std::cos(theta)};
  });
}

class SurfaceTest : public LoadFilesTest {
 protected:
  void write_stl(const std::string& file, const std::vector<Triangle>& triangles) const {
    std::string text = "solid test\n";
    for (const Triangle& triangle : triangles) {
      text += "facet normal 0 0 0\nouter loop\n";
      for (const Vec3& x : triangle) text += fmt::format("vertex {:.9g} {:.9g} {:.9g}\n", x[0], x[1], x[2]);
      text += "endloop\nendfacet\n";
    }
    write(file, text + "endsolid test\n");
  }
  model::Definition with_region(const std::string& file, const std::string& scale = "1 mm") const {
    return read(
        "origin = [\"-1 mm\", 0, 0]\nsize = [\"8 mm\", \"6 mm\", \"10 mm\"]\nmaterial = \"soft\"",
        "[[region]]\nshape = \"stl\"\nfile = \"" + file + "\"\nscale = \"" + scale + "\"\nmaterial = \"hard\"\n");
  }
};

TEST_F(SurfaceTest, BoxHoldsTheCellsOfTheSameBoxRegion) {
  write_stl("box.stl", box_surface({0.8, 1.9, 2.6}, {4.2, 3.1, 8.4}));  // mm
  const auto inside = load_files(with_region("box.stl")).regions[0].inside;
  ASSERT_EQ(inside.size(), 8u * 6 * 10);
  // Cell (i, j, k) has its centre at (-0.5 + i, 0.5 + j, 0.5 + k) mm.
  int count = 0;
  for (int k = 0; k < 10; ++k)
    for (int j = 0; j < 6; ++j)
      for (int i = 0; i < 8; ++i) {
        const double x = -0.5 + i, y = 0.5 + j, z = 0.5 + k;
        const bool in = x > 0.8 && x < 4.2 && y > 1.9 && y < 3.1 && z > 2.6 && z < 8.4;
        count += in;
        ASSERT_EQ(inside[static_cast<std::size_t>(i + 8 * (j + 6 * k))], in) << i << ' ' << j << ' ' << k;
      }
  EXPECT_EQ(count, 3 * 1 * 5);  // x: 1.5 2.5 3.5; y: 2.5; z: 3.5 ... 7.5
}

TEST_F(SurfaceTest, SphereHasItsVolumeInAnotherUnit) {
  write_stl("sphere.stl", sphere_surface({0.3, 0.3, 0.5}, 0.25));  // cm
  const auto inside = load_files(with_region("sphere.stl", "1 cm")).regions[0].inside;
  // 4/3 pi 2.5^3 = 65.4 cells of 1 mm^3; counted on centres x = -0.5 + i etc. with |x - c| < 2.5 mm.
  int count = 0;
  for (int k = 0; k < 10; ++k)
    for (int j = 0; j < 6; ++j)
      for (int i = 0; i < 8; ++i) count += std::hypot(-0.5 + i - 3, 0.5 + j - 3, 0.5 + k - 5) < 2.49;
  EXPECT_EQ(std::accumulate(inside.begin(), inside.end(), 0), count);
  EXPECT_GT(count, 50);
}

TEST_F(SurfaceTest, OpenSurfaceAndOthersAreRefused) {
  std::vector<Triangle> box = box_surface({1, 1, 1}, {4, 4, 4});
  box.erase(box.begin() + 3);
  write_stl("open.stl", box);
  EXPECT_THAT([&] { load_files(with_region("open.stl")); },
              ThrowsMessage<InputError>(testing::AllOf(HasSubstr("case.toml:17:8: error:"),
                                                       HasSubstr("is no closed surface: 3 of its edges"))));
  write("text.stl", "hello");
  EXPECT_THAT([&] { load_files(with_region("text.stl")); }, ThrowsMessage<InputError>(HasSubstr("text.stl\" ")));
  EXPECT_THAT([&] { load_files(with_region("none.stl")); }, ThrowsMessage<InputError>(HasSubstr("cannot be opened")));
  write_stl("box.stl", box_surface({1, 1, 1}, {4, 4, 4}));
  EXPECT_THAT([&] { load_files(with_region("box.stl", "1 m")); },
              ThrowsMessage<InputError>(HasSubstr(
                  "holds no cell's centre: it reaches from (1, 1, 1) to (4, 4, 4) m; check scale and origin")));
}

}  // namespace
}  // namespace koshi::io
