// The files an input names: images of cells and surfaces.
#include <fmt/format.h>

#include <new>

#include "io/cell_image.h"
#include "io/surface.h"
#include "io/surface_cut.h"
#include "koshi/input.h"
#include "model/check.h"
#include "model/regions.h"

namespace koshi::io {
namespace {

// Runs `read` on a file of the input; what is wrong with it is an error at the key that names it.
template <class F>
auto load(const model::Definition& definition, const std::string& key, const std::string& name, F&& read) {
  const auto path = std::filesystem::path(definition.directory) / name;
  const auto fail = [&](const std::string& message) {
    model::Checker(definition).fail(key, fmt::format("the file \"{}\" {}", path.lexically_normal().string(), message));
  };
  try {
    return read(path);
  } catch (const InputError& error) {
    fail(error.message());
    throw;
  } catch (const std::bad_alloc&) {
    fail("needs more memory than there is");
    throw;
  }
}

}  // namespace

model::Definition load_files(model::Definition definition) {
  model::check(definition);
  if (const std::string& image = definition.body.image; !image.empty())
    set_cells(load(definition, "body.image", image,
                   [&](const auto& path) { return read_cell_image(path, definition.body.scan); }),
              definition);
  else if (!definition.body.factor.empty())
    definition.body.factors.clear();
  if (const std::string& factor = definition.body.factor; !factor.empty())
    set_factors(load(definition, "body.factor", factor, read_factor_image), definition);
  if (const std::string& strength = definition.body.strength; !strength.empty())
    set_strengths(load(definition, "body.strength", strength, read_factor_image), definition);
  if (const auto& boundary = definition.body.grain_boundary; boundary && !boundary->labels.empty())
    set_grain_labels(load(definition, "body.grain_boundary.labels", boundary->labels,
                          [](const auto& path) { return read_cell_image(path); }),
                     definition);
  for (std::size_t r = 0; r < definition.regions.size(); ++r) {
    model::RegionDefinition& region = definition.regions[r];
    if (region.shape != model::RegionDefinition::Shape::stl) continue;
    const lattice::Grid grid = model::make_grid(definition);
    region.inside = load(definition, fmt::format("region[{}].file", r), region.file,
                         [&](const auto& path) { return cells_inside(path, region.scale, grid); });
    if (definition.cuts())
      region.cut_cells = load(definition, fmt::format("region[{}].file", r), region.file,
                              [&](const auto& path) { return cells_cut(path, region.scale, grid); });
    if (!region.name.empty())
      region.triangles = load(definition, fmt::format("region[{}].file", r), region.file,
                              [&](const auto& path) { return outward_triangles(path, region.scale); });
  }
  return definition;
}

}  // namespace koshi::io
