#include "io/field_writer.h"

#include <fmt/format.h>
#include <vtkImageData.h>
#include <vtkXMLUtilities.h>

#include <algorithm>

#include "base/collective.h"
#include "io/files.h"
#include "io/image.h"
#include "io/sample_names.h"
#include "lattice/halo.h"
#include "lattice/partition.h"

namespace koshi::io {
namespace {

namespace fs = std::filesystem;

constexpr const char* collection_name = "fields.pvd";

fs::path sample_stem(std::size_t number) { return fs::path("fields") / sample_name(number); }

std::string piece_name(int rank) { return fmt::format("piece_{}.vti", rank); }

}  // namespace

FieldWriter::FieldWriter(const model::Model& model, fs::path directory, std::optional<double> restart_time)
    : model_(model), directory_(std::move(directory)) {
  has_empty_cells_ = model.cell_count < model.lattice.grid.cell_count();
  collectively(model.communicator, [&] {
    if (restart_time && model_.communicator.is_root()) read_collection(*restart_time);
  });
  // All ranks count the samples alike; only the root knows their names and times.
  const auto kept = model.communicator.sum(static_cast<std::int64_t>(samples_.size()));
  samples_.resize(static_cast<std::size_t>(kept));
}

void FieldWriter::write(double time, std::span<const FieldData> fields) {
  const Communicator& communicator = model_.communicator;
  const bool root = communicator.is_root();
  for (const FieldData& field : fields)
    if (!field.on_cells && !field.ghosts_filled) model_.lattice.halo->exchange(*field.values);

  // The first sample of this run removes those of an earlier run, or those after the restart.
  const auto replace = communicator.any(root && !samples_.empty() && samples_.back().time == time);
  if (replace) samples_.pop_back();
  const std::size_t number = samples_.size();
  collectively(communicator, [&] {
    if (!root) return;
    fs::create_directories(directory_ / "fields");
    if (first_) {
      write_collection();
      remove_samples_from(number);
    }
  });
  first_ = false;

  const auto image = make_image(model_, fields, time, has_empty_cells_);
  const std::string file = communicator.size() == 1 ? write_single(number, image) : write_pieces(number, image);
  collectively(communicator, [&] {
    samples_.push_back({time, file});
    if (root) write_collection();
  });
}

std::string FieldWriter::write_single(std::size_t number, vtkImageData* image) const {
  const std::string file = sample_stem(number).native() + ".vti";
  write_image(directory_ / file, image);
  return file;
}

std::string FieldWriter::write_pieces(std::size_t number, vtkImageData* image) const {
  const Communicator& communicator = model_.communicator;
  const bool root = communicator.is_root();
  const lattice::Grid& grid = model_.lattice.grid;
  const fs::path folder = directory_ / sample_stem(number), part = part_of(folder);
  const std::string file = sample_stem(number).native() + ".pvti";
  collectively(communicator, [&] {
    if (!root) return;
    fs::remove_all(part);
    fs::create_directory(part);
  });
  try {
    // The folder gets its name when every rank has written its piece, and is read once the header is there.
    collectively(communicator, [&] {
      if (has_cells(piece_extent(grid, model_.layout()))) write_image(part / piece_name(communicator.rank()), image);
    });
    collectively(communicator, [&] {
      if (!root) return;
      std::vector<std::pair<std::array<int, 6>, std::string>> pieces;
      for (int rank = 0; rank < communicator.size(); ++rank) {
        const auto extent = piece_extent(grid, model_.lattice.partition->layout(rank));
        if (has_cells(extent)) pieces.emplace_back(extent, (folder.filename() / piece_name(rank)).native());
      }
      fs::remove_all(folder);
      fs::rename(part, folder);
      replace_file(directory_ / file, parallel_header(grid, image, pieces));
    });
  } catch (...) {
    std::error_code ignored;
    if (root) fs::remove_all(part, ignored);
    throw;
  }
  return file;
}

void FieldWriter::read_collection(double restart_time) {
  const fs::path path = directory_ / collection_name;
  if (!fs::exists(path)) return;
  const auto xml = vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromFile(path.c_str()));
  vtkXMLDataElement* list = xml ? xml->FindNestedElementWithName("Collection") : nullptr;
  if (!list) throw InputError(fmt::format("{} is no collection of fields; remove it", path.native()));
  for (int i = 0; i < list->GetNumberOfNestedElements(); ++i) {
    vtkXMLDataElement* item = list->GetNestedElement(i);
    double time = 0;
    const char* file = item->GetAttribute("file");
    if (file && item->GetScalarAttribute("timestep", time) && time <= restart_time) samples_.push_back({time, file});
  }
}

void FieldWriter::write_collection() const {
  auto list = element("Collection");
  for (const Sample& sample : samples_) {
    auto item = element("DataSet");
    item->SetAttribute("timestep", fmt::format("{}", sample.time).c_str());
    item->SetIntAttribute("part", 0);
    item->SetAttribute("file", sample.file.c_str());
    list->AddNestedElement(item);
  }
  auto root = element("VTKFile");
  root->SetAttribute("type", "Collection");
  root->SetAttribute("version", "1.0");
  root->AddNestedElement(list);
  replace_file(directory_ / collection_name, document(root));
}

void FieldWriter::remove_samples_from(std::size_t number) const {
  std::vector<fs::path> stale;
  for (const auto& entry : fs::directory_iterator(directory_ / "fields")) {
    const auto found = sample_number(entry.path().filename().native());
    if (found && *found >= number) stale.push_back(entry.path());
  }
  for (const fs::path& path : stale) fs::remove_all(path);
}

}  // namespace koshi::io
