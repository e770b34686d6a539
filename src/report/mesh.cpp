#include "report/mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "io/field_reader.h"
#include "io/report_block.h"
#include "koshi/error.h"
#include "model/regions.h"
#include "report/surface.h"
#include "report/true_surface.h"

namespace koshi::report {
namespace {

using json = nlohmann::ordered_json;

std::string unit_of_field(const std::string& name) {
  static const std::map<std::string, std::string> units{
      {"displacement", "m"}, {"rotation", "rad"}, {"orientation", "rad"}, {"velocity", "m/s"},
      {"reaction", "N"},     {"stress", "Pa"},    {"energy", "J/m^3"}};
  const auto unit = units.find(name);
  return unit == units.end() ? "1" : unit->second;
}

json field_block(const io::FieldInfo& field, std::span<const float> values) {
  const std::size_t components = field.components.size();
  // Three numbers that are no components along the axes, such as Euler angles, have no magnitude.
  const bool vector = field.components == std::vector<std::string>{"x", "y", "z"};
  json block{{"kind", vector            ? "vector"
                      : components == 6 ? "symmetric-tensor"
                                        : "scalar"},
             {"on", field.on_cells ? "cells" : "points"},
             {"unit", unit_of_field(field.name)}};
  if (components > 1) block["components"] = field.components;
  block["data"] = io::encoded(values);
  return block;
}

// The material of the cells as a field of names; nothing for a body of one material.
json material_block(const io::FieldReader& reader, std::span<const std::int64_t> cells,
                    std::span<const std::string> materials) {
  const std::span<const std::uint16_t> material = reader.material();
  std::vector<bool> present(std::numeric_limits<std::uint16_t>::max() + 1);
  for (const std::uint16_t code : material) present[code] = true;
  std::vector<float> values;
  values.reserve(cells.size());
  for (const std::int64_t cell : cells) values.push_back(material[static_cast<std::size_t>(cell)]);
  json categories = json::object();
  for (std::size_t code = 1; code < present.size(); ++code)
    if (present[code])
      categories[fmt::format("{}", code)] =
          code <= materials.size() ? materials[code - 1] : fmt::format("material {}", code);
  if (categories.size() < 2) return nullptr;
  return {
      {"kind", "category"}, {"on", "cells"}, {"unit", "1"}, {"categories", categories}, {"data", io::encoded(values)}};
}

// Values of one sample, were every point and cell of these numbers given [bytes].
double bytes_of(std::span<const io::FieldInfo> fields, std::size_t points, std::size_t cells) {
  double values = 0;
  for (const io::FieldInfo& field : fields)
    values += static_cast<double>(field.components.size()) * static_cast<double>(field.on_cells ? cells : points);
  return values * sizeof(float);
}

// Evenly spaced ones of `count` samples, the first and the last among them; the last if only one.
std::vector<std::size_t> chosen_samples(std::size_t count, double affordable) {
  const auto kept = std::clamp<std::size_t>(static_cast<std::size_t>(affordable), 1, count);
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < kept; ++i)
    chosen.push_back(kept == 1 ? count - 1 : (2 * i * (count - 1) + kept - 1) / (2 * (kept - 1)));
  return chosen;
}

std::vector<std::int32_t> narrowed(std::span<const std::int64_t> indices) {
  std::vector<std::int32_t> result(indices.size());
  std::ranges::transform(indices, result.begin(), [](std::int64_t index) { return static_cast<std::int32_t>(index); });
  return result;
}

std::vector<float> positions(const io::FieldReader& reader, std::span<const std::int64_t> points) {
  Int3 nodes = reader.cells();
  for (std::int64_t& along : nodes) ++along;
  const Vec3 origin = reader.origin();
  std::vector<float> result;
  result.reserve(3 * points.size());
  for (std::int64_t point : points)
    for (std::size_t a = 0; a < 3; ++a) {
      result.push_back(static_cast<float>(origin[a] + reader.spacing() * static_cast<double>(point % nodes[a])));
      point /= nodes[a];
    }
  return result;
}

// Fields that a sample lacks, as after a restart with other output.fields: taken out of those shown and out of the
// samples before it. Adds the names of those that not all samples have.
void keep_common(const io::FieldReader& reader, std::vector<io::FieldInfo>& fields, json& samples,
                 std::set<std::string>& left_out) {
  const std::vector<io::FieldInfo> there = reader.fields();
  const auto same = [](const io::FieldInfo& field) {
    return [&](const io::FieldInfo& other) {
      return other.name == field.name && other.on_cells == field.on_cells &&
             other.components.size() == field.components.size();
    };
  };
  for (const io::FieldInfo& field : there)
    if (std::ranges::none_of(fields, same(field))) left_out.insert(field.name);
  std::erase_if(fields, [&](const io::FieldInfo& field) {
    if (std::ranges::any_of(there, same(field))) return false;
    left_out.insert(field.name);
    for (json& sample : samples) sample["fields"].erase(field.name);
    return true;
  });
}

// Where the points lie that the true surface has elsewhere than that of the cells.
json true_surface_block(std::span<const MovedPoint> moved) {
  std::vector<std::int32_t> points;
  std::vector<float> at;
  for (const MovedPoint& point : moved) {
    points.push_back(point.point);
    for (const double x : point.at) at.push_back(static_cast<float>(x));
  }
  return {{"point", io::encoded(std::span<const std::int32_t>(points))},
          {"at", io::encoded(std::span<const float>(at))}};
}

// Values of a field on points there, by the shape functions of the cells behind them.
std::vector<float> values_at(const io::FieldReader& reader, const io::FieldInfo& field,
                             std::span<const MovedPoint> moved) {
  std::vector<std::int64_t> nodes;
  for (const MovedPoint& point : moved) nodes.insert(nodes.end(), point.nodes.begin(), point.nodes.end());
  const std::vector<float> corners = reader.gather(field, nodes);
  const std::size_t components = field.components.size();
  std::vector<float> values(components * moved.size());
  for (std::size_t p = 0; p < moved.size(); ++p)
    for (std::size_t corner = 0; corner < 8; ++corner)
      for (std::size_t c = 0; c < components; ++c)
        values[components * p + c] += moved[p].weights[corner] * corners[components * (8 * p + corner) + c];
  return values;
}

std::string note(const Surface& surface, std::size_t shown, std::size_t samples,
                 const std::set<std::string>& left_out) {
  std::vector<std::string> parts;
  if (surface.stride > 1)
    parts.push_back(
        fmt::format("The surface has {} points; it is thinned to {}, one for each block of {} cells along x, y and z; "
                    "smaller voids are closed.",
                    surface.body_points, surface.points.size(), surface.stride));
  if (!surface.has_interior) parts.push_back("The inside is too large for this page: a cut shows the body hollow.");
  if (shown < samples) parts.push_back(fmt::format("{} of {} samples are shown.", shown, samples));
  if (!left_out.empty())
    parts.push_back(fmt::format("Not in all samples and left out: {}.", fmt::join(left_out, ", ")));
  return fmt::format("{}", fmt::join(parts, " "));
}

}  // namespace

nlohmann::ordered_json mesh_block(std::span<const ReportSample> samples, std::span<const std::string> materials,
                                  const model::Definition* regions, const ReportLimits& limits) {
  const io::FieldReader first(samples.front().path);
  std::vector<io::FieldInfo> fields = first.fields();

  // The inside is kept while the values of all samples stay small.
  const double node_bytes = bytes_of(fields, 1, 1) * static_cast<double>(samples.size());
  SurfaceLimits surface_limits{limits.surface_points, 0};
  surface_limits.interior_points = static_cast<std::int64_t>(limits.interior_bytes / std::max(node_bytes, 1.0));
  const Surface surface = extract_surface(first.cells(), first.material(), surface_limits);

  std::vector<std::int32_t> corners;
  corners.reserve(4 * surface.quads.size());
  for (const auto& quad : surface.quads) corners.insert(corners.end(), quad.begin(), quad.end());
  json mesh{{"points", io::encoded(positions(first, surface.points))},
            {"quads", io::encoded(corners)},
            {"quad_cell", io::encoded(surface.quad_cell)}};
  if (surface.has_interior)
    mesh["lattice"] = {{"cells", first.cells()},
                       {"origin", first.origin()},
                       {"spacing", first.spacing()},
                       {"point_index", io::encoded(narrowed(surface.points))},
                       {"cell_index", io::encoded(narrowed(surface.cells))}};

  std::vector<MovedPoint> moved;
  if (regions) moved = true_surface(*regions, model::make_grid(*regions), surface);
  if (!moved.empty()) mesh["true_surface"] = true_surface_block(moved);

  const double sample_bytes = bytes_of(fields, surface.points.size() + moved.size(), surface.cells.size());
  const auto chosen = chosen_samples(samples.size(), limits.sample_bytes / std::max(sample_bytes, 1.0));
  mesh["samples"] = json::array();
  std::set<std::string> left_out;
  for (const std::size_t s : chosen) {
    std::optional<io::FieldReader> other;
    if (s > 0) other.emplace(samples[s].path);
    const io::FieldReader& reader = other ? *other : first;
    if (reader.cells() != first.cells())
      throw InputError(
          fmt::format("{} and {} are of different bodies", samples[s].path.native(), samples[0].path.native()));
    keep_common(reader, fields, mesh["samples"], left_out);
    json block{{"time", samples[s].time}, {"fields", json::object()}};
    if (!samples[s].label.empty()) block["label"] = samples[s].label;
    for (const io::FieldInfo& field : fields) {
      json& values = block["fields"][field.name] =
          field_block(field, reader.gather(field, field.on_cells ? surface.cells : surface.points));
      if (!moved.empty() && !field.on_cells)
        values["on_true_surface"] = io::encoded(std::span<const float>(values_at(reader, field, moved)));
    }
    if (json material = material_block(reader, surface.cells, materials); !material.is_null())
      block["fields"]["material"] = std::move(material);
    mesh["samples"].push_back(std::move(block));
  }
  if (const std::string text = note(surface, chosen.size(), samples.size(), left_out); !text.empty())
    mesh["note"] = text;
  return mesh;
}

}  // namespace koshi::report
