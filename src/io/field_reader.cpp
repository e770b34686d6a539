#include "io/field_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/escape.h"
#include "io/vti_file.h"
#include "koshi/error.h"

namespace koshi::io {
namespace {

constexpr const char* material_name = "material";
constexpr const char* marks_name = "vtkGhostType";  // VTK's own: cells it does not draw

const VtiArray* find(const VtiFile& file, const std::string& name, bool on_cells) {
  for (const VtiArray& array : file.arrays())
    if (array.name == name && array.on_cells == on_cells) return &array;
  return nullptr;
}

bool contains(const Extent& outer, const Extent& inner) {
  for (std::size_t a = 0; a < 6; a += 2)
    if (inner[a] < outer[a] || inner[a + 1] > outer[a + 1]) return false;
  return true;
}

// The text of a file that names others: small, and XML.
XmlElement read_xml(const std::filesystem::path& path) {
  const InputFile file(path);
  if (file.size() > (std::uint64_t{1} << 30)) throw InputError("is larger than 1 GiB");
  return parse_xml(file.text(0, file.size()));
}

}  // namespace

std::vector<SampleFile> list_samples(const std::filesystem::path& directory) {
  const std::filesystem::path path = directory / "fields.pvd";
  if (!std::filesystem::exists(path)) return {};
  std::vector<SampleFile> samples;
  try {
    const XmlElement root = read_xml(path);
    const XmlElement* list = root.child("Collection");
    if (list == nullptr) throw InputError("has no list of files");
    for (const XmlElement& item : list->children) {
      const std::string file = item.attribute("file"), time = item.attribute("timestep");
      if (!file.empty() && !time.empty()) samples.push_back({parse_vector(time + " 0 0", {})[0], directory / file});
    }
  } catch (const InputError& error) {
    throw InputError(fmt::format("{} is no collection of fields: it {}", path.native(), error.message()));
  }
  return samples;
}

FieldReader::FieldReader(const std::filesystem::path& path) : path_(path) {
  try {
    if (path.extension() == ".pvti")
      open_pieces();
    else
      open_whole();
    read_material();
  } catch (const InputError& error) {
    throw InputError(fmt::format("{} is no sample of fields that can be read: it {}", path.native(), error.message()));
  }
}

void FieldReader::open_whole() {
  pieces_.push_back(std::make_shared<VtiFile>(path_));
  extent_ = pieces_[0]->extent();
  origin_ = pieces_[0]->origin();
  spacing_ = pieces_[0]->spacing()[0];
}

void FieldReader::open_pieces() {
  const XmlElement root = read_xml(path_);
  const XmlElement* whole = root.child("PImageData");
  if (whole == nullptr) throw InputError("is no VTK image in pieces (.pvti)");
  extent_ = parse_extent(whole->attribute("WholeExtent"));
  origin_ = parse_vector(whole->attribute("Origin"), {0, 0, 0});
  spacing_ = parse_vector(whole->attribute("Spacing"), {1, 1, 1})[0];
  for (const XmlElement& element : whole->children) {
    if (element.name != "Piece") continue;
    const std::string source = element.attribute("Source");
    try {
      pieces_.push_back(std::make_shared<VtiFile>(path_.parent_path() / source));
    } catch (const InputError& error) {
      throw InputError(fmt::format("names the piece {}, which {}", shown(source), error.message()));
    }
    if (const Extent& extent = pieces_.back()->extent();
        extent != parse_extent(element.attribute("Extent")) || !contains(extent_, extent))
      throw InputError(fmt::format("names the piece {}, which has another extent", shown(source)));
  }
}

// Together the pieces must be the whole, each cell once.
void FieldReader::read_material() {
  const Int3 n = cells();
  double sum = 0;
  for (const auto& piece : pieces_) {
    const Int3 part = piece->cells();
    sum += static_cast<double>(part[0] * part[1]) * static_cast<double>(part[2]);
  }
  if (sum != static_cast<double>(n[0] * n[1]) * static_cast<double>(n[2]))
    throw InputError("has pieces that do not cover its extent");

  // A piece's extent is believed once its values are there.
  std::vector<std::vector<std::byte>> parts;
  for (const auto& piece : pieces_) {
    const VtiArray* array = find(*piece, material_name, true);
    if (array == nullptr || array->type != ValueType::uint16 || array->components != 1)
      throw InputError("has no cell array \"material\" of UInt16");
    parts.push_back(piece->values(*array));
  }
  material_.resize(static_cast<std::size_t>(sum));
  std::vector<bool> seen(material_.size());
  for (std::size_t p = 0; p < pieces_.size(); ++p) {
    const Extent& at = pieces_[p]->extent();
    std::size_t place = 0;
    for (std::int64_t k = at[4]; k < at[5]; ++k)
      for (std::int64_t j = at[2]; j < at[3]; ++j)
        for (std::int64_t i = at[0]; i < at[1]; ++i, ++place) {
          const auto cell =
              static_cast<std::size_t>((i - extent_[0]) + n[0] * ((j - extent_[2]) + n[1] * (k - extent_[4])));
          if (seen[cell]) throw InputError("has pieces that overlap");
          seen[cell] = true;
          material_[cell] = static_cast<std::uint16_t>(value_at(parts[p], ValueType::uint16, place));
        }
  }
}

Int3 FieldReader::cells() const { return {extent_[1] - extent_[0], extent_[3] - extent_[2], extent_[5] - extent_[4]}; }

Vec3 FieldReader::origin() const { return origin_; }

double FieldReader::spacing() const { return spacing_; }

std::vector<FieldInfo> FieldReader::fields() const {
  std::vector<FieldInfo> fields;
  for (const VtiArray& array : pieces_.front()->arrays())
    if (array.name != material_name && array.name != marks_name)
      fields.push_back({array.name, array.on_cells, array.component_names});
  return fields;
}

std::vector<float> FieldReader::gather(const FieldInfo& field, std::span<const std::int64_t> indices) const {
  const std::size_t components = field.components.size();
  Int3 n = cells();
  if (!field.on_cells)
    for (std::int64_t& along : n) ++along;
  std::vector<float> gathered(indices.size() * components);
  for (const auto& piece : pieces_) {
    const VtiArray* array = find(*piece, field.name, field.on_cells);
    if (array == nullptr || static_cast<std::size_t>(array->components) != components)
      throw InputError(fmt::format("{} has no field \"{}\" like the other samples", path_.native(), field.name));
    std::vector<std::byte> values;
    try {
      values = piece->values(*array);
    } catch (const InputError& error) {
      throw InputError(fmt::format("{} cannot be read: it {}", path_.native(), error.message()));
    }

    // A piece has its own numbers of points and cells; points on its faces are its neighbours', too.
    const Extent& at = piece->extent();
    const Int3 lo{at[0] - extent_[0], at[2] - extent_[2], at[4] - extent_[4]};
    Int3 size = piece->cells();
    if (!field.on_cells)
      for (std::int64_t& along : size) ++along;
    for (std::size_t place = 0; place < indices.size(); ++place) {
      const std::int64_t index = indices[place];
      const Int3 own{index % n[0] - lo[0], index / n[0] % n[1] - lo[1], index / (n[0] * n[1]) - lo[2]};
      bool here = true;
      for (std::size_t a = 0; a < 3; ++a) here = here && own[a] >= 0 && own[a] < size[a];
      if (!here) continue;
      const auto from = static_cast<std::size_t>(own[0] + size[0] * (own[1] + size[1] * own[2])) * components;
      for (std::size_t c = 0; c < components; ++c)
        gathered[place * components + c] = static_cast<float>(value_at(values, *array->type, from + c));
    }
  }
  return gathered;
}

}  // namespace koshi::io
