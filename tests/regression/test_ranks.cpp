// One run on 1, 2, 3, 4 and 8 ranks: history, fields, checkpoint and summary are the same bits; pieces of fields are
// read back as one body.
#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLPImageDataReader.h>

#include <algorithm>
#include <cstring>
#include <numeric>

#include <nlohmann/json.hpp>

#include "io/field_reader.h"
#include "support/program.h"
#include "support/temporary_directory.h"

namespace koshi {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Json summary_without_timings(const fs::path& directory) {
  Json summary = Json::parse(test::read_file(directory / "summary.json"));
  EXPECT_EQ(summary.erase("performance"), 1U);
  return summary;
}

template <class Reader>
vtkSmartPointer<vtkImageData> read_image(const fs::path& path) {
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

vtkSmartPointer<vtkImageData> read_image(const fs::path& path) {
  return path.extension() == ".pvti" ? read_image<vtkXMLPImageDataReader>(path)
                                     : read_image<vtkXMLImageDataReader>(path);
}

// Arrays of points or cells that are the same bits and not zero everywhere.
int equal_arrays(vtkDataSetAttributes* got, vtkDataSetAttributes* wanted) {
  int equal = 0;
  for (int a = 0; a < wanted->GetNumberOfArrays(); ++a) {
    vtkDataArray* one = wanted->GetArray(a);
    vtkDataArray* other = got->GetArray(one->GetName());
    if (!other || other->GetNumberOfValues() != one->GetNumberOfValues()) {
      ADD_FAILURE() << one->GetName() << " is missing or of another size";
      continue;
    }
    const auto bytes = static_cast<std::size_t>(one->GetNumberOfValues() * one->GetDataTypeSize());
    const bool same = std::memcmp(one->GetVoidPointer(0), other->GetVoidPointer(0), bytes) == 0;
    EXPECT_TRUE(same) << one->GetName();
    equal += same && one->GetMaxNorm() > 0;
  }
  return equal;
}

// What the report sees of a sample: all values, and where they are.
void expect_read_alike(const fs::path& pieces, const fs::path& whole) {
  const io::FieldReader got(pieces), wanted(whole);
  EXPECT_EQ(got.cells(), wanted.cells());
  EXPECT_EQ(got.origin(), wanted.origin());
  EXPECT_EQ(got.spacing(), wanted.spacing());
  EXPECT_TRUE(std::ranges::equal(got.material(), wanted.material()));
  const auto fields = wanted.fields();
  ASSERT_EQ(got.fields().size(), fields.size());
  for (std::size_t f = 0; f < fields.size(); ++f) {
    EXPECT_EQ(got.fields()[f].name, fields[f].name);
    EXPECT_EQ(got.fields()[f].components, fields[f].components);
    EXPECT_EQ(got.fields()[f].on_cells, fields[f].on_cells);
    const Int3 n = wanted.cells();
    std::vector<std::int64_t> all(
        static_cast<std::size_t>(fields[f].on_cells ? n[0] * n[1] * n[2] : (n[0] + 1) * (n[1] + 1) * (n[2] + 1)));
    std::iota(all.begin(), all.end(), 0);
    EXPECT_EQ(got.gather(fields[f], all), wanted.gather(fields[f], all)) << fields[f].name;
  }
}

TEST(Ranks, SameBitsOnAnyNumber) {
  const test::TemporaryDirectory directory;
  // Ranks that share a core wait for each other at every step and every sum: few of both.
  const std::string run =
      "run " KOSHI_SOURCE_DIR
      "/tests/regression/shaken.toml --quiet --set 'analysis.duration=\"30 us\"' --set "
      "'output.every=\"10 us\"' --set 'output.history_every=\"0.5 us\"' --set 'output.checkpoint_every_wall=\"1 "
      "hour\"' --set 'output.fields=[\"displacement\", \"rotation\", "
      "\"orientation\", \"velocity\", \"reaction\", \"strain\", \"stress\", \"energy\"]' --out ";
  const auto run_on = [&](int ranks) {
    const fs::path out = directory / std::to_string(ranks);
    const test::Ended ended = test::koshi(directory.path(), run + out.native() + " --ranks " + std::to_string(ranks));
    EXPECT_EQ(ended.code, 0) << ended.error;
    EXPECT_EQ(Json::parse(test::read_file(out / "summary.json")).at("performance").at("ranks"), ranks);
    return out;
  };
  const fs::path one = run_on(1);
  const std::string history = test::read_file(one / "history.csv");
  EXPECT_GT(std::ranges::count(history, '\n'), 50);
  const auto samples = io::list_samples(one);
  ASSERT_EQ(samples.size(), 4U);
  for (const int ranks : {2, 3, 4, 8}) {
    SCOPED_TRACE(std::to_string(ranks) + " ranks");
    const fs::path out = run_on(ranks);
    EXPECT_TRUE(test::read_file(out / "history.csv") == history);
    EXPECT_EQ(summary_without_timings(out), summary_without_timings(one));
    EXPECT_TRUE(test::read_file(out / "checkpoint.h5") == test::read_file(one / "checkpoint.h5"));
    const auto pieces = io::list_samples(out);
    ASSERT_EQ(pieces.size(), samples.size());
    for (std::size_t s = 0; s < samples.size(); ++s) {
      const auto got = read_image(pieces[s].path), wanted = read_image(samples[s].path);
      // At the start all is zero but the orientation; later the 8 fields asked for, the material and the hidden cells
      // are there.
      EXPECT_EQ(equal_arrays(got->GetPointData(), wanted->GetPointData()) +
                    equal_arrays(got->GetCellData(), wanted->GetCellData()),
                s == 0 ? 2 : 10)
          << "sample " << s;
    }
    expect_read_alike(pieces.back().path, samples.back().path);
  }
}

// Cut cells, loads and supports on surfaces: every rank computes those that touch its nodes by itself.
TEST(Ranks, SameBitsWhereSurfacesCutCells) {
  const test::TemporaryDirectory directory;
  const auto run_on = [&](int ranks) {
    const fs::path out = directory / std::to_string(ranks);
    const test::Ended ended =
        test::koshi(directory.path(), "run " KOSHI_SOURCE_DIR "/tests/regression/curved.toml --quiet --out " +
                                          out.native() + " --ranks " + std::to_string(ranks));
    EXPECT_EQ(ended.code, 0) << ended.error;
    return out;
  };
  const fs::path one = run_on(1);
  const std::string history = test::read_file(one / "history.csv");
  EXPECT_GT(std::ranges::count(history, '\n'), 25);
  EXPECT_GT(summary_without_timings(one).at("energy").at("elastic").get<double>(), 0);
  for (const int ranks : {2, 4}) {
    SCOPED_TRACE(std::to_string(ranks) + " ranks");
    const fs::path out = run_on(ranks);
    EXPECT_TRUE(test::read_file(out / "history.csv") == history);
    EXPECT_EQ(summary_without_timings(out), summary_without_timings(one));
    EXPECT_TRUE(test::read_file(out / "checkpoint.h5") == test::read_file(one / "checkpoint.h5"));
    expect_read_alike(io::list_samples(out).back().path, io::list_samples(one).back().path);
  }
}

}  // namespace
}  // namespace koshi
