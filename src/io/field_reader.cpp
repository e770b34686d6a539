#include "io/field_reader.h"

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkObject.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedShortArray.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLPImageDataReader.h>
#include <vtkXMLUtilities.h>

#include <sstream>

#include "io/files.h"
#include "koshi/error.h"

namespace koshi::io {
namespace {

/// While it lives VTK prints no errors: they are thrown instead.
class QuietVtk {
 public:
  QuietVtk() { vtkObject::GlobalWarningDisplayOff(); }
  ~QuietVtk() { vtkObject::SetGlobalWarningDisplay(before_); }
  QuietVtk(const QuietVtk&) = delete;
  QuietVtk& operator=(const QuietVtk&) = delete;

 private:
  int before_ = vtkObject::GetGlobalWarningDisplay();
};

// The image in a file, or nothing when it cannot be read.
template <class Reader>
std::shared_ptr<vtkImageData> read(const std::filesystem::path& path) {
  const auto reader = vtkSmartPointer<Reader>::New();
  const QuietVtk quiet;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkImageData* image = reader->GetOutput();
  if (reader->GetErrorCode() != 0 || !image) return nullptr;
  image->Register(nullptr);
  return {image, [](vtkImageData* held) { held->Delete(); }};
}

// All arrays of points or cells but the material and VTK's own marks.
void append_fields(vtkDataSetAttributes* data, bool on_cells, std::vector<FieldInfo>& fields) {
  for (int i = 0; i < data->GetNumberOfArrays(); ++i) {
    vtkDataArray* array = data->GetArray(i);
    const std::string name = array->GetName();
    if (name == "material" || name == vtkDataSetAttributes::GhostArrayName()) continue;
    FieldInfo field{name, on_cells, {}};
    for (int c = 0; c < array->GetNumberOfComponents(); ++c)
      field.components.push_back(array->GetComponentName(c) ? array->GetComponentName(c) : fmt::format("{}", c));
    fields.push_back(std::move(field));
  }
}

}  // namespace

std::vector<SampleFile> list_samples(const std::filesystem::path& directory) {
  const std::filesystem::path path = directory / "fields.pvd";
  if (!std::filesystem::exists(path)) return {};
  std::istringstream text(read_file(path));
  const QuietVtk quiet;
  const auto xml = vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromStream(text));
  vtkXMLDataElement* list = xml ? xml->FindNestedElementWithName("Collection") : nullptr;
  if (!list) throw InputError(fmt::format("{} is no collection of fields", path.native()));
  std::vector<SampleFile> samples;
  for (int i = 0; i < list->GetNumberOfNestedElements(); ++i) {
    vtkXMLDataElement* item = list->GetNestedElement(i);
    double time = 0;
    const char* file = item->GetAttribute("file");
    if (file && item->GetScalarAttribute("timestep", time)) samples.push_back({time, directory / file});
  }
  return samples;
}

FieldReader::FieldReader(const std::filesystem::path& path) : path_(path) {
  const bool parallel = path.extension() == ".pvti";
  image_ = parallel ? read<vtkXMLPImageDataReader>(path) : read<vtkXMLImageDataReader>(path);
  const bool usable = image_ && vtkUnsignedShortArray::SafeDownCast(image_->GetCellData()->GetArray("material"));
  if (!usable) throw InputError(fmt::format("{} is no sample of fields that can be read", path.native()));
}

Int3 FieldReader::cells() const {
  const int* dimensions = image_->GetDimensions();
  return {dimensions[0] - 1, dimensions[1] - 1, dimensions[2] - 1};
}

Vec3 FieldReader::origin() const {
  const double* origin = image_->GetOrigin();
  return {origin[0], origin[1], origin[2]};
}

double FieldReader::spacing() const { return image_->GetSpacing()[0]; }

std::vector<FieldInfo> FieldReader::fields() const {
  std::vector<FieldInfo> fields;
  append_fields(image_->GetPointData(), false, fields);
  append_fields(image_->GetCellData(), true, fields);
  return fields;
}

std::span<const std::uint16_t> FieldReader::material() const {
  auto* array = vtkUnsignedShortArray::SafeDownCast(image_->GetCellData()->GetArray("material"));
  return {array->GetPointer(0), static_cast<std::size_t>(array->GetNumberOfTuples())};
}

std::vector<float> FieldReader::gather(const FieldInfo& field, std::span<const std::int64_t> indices) const {
  vtkDataSetAttributes* data = image_->GetPointData();
  if (field.on_cells) data = image_->GetCellData();
  vtkDataArray* array = data->GetArray(field.name.c_str());
  const int components = static_cast<int>(field.components.size());
  if (!array || array->GetNumberOfComponents() != components)
    throw InputError(fmt::format("{} has no field \"{}\" like the other samples", path_.native(), field.name));
  std::vector<float> values;
  values.reserve(indices.size() * field.components.size());
  for (const std::int64_t index : indices)
    for (int c = 0; c < components; ++c) values.push_back(static_cast<float>(array->GetComponent(index, c)));
  return values;
}

}  // namespace koshi::io
