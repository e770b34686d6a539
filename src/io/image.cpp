#include "io/image.h"

#include <fmt/format.h>
#include <vtkCallbackCommand.h>
#include <vtkCellData.h>
#include <vtkCommand.h>
#include <vtkDataSetAttributes.h>
#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnsignedShortArray.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkZLibDataCompressor.h>

#include <cerrno>
#include <cstdio>
#include <sstream>

#include "io/files.h"

namespace koshi::io {
namespace {

/// Local indices of the piece's points or cells, half-open.
struct Box {
  Int3 lo{}, hi{};
  std::int64_t count() const { return (hi[0] - lo[0]) * (hi[1] - lo[1]) * (hi[2] - lo[2]); }
};

Box piece_box(const lattice::Layout& layout, const std::array<int, 6>& extent, bool cells) {
  Box box;
  for (int a = 0; a < 3; ++a) box.hi[a] = extent[2 * a + 1] - layout.begin()[a] + (cells ? 0 : 1);
  return box;
}

vtkSmartPointer<vtkDoubleArray> make_array(const lattice::Layout& layout, const Box& box, const FieldData& field) {
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(field.name.c_str());
  array->SetNumberOfComponents(field.components);
  for (std::size_t c = 0; c < field.component_names.size(); ++c)
    array->SetComponentName(static_cast<vtkIdType>(c), field.component_names[c].c_str());
  array->SetNumberOfTuples(box.count());
  for (int c = 0; c < field.components; ++c) {
    const double* from = field.values->component(field.first_component + c);
    double* to = array->GetPointer(0) + c;
    lattice::for_each(layout, box.lo, box.hi, [&](auto, auto, auto, auto n) {
      *to = from[n];
      to += field.components;
    });
  }
  return array;
}

// `value(material)` of every cell of the piece.
template <class Array, class F>
vtkSmartPointer<Array> make_cell_array(const char* name, const model::SpringLattice& lattice, const Box& box,
                                       F&& value) {
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfTuples(box.count());
  auto* to = array->GetPointer(0);
  const std::uint16_t* cell = lattice.cell.component(0);
  lattice::for_each(lattice.layout, box.lo, box.hi, [&](auto, auto, auto, auto n) { *to++ = value(cell[n]); });
  return array;
}

// Names and types of the arrays of a piece.
vtkSmartPointer<vtkXMLDataElement> declare(const char* name, vtkFieldData* data) {
  auto list = element(name);
  for (int i = 0; i < data->GetNumberOfArrays(); ++i) {
    vtkDataArray* array = data->GetArray(i);
    auto item = element("PDataArray");
    const int type = array->GetDataType();
    item->SetAttribute("type", type == VTK_DOUBLE ? "Float64" : type == VTK_UNSIGNED_SHORT ? "UInt16" : "UInt8");
    item->SetAttribute("Name", array->GetName());
    item->SetIntAttribute("NumberOfComponents", array->GetNumberOfComponents());
    for (int c = 0; array->HasAComponentName() && c < array->GetNumberOfComponents(); ++c)
      item->SetAttribute(fmt::format("ComponentName{}", c).c_str(), array->GetComponentName(c));
    list->AddNestedElement(item);
  }
  return list;
}

}  // namespace

vtkSmartPointer<vtkXMLDataElement> element(const char* name) {
  auto result = vtkSmartPointer<vtkXMLDataElement>::New();
  result->SetName(name);
  return result;
}

std::array<int, 6> piece_extent(const lattice::Grid& grid, const lattice::Layout& layout) {
  std::array<int, 6> extent;
  for (int a = 0; a < 3; ++a) {
    extent[2 * a] = static_cast<int>(layout.begin()[a]);
    extent[2 * a + 1] = static_cast<int>(std::min(layout.begin()[a] + layout.owned()[a], grid.cells[a]));
  }
  return extent;
}

bool has_cells(const std::array<int, 6>& extent) {
  return extent[0] < extent[1] && extent[2] < extent[3] && extent[4] < extent[5];
}

vtkSmartPointer<vtkImageData> make_image(const model::Model& model, std::span<const FieldData> fields, double time,
                                         bool mark_empty) {
  const lattice::Grid& grid = model.lattice.grid;
  const lattice::Layout& layout = model.layout();
  std::array<int, 6> extent = piece_extent(grid, layout);
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetExtent(extent.data());
  image->SetOrigin(grid.origin.data());
  image->SetSpacing(grid.d, grid.d, grid.d);

  const Box points = piece_box(layout, extent, false), cells = piece_box(layout, extent, true);
  for (const FieldData& field : fields) {
    auto array = make_array(layout, field.on_cells ? cells : points, field);
    if (field.on_cells)
      image->GetCellData()->AddArray(array);
    else
      image->GetPointData()->AddArray(array);
  }
  image->GetCellData()->AddArray(
      make_cell_array<vtkUnsignedShortArray>("material", model.lattice, cells, [](std::uint16_t m) { return m; }));
  if (mark_empty)
    image->GetCellData()->AddArray(make_cell_array<vtkUnsignedCharArray>(
        vtkDataSetAttributes::GhostArrayName(), model.lattice, cells,
        [](std::uint16_t material) -> unsigned char { return material == 0 ? vtkDataSetAttributes::HIDDENCELL : 0; }));

  vtkNew<vtkDoubleArray> time_value;
  time_value->SetName("TimeValue");
  time_value->InsertNextValue(time);
  image->GetFieldData()->AddArray(time_value);
  return image;
}

void write_image(const std::filesystem::path& path, vtkImageData* image) {
  vtkNew<vtkXMLImageDataWriter> writer;
  vtkNew<vtkZLibDataCompressor> compressor;
  compressor->SetCompressionLevel(1);  // doubles hardly shrink further at a multiple of the time
  writer->SetCompressor(compressor);
  writer->SetBlockSize(std::size_t{1} << 18);
  writer->SetHeaderTypeToUInt64();
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetInputData(image);
  const std::filesystem::path part = fresh_part_of(path);
  writer->SetFileName(part.c_str());

  // Observed errors are not printed by VTK; the first one's system error is the reason.
  int reason = 0;
  vtkNew<vtkCallbackCommand> observer;
  observer->SetClientData(&reason);
  observer->SetCallback([](vtkObject*, unsigned long, void* data, void*) {
    if (int& first = *static_cast<int*>(data); first == 0) first = errno;
  });
  writer->AddObserver(vtkCommand::ErrorEvent, observer);
  writer->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, observer);
  errno = 0;
  const bool written = writer->Write() == 1 && writer->GetErrorCode() == vtkErrorCode::NoError;
  if (written && std::rename(part.c_str(), path.c_str()) == 0) return;
  if (reason == 0) reason = errno != 0 ? errno : ENOSPC;
  std::filesystem::remove(part);
  throw RunError(fmt::format("cannot write {}: {}", path.native(), system_reason(reason)));
}

std::string parallel_header(const lattice::Grid& grid, vtkImageData* image,
                            std::span<const std::pair<std::array<int, 6>, std::string>> pieces) {
  auto whole = element("PImageData");
  whole->SetAttribute("WholeExtent",
                      fmt::format("0 {} 0 {} 0 {}", grid.cells[0], grid.cells[1], grid.cells[2]).c_str());
  whole->SetIntAttribute("GhostLevel", 0);
  whole->SetAttribute("Origin", fmt::format("{}", fmt::join(grid.origin, " ")).c_str());
  whole->SetAttribute("Spacing", fmt::format("{0} {0} {0}", grid.d).c_str());
  whole->AddNestedElement(declare("PPointData", image->GetPointData()));
  whole->AddNestedElement(declare("PCellData", image->GetCellData()));
  for (const auto& [extent, file] : pieces) {
    auto piece = element("Piece");
    piece->SetAttribute("Extent", fmt::format("{}", fmt::join(extent, " ")).c_str());
    piece->SetAttribute("Source", file.c_str());
    whole->AddNestedElement(piece);
  }
  auto root = element("VTKFile");
  root->SetAttribute("type", "PImageData");
  root->SetAttribute("version", "1.0");
  root->SetAttribute("byte_order", "LittleEndian");
  root->SetAttribute("header_type", "UInt64");
  root->SetAttribute("compressor", "vtkZLibDataCompressor");
  root->AddNestedElement(whole);
  return document(root);
}

std::string document(vtkXMLDataElement* root) {
  std::ostringstream text;
  text << "<?xml version=\"1.0\"?>\n";
  root->PrintXML(text, vtkIndent());
  return text.str();
}

}  // namespace koshi::io
