// Samples written on one, two and three ranks, read back with VTK. Run on three ranks.
#include "io/field_writer.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataSetAttributes.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLPImageDataReader.h>
#include <vtkXMLUtilities.h>

#include <fstream>

#include "io/files.h"
#include "support/file_size_limit.h"
#include "support/first_ranks.h"
#include "support/temporary_directory.h"

namespace koshi::io {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

constexpr Int3 cells{7, 5, 6};
constexpr Vec3 origin{0.1, -0.2, 1.0 / 3};
constexpr double spacing = 0.1 / 3;

// A box with its last cell in x empty for the lower half of y, z; periodic along z if asked.
model::Definition make_definition(bool periodic) {
  model::Definition definition;
  definition.lattice.spacing = spacing;
  definition.body.origin = origin;
  for (int a = 0; a < 3; ++a) definition.body.size[a] = spacing * static_cast<double>(cells[a]);
  definition.body.periodic = {false, false, periodic};
  definition.body.material = "rock";
  definition.materials = {{"rock", {1e9, 0.2, 1000}}};
  for (std::int64_t k = 0; k < cells[2]; ++k)
    for (std::int64_t j = 0; j < cells[1]; ++j)
      for (std::int64_t i = 0; i < cells[0]; ++i) definition.body.cells.push_back(i == 6 && j < 2 && k < 3 ? 0 : 1);
  definition.body.material = "";
  return definition;
}

// A number that no two components, nodes or times share.
double value(int component, const Int3& at, double time) {
  return std::sin(component + 10.0 * static_cast<double>(at[0]) + 100.0 * static_cast<double>(at[1]) +
                  1000.0 * static_cast<double>(at[2])) +
         time;
}

// What a reader finds in a sample.
struct Sample {
  double time = 0;
  std::string file;
  vtkSmartPointer<vtkImageData> image;
};

template <class Reader>
vtkSmartPointer<vtkImageData> read_image(const fs::path& path) {
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

std::vector<Sample> read_samples(const fs::path& directory) {
  std::vector<Sample> samples;
  const auto xml = vtkSmartPointer<vtkXMLDataElement>::Take(
      vtkXMLUtilities::ReadElementFromFile((directory / "fields.pvd").c_str()));
  vtkXMLDataElement* list = xml->GetNestedElement(0);
  for (int i = 0; i < list->GetNumberOfNestedElements(); ++i) {
    Sample sample;
    list->GetNestedElement(i)->GetScalarAttribute("timestep", sample.time);
    sample.file = list->GetNestedElement(i)->GetAttribute("file");
    const fs::path path = directory / sample.file;
    sample.image =
        path.extension() == ".vti" ? read_image<vtkXMLImageDataReader>(path) : read_image<vtkXMLPImageDataReader>(path);
    samples.push_back(sample);
  }
  return samples;
}

// Names in the folder of fields, sorted.
std::vector<std::string> files_in(const fs::path& directory) {
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(directory))
    names.push_back(fs::relative(entry.path(), directory).native());
  std::sort(names.begin(), names.end());
  return names;
}

// A run on some ranks: a model, and fields filled on owned nodes only.
class FilledBody {
 public:
  FilledBody(const Communicator& communicator, bool periodic)
      : model(model::make_model(make_definition(periodic), communicator)),
        nodal(model.layout(), 6),
        cellular(model.layout(), 1) {}

  void write(FieldWriter& writer, double time) {
    lattice::for_each_owned(model.layout(), [&](auto i, auto j, auto k, auto n) {
      const Int3 at = model.layout().global({i, j, k});
      for (int c = 0; c < 6; ++c) nodal.component(c)[n] = value(c, at, time);
      cellular.component(0)[n] = value(7, at, time);
    });
    const std::array<FieldData, 3> fields{FieldData{"displacement", &nodal, 0, 3, {"x", "y", "z"}, false},
                                          FieldData{"rotation", &nodal, 3, 3, {}, false},
                                          FieldData{"energy", &cellular, 0, 1, {}, true}};
    writer.write(time, fields);
  }

  model::Model model;
  lattice::Field<double> nodal, cellular;
};

// All numbers of an image, whole or a piece; returns the number of points and cells.
std::array<vtkIdType, 2> expect_image(vtkImageData* image, double time, bool periodic) {
  std::array<int, 6> extent;
  image->GetExtent(extent.data());
  for (int a = 0; a < 3; ++a) {
    EXPECT_DOUBLE_EQ(image->GetOrigin()[a], origin[a]);
    EXPECT_DOUBLE_EQ(image->GetSpacing()[a], spacing);
  }
  vtkDataArray* displacement = image->GetPointData()->GetArray("displacement");
  vtkDataArray* rotation = image->GetPointData()->GetArray("rotation");
  vtkDataArray* energy = image->GetCellData()->GetArray("energy");
  vtkDataArray* material = image->GetCellData()->GetArray("material");
  vtkDataArray* hidden = image->GetCellData()->GetArray(vtkDataSetAttributes::GhostArrayName());
  if (!(displacement && rotation && energy && material && hidden)) {
    ADD_FAILURE() << "an array is missing";
    return {};
  }
  EXPECT_EQ(displacement->GetDataType(), VTK_DOUBLE);
  EXPECT_STREQ(displacement->GetComponentName(1), "y");

  // The last layer of a periodic direction repeats the first; empty cells are hidden.
  int points_right = 0, cells_right = 0;
  vtkIdType p = 0, c = 0;
  for (std::int64_t k = extent[4]; k <= extent[5]; ++k)
    for (std::int64_t j = extent[2]; j <= extent[3]; ++j)
      for (std::int64_t i = extent[0]; i <= extent[1]; ++i, ++p) {
        const Int3 at{i, j, periodic ? k % cells[2] : k};
        for (int q = 0; q < 3; ++q)
          points_right += displacement->GetComponent(p, q) == value(q, at, time) &&
                          rotation->GetComponent(p, q) == value(q + 3, at, time);
        if (i == extent[1] || j == extent[3] || k == extent[5]) continue;
        const bool solid = !(i == 6 && j < 2 && k < 3);
        cells_right += energy->GetTuple1(c) == value(7, at, time) && material->GetTuple1(c) == (solid ? 1 : 0) &&
                       hidden->GetTuple1(c) == (solid ? 0 : vtkDataSetAttributes::HIDDENCELL);
        ++c;
      }
  EXPECT_EQ(points_right, 3 * p);
  EXPECT_EQ(cells_right, c);
  EXPECT_EQ(displacement->GetNumberOfTuples(), p);
  EXPECT_EQ(energy->GetNumberOfTuples(), c);
  return {p, c};
}

void expect_sample(const Sample& sample, double time, bool periodic) {
  EXPECT_EQ(sample.time, time);
  EXPECT_EQ(expect_image(sample.image, time, periodic), (std::array<vtkIdType, 2>{8 * 6 * 7, 7 * 5 * 6}));
}

class FieldWriterTest : public testing::TestWithParam<std::tuple<int, bool>> {};

TEST_P(FieldWriterTest, ReaderFindsTheSameNumbersOnAnyNumberOfRanks) {
  const auto [ranks, periodic] = GetParam();
  const auto group = test::first_ranks(ranks);
  if (!group) return;
  const test::TemporaryDirectory directory(*group);
  FilledBody run(*group, periodic);
  FieldWriter writer(run.model, directory.path(), std::nullopt);
  run.write(writer, 0);
  run.write(writer, 0.1);
  if (!group->is_root()) return;
  const auto samples = read_samples(directory.path());
  ASSERT_EQ(samples.size(), 2u);
  expect_sample(samples[0], 0, periodic);
  expect_sample(samples[1], 0.1, periodic);
  // Each piece alone is right, too: a parallel reader may use any of those that share a point.
  std::array<vtkIdType, 2> total{};
  for (int rank = 0; ranks > 1 && rank < ranks; ++rank) {
    const auto piece =
        read_image<vtkXMLImageDataReader>(directory / fmt::format("fields/sample_000001/piece_{}.vti", rank));
    const auto counts = expect_image(piece, 0.1, periodic);
    EXPECT_EQ(piece->GetFieldData()->GetArray("TimeValue")->GetTuple1(0), 0.1);
    for (int a = 0; a < 2; ++a) total[a] += counts[a];
  }
  if (ranks > 1) {
    EXPECT_GT(total[0], 8 * 6 * 7) << "pieces share points";
    EXPECT_EQ(total[1], 7 * 5 * 6) << "and no cells";
  }
  // Nothing but the samples is left: with one rank a file each, else a header and a folder with a piece per rank.
  const auto files = files_in(directory / "fields");
  EXPECT_EQ(files.size(), static_cast<std::size_t>(ranks == 1 ? 2 : 2 * (2 + ranks)));
  for (const std::string& file : files) EXPECT_THAT(file, Not(HasSubstr(".part")));
}

INSTANTIATE_TEST_SUITE_P(Ranks, FieldWriterTest, testing::Combine(testing::Values(1, 2, 3), testing::Bool()));

class FieldFilesTest : public testing::Test {
 protected:
  const Communicator world = Communicator::world();
  const test::TemporaryDirectory directory{world};
  FilledBody run{world, false};

  std::vector<double> times() const {
    std::vector<double> result;
    for (const Sample& sample : read_samples(directory.path())) result.push_back(sample.time);
    return result;
  }
};

TEST_F(FieldFilesTest, RestartDropsLaterSamplesAndGoesOn) {
  {
    FieldWriter writer(run.model, directory.path(), std::nullopt);
    for (const double time : {0.0, 0.1, 0.2, 0.3}) run.write(writer, time);
  }
  FieldWriter writer(run.model, directory.path(), 0.15);
  run.write(writer, 0.25);
  run.write(writer, 0.25);  // the same time again: replaced
  run.write(writer, 0.35);
  if (!world.is_root()) return;
  EXPECT_EQ(times(), (std::vector{0.0, 0.1, 0.25, 0.35}));
  expect_sample(read_samples(directory.path())[2], 0.25, false);
  EXPECT_EQ(files_in(directory / "fields").size(), 4u * 5);
}

TEST_F(FieldFilesTest, NewRunRemovesTheSamplesOfTheOldOne) {
  {
    FieldWriter writer(run.model, directory.path(), std::nullopt);
    for (const double time : {0.0, 0.1, 0.2}) run.write(writer, time);
  }
  if (world.is_root()) std::ofstream(directory / "fields" / "notes.txt") << "the user's";
  FieldWriter writer(run.model, directory.path(), std::nullopt);
  if (world.is_root()) EXPECT_EQ(times().size(), 3u) << "nothing is lost before the first sample";
  world.barrier();
  run.write(writer, 0.5);
  if (!world.is_root()) return;
  EXPECT_EQ(times(), std::vector{0.5});
  const auto files = files_in(directory / "fields");
  EXPECT_EQ(files.size(), 1u + 5);
  EXPECT_THAT(files, testing::Contains("notes.txt"));
}

TEST_F(FieldFilesTest, FailureOnOneRankIsAnErrorOnAllAndKeepsEarlierSamples) {
  FieldWriter writer(run.model, directory.path(), std::nullopt);
  run.write(writer, 0.0);
  // Files of the last rank may not grow beyond a kilobyte: writing fails as on a full disk.
  std::optional<test::FileSizeLimit> limit;
  if (world.rank() == world.size() - 1) limit.emplace(1000);
  EXPECT_THAT([&] { run.write(writer, 0.1); },
              ThrowsMessage<RunError>(AllOf(HasSubstr("cannot write"), HasSubstr("File too large"))));
  limit.reset();
  if (world.is_root()) {
    EXPECT_EQ(times(), std::vector{0.0});
    EXPECT_EQ(files_in(directory / "fields").size(), 5u) << "what was begun is removed";
  }
  world.barrier();
  // With room again the writer goes on where it was.
  run.write(writer, 0.2);
  if (world.is_root()) EXPECT_EQ(times(), (std::vector{0.0, 0.2}));
}

TEST_F(FieldFilesTest, LostDirectoryIsAnErrorWithTheSystemsReason) {
  FieldWriter writer(run.model, directory / "run", std::nullopt);
  run.write(writer, 0.0);
  if (world.is_root()) {
    fs::remove_all(directory / "run");
    std::ofstream(directory / "run") << "a file in its place";
  }
  world.barrier();
  EXPECT_THAT([&] { run.write(writer, 0.1); }, ThrowsMessage<RunError>(HasSubstr("Not a directory")));
}

// A body of 1 x 1 x 2 cells has three layers of nodes; the rank that owns the last one owns no cell.
TEST(FieldWriterRanks, RankWithoutCellsWritesNoPiece) {
  const Communicator world = Communicator::world();
  const test::TemporaryDirectory directory(world);
  model::Definition definition = make_definition(false);
  definition.body.size = {spacing, spacing, 2 * spacing};
  definition.body.cells = {1, 1};
  const model::Model model = model::make_model(definition, world);
  EXPECT_EQ(model.layout().owned_count(), 4);
  FieldWriter writer(model, directory.path(), std::nullopt);
  writer.write(0.0, {});
  if (!world.is_root()) return;
  const auto samples = read_samples(directory.path());
  ASSERT_EQ(samples.size(), 1u);
  EXPECT_EQ(samples[0].image->GetNumberOfPoints(), 12);
  EXPECT_EQ(samples[0].image->GetNumberOfCells(), 2);
  EXPECT_EQ(samples[0].image->GetCellData()->GetArray("material")->GetTuple1(1), 1);
  EXPECT_EQ(files_in(directory / "fields").size(), 1u + 1 + 2);
  const std::string header = read_file(directory / samples[0].file);
  EXPECT_THAT(header, AllOf(HasSubstr("piece_0.vti"), HasSubstr("piece_1.vti"), Not(HasSubstr("piece_2.vti"))));
}

// A file cut short anywhere is never taken for a whole one: every limit below the file's size is an error.
TEST(ImageFile, EveryShortageOfSpaceIsNoticed) {
  const auto self = test::first_ranks(1);
  if (!self) return;
  const test::TemporaryDirectory directory;
  FilledBody run(*self, false);
  FieldWriter writer(run.model, directory.path(), std::nullopt);
  run.write(writer, 0.0);
  const auto size = fs::file_size(directory / "fields/sample_000000.vti");
  int failures = 0, tries = 0;
  for (std::uintmax_t room = 0; room < size; room += 1 + size / 64, ++tries) {
    FieldWriter next(run.model, directory / "next", std::nullopt);
    fs::create_directories(directory / "next/fields");
    const test::FileSizeLimit limit(room);
    try {
      run.write(next, 0.1);
    } catch (const RunError&) {
      ++failures;
    }
  }
  EXPECT_EQ(failures, tries);
  EXPECT_GT(tries, 60);
  EXPECT_FALSE(fs::exists(directory / "next/fields/sample_000000.vti"));
}

}  // namespace
}  // namespace koshi::io
