// Factors on the stiffness of cells: what files are read, what is refused, and where they go.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <complex>
#include <fstream>

#include "koshi/input.h"
#include "koshi/model.h"
#include "support/temporary_directory.h"

namespace koshi::io {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

class FactorsTest : public testing::Test {
 protected:
  const test::TemporaryDirectory directory;

  // 4 x 3 x 2 cells.
  model::Definition read(const std::string& factor, const std::string& lattice = "") const {
    return read_case_text(R"([lattice]
spacing = "1 mm"
)" + lattice + R"(
[material.rock]
youngs_modulus = 1e9
poissons_ratio = 0.2
density = 1000
[body]
size = ["4 mm", "3 mm", "2 mm"]
material = "rock"
factor = ")" + factor + "\"\n",
                          (directory / "case.toml").native());
  }
  // A NumPy file with the values 0, 1/32, 2/32 ..., which single precision has exactly.
  template <class T>
  void write(const std::string& file, const std::string& descr, const Int3& shape, T scale) const {
    std::string header = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}, {}, {}), }}", descr,
                                     shape[2], shape[1], shape[0]);
    header.resize(118 - 1, ' ');
    std::string bytes = std::string("\x93NUMPY\x01\x00\x76\x00", 10) + header + "\n";
    for (int n = 0; n < shape[0] * shape[1] * shape[2]; ++n) {
      const T v = static_cast<T>(n) * scale;
      bytes.append(reinterpret_cast<const char*>(&v), sizeof v);
    }
    std::ofstream(directory / file) << bytes;
  }
  void expect_refused(const model::Definition& definition, const std::string& message) const {
    EXPECT_THAT([&] { model::make_model(load_files(definition), Communicator::world()); },
                ThrowsMessage<InputError>(HasSubstr("case.toml:11:10: error: " + message)));
  }
};

TEST_F(FactorsTest, NumPyFilesOfFractionsAndWholeNumbers) {
  write<float>("single.npy", "<f4", {4, 3, 2}, 1.0f / 32);
  write<double>("twofold.npy", "<f8", {4, 3, 2}, 1.0 / 32);
  for (const char* file : {"single.npy", "twofold.npy"}) {
    const model::Definition loaded = load_files(read(file));
    ASSERT_EQ(loaded.body.factors.size(), 24u);
    for (std::size_t n = 0; n < 24; ++n) EXPECT_EQ(loaded.body.factors[n], static_cast<float>(n) / 32);
  }
  write<std::uint8_t>("whole.npy", "|u1", {4, 3, 2}, 0);
  EXPECT_EQ(load_files(read("whole.npy")).body.factors, std::vector<float>(24, 0.0f));
}

TEST_F(FactorsTest, GoToTheLatticeAndNotToTheMass) {
  write<float>("f.npy", "<f4", {4, 3, 2}, 1.0f / 32);
  const model::Definition definition = load_files(read("f.npy"));
  const model::Model model = model::make_model(definition, Communicator::world());
  int cells = 0;
  double mass = 0;
  lattice::for_each_owned(model.layout(), [&](auto i, auto j, auto k, auto n) {
    mass += model.inertia.component(0)[n];
    if (model.lattice.cell.component(0)[n] == 0) return;
    EXPECT_EQ(model.lattice.factor.component(0)[n], static_cast<float>(i + 4 * (j + 3 * k)) / 32);
    ++cells;
  });
  EXPECT_EQ(cells, 24);
  EXPECT_NEAR(mass, 24 * 1e-9 * 1000, 1e-16);  // 24 cells of 1 mm^3
}

TEST_F(FactorsTest, ResolvedInputNamesTheFile) {
  EXPECT_THAT(resolved_toml(read("f.npy")), HasSubstr("factor = \"" + (directory / "f.npy").native() + "\""));
}

TEST_F(FactorsTest, WhatIsWrongIsSaidAtTheKey) {
  write<float>("large.npy", "<f4", {4, 3, 2}, 1.0f / 16);
  expect_refused(read("large.npy"), "the factor of cell (1, 1, 1) is 1.0625; factors lie between 0 and 1");
  write<float>("negative.npy", "<f4", {4, 3, 2}, -1);
  expect_refused(read("negative.npy"), "the factor of cell (1, 0, 0) is -1; factors lie between 0 and 1");
  write<float>("turned.npy", "<f4", {2, 3, 4}, 0);
  expect_refused(read("turned.npy"), "there are factors for 2 x 3 x 4 cells, but the body has 4 x 3 x 2");
  expect_refused(read("nowhere.npy"), "the file \"" + (directory / "nowhere.npy").native() + "\" cannot be opened");
  EXPECT_THAT([&] { read("f.txt"); },
              ThrowsMessage<InputError>(
                  HasSubstr("case.toml:11:10: error: the file \"f.txt\" is in no known format; known: ")));
  write<std::complex<float>>("complex.npy", "<c8", {4, 3, 2}, 0);
  expect_refused(
      read("complex.npy"),
      "the file \"" + (directory / "complex.npy").native() +
          "\" holds values of the type \"'<c8'\", no numbers of 1 to 8 bytes; convert it with astype(\"uint8\")");
}

TEST_F(FactorsTest, PlainSpringsHaveNone) {
  write<float>("f.npy", "<f4", {4, 3, 2}, 0);
  EXPECT_THAT([&] { load_files(read("f.npy", "springs = \"plain\"")); },
              ThrowsMessage<InputError>(HasSubstr("case.toml:11:10: error: cells have no springs of their own to "
                                                  "multiply with lattice.springs = \"plain\"; take \"shared\"")));
}

}  // namespace
}  // namespace koshi::io
