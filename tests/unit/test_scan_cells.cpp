// [body.scan]: raw files, images cut, turned, sorted by grey value and merged into cells.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>

#include "io/cell_image.h"
#include "io/connected_solids.h"
#include "koshi/input.h"
#include "koshi/model.h"
#include "material/mixture.h"
#include "support/temporary_directory.h"

namespace koshi::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

// A raw file of 4 x 3 x 2 voxels of type uint16, most significant byte first, behind three bytes; no two are alike.
constexpr int nx = 4, ny = 3, nz = 2;
int value(int i, int j, int k) { return 300 * k + 10 * j + i; }

class Scan : public testing::Test {
 protected:
  const test::TemporaryDirectory directory;

  Scan() {
    std::string bytes = "abc";
    for (int k = 0; k < nz; ++k)
      for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) {
          bytes += static_cast<char>(value(i, j, k) >> 8);
          bytes += static_cast<char>(value(i, j, k) & 255);
        }
    std::ofstream(directory / "scan.raw", std::ios::binary) << bytes;
    std::ofstream(directory / "bytes.raw", std::ios::binary) << std::string("\0\1\2\3\0\0\1\1", 8);
  }
  static constexpr const char* raw = "size = [4, 3, 2]\ntype = \"uint16\"\nbyte_order = \"big\"\noffset = 3\n";

  model::Definition load(const std::string& body, const std::string& scan, const char* spacing = "\"1 mm\"") const {
    return load_files(read_case_text(
        std::string("[lattice]\nspacing = ") + spacing +
            "\n[material.rock]\nyoungs_modulus = 1e9\npoissons_ratio = 0.2\ndensity = 2000\n[material.clay]\n"
            "youngs_modulus = 1e8\npoissons_ratio = 0.3\ndensity = 1000\n[body]\n" +
            body + "\n[body.scan]\n" + scan,
        (directory / "case.toml").native()));
  }
  void expect_refused(const std::string& body, const std::string& scan, const std::string& message,
                      const char* spacing = "\"1 mm\"") const {
    EXPECT_THAT([&] { load(body, scan, spacing); }, ThrowsMessage<InputError>(HasSubstr(message))) << scan;
  }
  // Materials that tell the values of scan.raw apart up to a class of thresholds.
  static constexpr const char* layers = "image = \"scan.raw\"\nmaterials = { 0 = \"clay\", 1 = \"rock\" }";
};

TEST_F(Scan, RawFilesAreWhatTheInputSays) {
  // Class 1: from the value 300 on, which is the upper layer.
  const model::Definition definition = load(layers, std::string(raw) + "thresholds = [300]\n");
  ASSERT_EQ(definition.body.cells.size(), 24u);
  for (std::size_t n = 0; n < 24; ++n) EXPECT_EQ(definition.body.cells[n], n < 12 ? 2 : 1) << n;
  EXPECT_NEAR(definition.body.size[0], 0.004, 1e-15);
  EXPECT_TRUE(definition.body.factors.empty());
  // Without the bytes before the values, or with other sizes, the file is too long or too short.
  expect_refused(layers, "size = [4, 3, 2]\ntype = \"uint16\"\nthresholds = [1]\n", "holds more than the 48 bytes");
  expect_refused(layers, "size = [4, 3, 3]\ntype = \"uint16\"\nthresholds = [1]\n", "is cut short: 4 x 3 x 3 voxels");
  expect_refused(layers, "size = [4, 3, 2]\noffset = 100\n",
                 "has 51 bytes, but its values are said to begin behind 100");
  expect_refused(layers, "coarsen = 1\n", "a raw file needs size, such as size = [512, 512, 400]");
  expect_refused("image = \"scan.npy\"\nmaterials = { 0 = \"clay\" }", "size = [1, 1, 1]\n",
                 "size, type, byte_order and offset tell what a raw file does not");
}

// The body's x runs against the image's z, y along its x, z along its y; of x the voxels 1 and 2 are kept.
TEST_F(Scan, ImagesAreCutAndTurned) {
  std::string thresholds = "thresholds = [", materials = "image = \"scan.raw\"\nmaterials = { 0 = \"void\"";
  // Every value is a class of its own; those of odd i are rock, of even i clay.
  int classes = 0;
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        thresholds += std::to_string(value(i, j, k) - 0.5) + ", ";
        materials += ", " + std::to_string(++classes) + " = \"" +
                     (j == 2                 ? "void"
                      : (i + 2 * k) % 3 == 0 ? "clay"
                                             : "rock") +
                     "\"";
      }
  const model::Definition definition =
      load(materials + " }", std::string(raw) + thresholds + "]\naxes = [\"-z\", \"x\", \"y\"]\n" +
                                 "crop = { min = [1, 0, 0], max = [3, 3, 2] }\n");
  std::vector<std::uint16_t> expected;
  for (int j = 0; j < ny; ++j)
    for (int i = 1; i < 3; ++i)
      for (int k = nz - 1; k >= 0; --k)
        expected.push_back(static_cast<std::uint16_t>(j == 2 ? 0 : (i + 2 * k) % 3 == 0 ? 2 : 1));
  EXPECT_EQ(definition.body.cells, expected);
  EXPECT_EQ(expected.size(), 12u);
  EXPECT_NEAR(definition.body.size[0], 0.002, 1e-15);
  EXPECT_NEAR(definition.body.size[2], 0.003, 1e-15);
}

// Eight voxels of the values 0 1 2 3 0 0 1 1 as one cell.
TEST_F(Scan, CellsOfSeveralVoxels) {
  const std::string body = "image = \"bytes.raw\"\nmaterials = ";
  const std::string scan = "size = [2, 2, 2]\ncoarsen = 2\n";
  // 3 voids, 3 of clay (1), 2 of rock: 5 of 8 are solid, and of these 3 in 5 or 9.6 sixteenths are clay.
  const std::string materials = R"({ 0 = "void", 1 = "clay", 2 = "rock", 3 = "rock" })";
  const model::Definition mixed = load(body + materials, scan);
  EXPECT_THAT(mixed.body.cells, ElementsAre(3));
  EXPECT_THAT(mixed.body.factors, ElementsAre(0.625F));
  EXPECT_THAT(mixed.body.mixtures, ElementsAre(model::Mixture{3, {1, 2}, 0.625}));
  ASSERT_EQ(mixed.materials.size(), 3u);
  EXPECT_EQ(mixed.materials[2].name, "rock with 10/16 clay");
  EXPECT_DOUBLE_EQ(mixed.materials[2].elastic.density, 1375);
  // The only cell is mostly clay, which so leads through the body: the rock lies in it.
  const material::Elastic &rock = mixed.materials[0].elastic, &clay = mixed.materials[1].elastic;
  EXPECT_EQ(mixed.materials[2].elastic, material::mixture(rock, clay, 0.625, rock));
  EXPECT_GT(material::mixture(rock, clay, 0.625, clay).youngs_modulus, 1.5 * mixed.materials[2].elastic.youngs_modulus);
  // The mass is that of the voxels: 3000 + 2 x 2000 eighths, an eighth of it at each corner.
  EXPECT_THAT(mixed.body.density_shares, ElementsAre(static_cast<float>(875.0 / 1375)));
  const model::Model model = model::make_model(mixed, Communicator::self());
  EXPECT_NEAR(model.inertia.component(0)[model.layout().index(0, 0, 0)], 875 * 1e-9 / 8, 1e-13);
  // The resolved input has the materials of the case alone, and files read twice make no more of them.
  EXPECT_THAT(resolved_toml(mixed), Not(HasSubstr("10/16")));
  EXPECT_EQ(load_files(mixed), mixed);
  // Nor do the image's factors become a file beside it, which would multiply them once more.
  EXPECT_TRUE(with_cells_in_file(Communicator::self(), mixed, directory / "").body.factor.empty());
  // What scatters or cracks is not mixed: the solid with most voxels has the cell, of as many the first of the input.
  const std::string scatter = "[material.clay.stiffness_scatter]\ndistribution = \"normal\"\nvariation = 0.1\n";
  const std::string crack = "[material.rock.fracture]\ntensile_strength = \"3 MPa\"\nfracture_energy = \"100 J/m^2\"\n";
  for (const std::string& what : {scatter, crack}) {
    const model::Definition plain = load(body + materials, scan + what);
    EXPECT_THAT(plain.body.cells, ElementsAre(2)) << what;
    EXPECT_THAT(plain.body.density_shares, ElementsAre(0.625F));
    EXPECT_TRUE(plain.body.mixtures.empty());
    const std::string even = R"({ 0 = "clay", 1 = "rock", 2 = "void", 3 = "void" })";
    EXPECT_THAT(load(body + even, scan + what).body.cells, ElementsAre(1));
  }
  EXPECT_THAT(load(body + materials, scan + "[body.grain_boundary]\nmaterial = \"clay\"\n").body.cells, ElementsAre(2));
  // Of three solids the two with most voxels share the cell; nothing solid: void, and no factor of zero.
  const model::Definition three =
      load(body + R"({ 0 = "rock", 1 = "clay", 2 = "sand", 3 = "sand" })",
           scan + "[material.sand]\nyoungs_modulus = 1e8\npoissons_ratio = 0.3\ndensity = 1000\n");
  EXPECT_THAT(three.body.mixtures, ElementsAre(model::Mixture{4, {1, 2}, 0.5}));
  EXPECT_THAT(load(body + R"({ 0 = "void", 1 = "void", 2 = "void", 3 = "void" })", scan).body.factors,
              ElementsAre(1.0F));
  expect_refused(layers, std::string(raw) + "thresholds = [300]\ncoarsen = 2\n",
                 "there are 4 x 3 x 2 voxels, but cells of 2 voxels along an edge need multiples of 2; crop the image");
  expect_refused("image = \"bytes.raw\"\nmaterials = { 0 = \"void\" }", "size = [2, 2, 2]\nthresholds = [0.5, 2]\n",
                 "the image also has the values 1, 2 by its thresholds");
}

// Where two solids are alike in that, the inclusion is made of both: in two cells side by side, mostly rock and mostly
// clay, each leads through along y and z.
TEST_F(Scan, MixturesOfSolidsThatLeadThroughAlike) {
  // Rows of four voxels: 2, 2 | 1, 1 but for one of each in the other cell.
  std::ofstream(directory / "pair.raw", std::ios::binary) << std::string("\2\2\1\1\2\2\1\1\2\1\2\1\2\2\1\1", 16);
  const model::Definition pair =
      load("image = \"pair.raw\"\nmaterials = { 1 = \"clay\", 2 = \"rock\" }", "size = [4, 2, 2]\ncoarsen = 2\n");
  const material::Elastic &rock = pair.materials[0].elastic, &clay = pair.materials[1].elastic;
  EXPECT_THAT(pair.body.cells, ElementsAre(3, 4));
  EXPECT_THAT(pair.body.mixtures, ElementsAre(model::Mixture{3, {1, 2}, 0.125}, model::Mixture{4, {1, 2}, 0.875}));
  const material::Elastic both = material::geometric_mean(rock, clay, 0.5);
  EXPECT_EQ(pair.materials[2].elastic, material::mixture(rock, clay, 0.125, both));
  EXPECT_EQ(pair.materials[3].elastic, material::mixture(rock, clay, 0.875, both));
}

TEST(ConnectedSolids, LeadThroughAlongAxes) {
  // Two layers of 3 x 2 cells: 1 leads along x and z, by a bend; 2 along y, in one part of two; 3 nowhere.
  const std::vector<std::uint16_t> cells{1, 1, 2, 3, 0, 2,  //
                                         1, 1, 1, 0, 2, 3};
  const std::map<std::uint16_t, int> expected{{1, 2}, {2, 1}};
  EXPECT_EQ(directions_through(cells, {3, 2, 2}), expected);
}

// Linear between the grey values, constant beyond; E goes with the density to the power.
TEST_F(Scan, GreyValuesAreDensities) {
  const model::Definition bone =
      load("image = \"bytes.raw\"\nmaterial = \"rock\"",
           "size = [8, 1, 1]\ngrey = [0, 2, 2.5]\ndensity = [0, 1000, 2000]\nexponent = 2\n");
  EXPECT_THAT(bone.body.cells, ElementsAre(0, 1, 1, 1, 0, 0, 1, 1));
  EXPECT_THAT(bone.body.density_shares, ElementsAre(1, 0.25F, 0.5F, 1, 1, 1, 0.25F, 0.25F));
  EXPECT_THAT(bone.body.factors, ElementsAre(1, 0.0625F, 0.25F, 1, 1, 1, 0.0625F, 0.0625F));
  // A cell of all eight has the mean grey value of 1.
  const model::Definition coarse = load("image = \"bytes.raw\"\nmaterial = \"rock\"",
                                        "size = [2, 2, 2]\ncoarsen = 2\ngrey = [0, 4]\ndensity = [0, 2000]\n");
  EXPECT_THAT(coarse.body.factors, ElementsAre(0.25F));
  const std::string body = "image = \"bytes.raw\"\nmaterial = \"rock\"", size = "size = [8, 1, 1]\n";
  expect_refused(body, size + "grey = [0, 1]\ndensity = [0]\n", "grey has 2 values, density has 1");
  expect_refused(body, size + "grey = [1, 0]\ndensity = [0, 1]\n", "grey has 0 after 1; list the values in ascending");
  expect_refused(body, size + "grey = [0, 1]\ndensity = [0, 2001]\n",
                 "density has 2001 kg/m^3, but the material \"rock\"");
  expect_refused(body, size + "grey = [0, 1]\ndensity = [0, 1]\nthresholds = [1]\n",
                 "thresholds make materials of grey values");
}

TEST_F(Scan, TheSpacingOfTheImage) {
  std::ofstream(directory / "scan.mhd") << "ObjectType = Image\nNDims = 3\nDimSize = 2 2 2\nElementSpacing = 0.5 0.5 "
                                           "0.5\nElementType = MET_UCHAR\nElementDataFile = bytes.raw\n";
  const std::string body =
      "image = \"scan.mhd\"\nmaterials = { 0 = \"void\", 1 = \"clay\", 2 = \"rock\", 3 = \"rock\" }";
  const model::Definition definition = load(body, "unit = \"1 um\"\ncoarsen = 2\n", "\"image\"");
  EXPECT_NEAR(definition.lattice.spacing, 1e-6, 1e-18);
  EXPECT_NEAR(definition.body.size[1], 1e-6, 1e-18);
  expect_refused(body, "unit = \"1 um\"\n", "the unit of the voxels counts for spacing = \"image\"");
  expect_refused(body, "coarsen = 2\n", "give an image and its unit, such as scan = { unit = \"1 um\" }", "\"image\"");
  expect_refused("image = \"bytes.raw\"\nmaterials = { 0 = \"void\" }",
                 "size = [8, 1, 1]\nunit = 1\nthresholds = [9]\n", "the image does not say how large its voxels are",
                 "\"image\"");
}

TEST_F(Scan, WhatIsWrongIsSaid) {
  const std::string rest = raw;
  expect_refused(layers, rest + "crop = { min = [0, 0, 0], max = [5, 3, 2] }\nthresholds = [1]\n",
                 "crop goes to voxel 5 along x, but the image has 4 x 3 x 2");
  expect_refused(layers, rest + "crop = { min = [2, 0, 0], max = [2, 3, 2] }\n", "crop keeps nothing along x");
  expect_refused(layers, rest + "crop = { min = [0.5, 0, 0], max = [2, 3, 2] }\n",
                 ": error: min has 0.5, but voxels are counted by whole numbers");
  expect_refused(layers, rest + "axes = [\"x\", \"-x\", \"y\"]\n", "axes has x, -x, y; it takes each of x, y, z once");
  expect_refused(layers, rest + "axes = [\"x\", \"y\"]\n", "axes has x, y; it takes each of x, y, z once");
  expect_refused("size = [1, 1, 1]\nmaterial = \"rock\"", "coarsen = 2\n", "scan says how an image becomes cells");
  expect_refused("image = \"scan.h5\"\nmaterials = { 0 = \"void\" }", "coarsen = 2\n",
                 "\"scan.h5\" is an HDF5 file, which Koshi does not read; save its data set by itself");
}

}  // namespace
}  // namespace koshi::io
