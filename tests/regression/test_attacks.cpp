// Files made to break the readers (tests/attacks): each is refused with exit code 2, by its name and by what is wrong
// with it, or read as what it is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "koshi/input.h"
#include "support/program.h"
#include "support/temporary_directory.h"

namespace koshi {
namespace {

using test::Ended;
using testing::HasSubstr;
using testing::StartsWith;
namespace fs = std::filesystem;

const fs::path attacks = fs::path(KOSHI_SOURCE_DIR) / "tests/attacks";

struct Attack {
  const char* file;
  const char* message;  ///< behind the file's name
};

// Sizes refer to base.toml: 3 x 6 x 3 voxels of a byte.
const Attack images[] = {
    // Format strings of a list of slices.
    {"format_string.mhd", "names one file for each slice; join the slices to one file"},
    {"n4.nrrd", "names one file for each slice; join the slices to one file"},
    // Headers that are too long, or whose numbers are none.
    {"ndims5000.mhd", "has a header with a line of more than 16384 characters, line 4"},
    {"long_header.npy", "is a NumPy file with a header of 60058 characters; at most 10000 are read"},
    {"re2.npy", "is a NumPy file with a header of 60056 characters; at most 10000 are read"},
    {"hang.nrrd", "has \"encod\\u0001\\u0001\\u0001"},
    {"m5.mhd", "has DimSize = \"-3 6 3\"; expected positive whole numbers"},
    {"n3.nrrd", "has sizes: \"-3 6 3\"; expected positive whole numbers"},
    {"n7.nrrd", "has dimension: \"99999\"; expected 3 (or 2)"},
    {"q2.nrrd", "has no field \"dimension\"; expected 3 (or 2)"},
    {"q3.nrrd", "has no field \"sizes\"; expected 3 numbers"},
    {"q12.nrrd", "has dimension: \"1\"; expected 3 (or 2)"},
    // Values that are elsewhere, too few, too many or damaged.
    {"m2.mhd", "names one file for each slice"},
    {"m4.mhd", "names the data file \"d.raw\", which cannot be opened (No such file or directory)"},
    {"m8.mhd", "names the data file \"d.raw\", which cannot be opened (No such file or directory)"},
    {"n2.nrrd", "is cut short: 99999 x 99999 x 99999 voxels of uint8 need 999970000299999 bytes, at most 2 are there"},
    {"two_dimensional.nrrd", "holds more than the 18 bytes that 3 x 6 x 1 voxels of uint8 need"},
    {"g1.nrrd", "has compressed values that are cut short"},
    {"g2.nrrd", "holds more than the 54 bytes that 3 x 6 x 3 voxels of uint8 need"},
    {"g5.nrrd", "has compressed values that are damaged"},
    {"g6.nrrd", "holds more than the 54 bytes that 3 x 6 x 3 voxels of uint8 need"},
    {"g7.mha", "holds more than the 54 bytes that 3 x 6 x 3 voxels of uint8 need"},
    // VTK files whose pieces are short, wrong or huge.
    {"piece_missing.vti",
     "is a VTK image whose piece has the extent \"0 1 0 6 0 3\", but the whole has \"0 3 0 6 0 3\""},
    {"short_ascii.vti", "holds an array of 50 values, but its extent asks for 54"},
    {"v2.vti", "has the extent \"0 2000000000 0 2000000000 0 2000000000\", too large"},
    {"v4.vti", "has the extent \"0 2147483647 -2147483648 0 0 1\", too large"},
    {"v5.vti", "has an array of 999999999 components; expected 1 to 64"},
    {"v6.vti", "holds the array \"material\" of the type \"String\", no numbers"},
    {"v7.vti", "holds an array that begins behind the end of the file"},
    {"v8.vti", "holds an array that is cut short"},
    {"v16.vti", "is a VTK image whose piece has the extent \"100 103 0 6 0 3\", but the whole has \"0 3 0 6 0 3\""},
    {"mhd_aniso/aniso.mhd", "has voxels of 0.02 x 0.02 x 1, but cells are cubes; resample it"},
    // MET_LONG has four bytes.
    {"mhd_long/long8.mhd",
     "names the data file \"i64.raw\", which holds more than the 480 bytes that 6 x 5 x 4 voxels of int32 need"},
};

// What the program says of an image in the case of base.toml; empty if nothing.
std::string error_of(const std::string& image) {
  try {
    io::load_files(io::read_case(
        attacks / "base.toml", std::vector<std::string>{"body={image='" + image + "',materials={0='void',1='rock'}}"}));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Attacks, ImagesAreRefusedByName) {
  int count = 0;
  for (const Attack& attack : images) {
    SCOPED_TRACE(attack.file);
    const std::string error = error_of((attacks / attack.file).native());
    EXPECT_THAT(error, StartsWith("--set body="));
    EXPECT_THAT(error, HasSubstr("error: the file \"" + (attacks / attack.file).native() + "\" " + attack.message));
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
    ++count;
  }
  // All images of the folder are here, and two of its folders.
  int found = 0;
  for (const auto& entry : fs::directory_iterator(attacks)) {
    const std::string kind = entry.path().extension();
    found += entry.is_regular_file() && kind != ".toml" && kind != ".stl";
  }
  EXPECT_EQ(count, found + 2);
}

// From the command line the same, by exit code 2.
TEST(Attacks, ProgramEndsWithItsExitCode) {
  const test::TemporaryDirectory directory;
  for (const char* file : {"format_string.mhd", "hang.nrrd", "v7.vti", "re2.npy"}) {
    const std::string image = (attacks / file).native();
    const Ended ended =
        test::koshi(directory.path(), "check '" + (attacks / "base.toml").native() + "' --set \"body={image='" + image +
                                          "',materials={0='void',1='rock'}}\"");
    EXPECT_EQ(ended.code, 2);
    EXPECT_EQ(ended.error, error_of(image) + "\n");
  }
}

struct Readable {
  const char* folder;
  const char* cells;
};

TEST(Attacks, WhatIsWellFormedIsReadAsItIs) {
  const test::TemporaryDirectory directory;
  const Readable all[] = {
      {"mhd_long_long", "cells         6 x 5 x 4, 60 solid\n"},
      {"nrrd_2d", "cells         6 x 20 x 1, 60 solid\n"},
      // [2.5, 7.5)^3 and [2, 8)^3 with every triangle twice.
      {"stl_centres", "cells         10 x 10 x 10, 125 solid\n"},
      {"stl_doubled", "cells         10 x 10 x 10, 216 solid\n"},
  };
  for (const Readable& readable : all) {
    SCOPED_TRACE(readable.folder);
    const Ended ended =
        test::koshi(directory.path(), "check '" + (attacks / readable.folder / "case.toml").native() + "'");
    EXPECT_EQ(ended.code, 0) << ended.error;
    EXPECT_THAT(ended.output, HasSubstr(readable.cells));
  }
}

// Boxes of 1 x 2 x 1 and 2 x 3 x 1 cells of which one lies in the other.
TEST(Attacks, SurfaceThatCrossesItselfIsTheUnionOfItsParts) {
  const test::TemporaryDirectory directory;
  test::write_file(directory / "case.toml", R"([lattice]
spacing = "1 mm"
[body]
size = ["3 mm", "6 mm", "3 mm"]
material = "void"
[material.rock]
youngs_modulus = "1 GPa"
poissons_ratio = 0.2
density = "2000 kg/m^3"
[[region]]
shape = "stl"
file = ")" + (attacks / "self_intersect.stl").native() +
                                                R"("
material = "rock"
[[boundary]]
box = {min = [0, 0, 0], max = ["3 mm", "6 mm", "3 mm"]}
fix = ["x", "y", "z"]
)");
  const Ended ended = test::koshi(directory.path(), "check case.toml");
  EXPECT_EQ(ended.code, 0) << ended.error;
  EXPECT_THAT(ended.output + ended.error, HasSubstr("self_intersect.stl overlap in 2 cells; they are united"));
  EXPECT_THAT(ended.output, HasSubstr("cells         3 x 6 x 3, 6 solid\n"));
}

// Held along an edge, node rotations free: the body may turn about it, which no load asks for.
TEST(Attacks, BodyOnAHingeIsSolvedWithoutItsFreeMotion) {
  const test::TemporaryDirectory directory;
  const std::string hinge = attacks / "hinge.toml";
  const std::string least_squares = "--set lattice.kinematics=least-squares";
  for (const std::string& more : {std::string(), least_squares, std::string("--ranks 2")}) {
    SCOPED_TRACE(more);
    const Ended ended = test::koshi(directory.path(), "run '" + hinge + "' --out out " + more);
    EXPECT_EQ(ended.code, 0) << ended.error;
    EXPECT_THAT(ended.output, HasSubstr("is free to rotate about x; the solution is without that motion"));
  }
}

// Steps of 1e-300 s would be more than can be counted; they are not one step of the whole duration.
TEST(Attacks, StepsBeyondCountAreRefused) {
  const test::TemporaryDirectory directory;
  const std::string dyn = attacks / "dyn.toml";
  for (const char* key : {"time_step", "safety"}) {
    SCOPED_TRACE(key);
    const Ended ended = test::koshi(directory.path(), "run '" + dyn + "' --out out --set analysis." + key + "=1e-300");
    EXPECT_EQ(ended.code, 2);
    EXPECT_THAT(ended.error, StartsWith("--set analysis." + std::string(key) + "="));
    EXPECT_FALSE(fs::exists(directory / "out"));
  }
  const Ended ended = test::koshi(directory.path(), "run '" + dyn + "' --quiet --out out");
  EXPECT_EQ(ended.code, 0) << ended.error;
}

// A pipe that nobody writes to, a device, a folder: refused at once wherever a file is read.
TEST(Attacks, OnlyRegularFilesAreRead) {
  const test::TemporaryDirectory directory;
  const std::string base = (attacks / "base.toml").native();
  const auto refused = [&](const std::string& arguments, const std::string& message) {
    SCOPED_TRACE(arguments);
    const Ended ended = test::koshi(directory.path(), arguments);
    EXPECT_EQ(ended.code, 2);
    EXPECT_THAT(ended.error, HasSubstr(message));
  };
  for (const char* kind : {"npy", "vti", "mha", "mhd", "nrrd", "nhdr", "stl", "h5"})
    ASSERT_EQ(::mkfifo((directory / (std::string("pipe.") + kind)).c_str(), 0600), 0);
  for (const char* kind : {"npy", "vti", "mha", "mhd", "nrrd", "nhdr"}) {
    const std::string file = (directory / (std::string("pipe.") + kind)).native();
    EXPECT_THAT(error_of(file), HasSubstr("the file \"" + file + "\" is no regular file but a pipe or a device"));
  }
  const auto region = [&](const std::string& file) {
    return "check '" + base + "' --set 'region=[{shape=\"stl\",file=\"" + file + "\",material=\"rock\"}]'";
  };
  refused(region((directory / "pipe.stl").native()), "pipe.stl\" is no regular file but a pipe or a device");
  refused(region("/dev/zero"), "/dev/zero\" is no regular file but a pipe or a device");
  refused(region(directory.path().native()), "\" is a folder");
  refused("run '" + base + "' --set output.report=false --out out --restart pipe.h5",
          "checkpoint pipe.h5 is no regular file");
  refused("run '" + base + "' --set output.report=false --out out --restart /dev/zero",
          "checkpoint /dev/zero is no regular file");
  refused("run '" + base + "' --set output.report=false --out out --set 'analysis.start_from=\"" +
              (directory / "pipe.h5").native() + "\"'",
          "pipe.h5 is no regular file");
  EXPECT_FALSE(fs::exists(directory / "out"));

  // The inputs of a report.
  const std::vector<std::string> files{"resolved.toml", "summary.json", "history.csv", "fields.pvd"};
  for (const std::string& pipe : files) {
    const fs::path results = directory / ("results_" + pipe);
    fs::create_directory(results);
    if (pipe != "resolved.toml") fs::copy_file(base, results / "resolved.toml");
    ASSERT_EQ(::mkfifo((results / pipe).c_str(), 0600), 0);
    refused("report '" + results.native() + "'", pipe);
  }
}

}  // namespace
}  // namespace koshi
