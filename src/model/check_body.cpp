// Checks of the lattice, the body, its materials and regions.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/suggest.h"
#include "koshi/calibration.h"
#include "model/check.h"
#include "model/choices.h"
#include "model/regions.h"

namespace koshi::model {
namespace {

void check_lattice(const Checker& check) {
  const LatticeDefinition& lattice = check.definition.lattice;
  // 0: that of the image, see check_scan().
  if (lattice.spacing != 0) check.within(ranges::spacing, "lattice.spacing", lattice.spacing);

  const material::Calibration calibration = check.definition.calibration();
  const bool any_cell = calibration == material::Calibration::isotropic || calibration == material::Calibration::paper;
  if (!any_cell && lattice.cell != lattice::CellType::cube_iii)
    check.fail("lattice.calibration",
               fmt::format("calibration \"{}\" needs cell \"cube-III\", not \"{}\"; take \"isotropic\", or the cell "
                           "\"cube-III\"",
                           choice_name(calibration), name(lattice.cell)));

  if (calibration != material::Calibration::paper) {
    if (!lattice.equations.empty())
      check.fail("lattice.equations",
                 fmt::format("equations belong to calibration \"paper\", not \"{}\"; leave them out",
                             choice_name(calibration)));
    return;
  }
  const std::size_t count = lattice.cell == lattice::CellType::cube_i ? 1 : 2;
  if (!lattice.equations.empty() && lattice.equations.size() != count)
    check.fail("lattice.equations",
               fmt::format("{} equation{}; {} takes {}", lattice.equations.size(),
                           lattice.equations.size() == 1 ? "" : "s", name(lattice.cell),
                           count == 1 ? "one, such as [\"C1111-C1122\"]" : "two, such as [\"C1122\", \"C1212\"]"));
  for (std::size_t i = 0; i < lattice.equations.size(); ++i) {
    try {
      material::check_equation(lattice.equations[i]);
    } catch (const InputError& error) {
      check.fail(fmt::format("lattice.equations[{}]", i), error.message());
    }
  }
  std::string axes = lattice.axes;
  std::sort(axes.begin(), axes.end());
  if (axes != "xyz")
    check.fail("lattice.axes",
               fmt::format("axes is \"{}\"; expected a permutation of \"xyz\" such as \"yxz\"", lattice.axes));
}

void check_materials(const Checker& check) {
  const auto& materials = check.definition.materials;
  if (materials.empty()) check.fail("material", "there is no material; define one such as [material.rock]");
  // Cells name their material by two bytes, 0 stands for none.
  constexpr std::size_t most = SpringLattice::max_materials;
  if (materials.size() > most)
    check.fail("material", fmt::format("{} materials; at most {} fit in two bytes per cell", materials.size(), most));
  std::vector<std::string> names;
  for (const MaterialDefinition& material : materials) {
    const std::string path = "material." + material.name;
    if (material.name.empty()) check.fail("material", "a material has an empty name; name it, such as [material.rock]");
    if (material.name == "void") check.fail(path, "\"void\" means no material; choose another name");
    if (std::find(names.begin(), names.end(), material.name) != names.end())
      check.fail(path, fmt::format("two materials are called \"{}\"; names must differ", material.name));
    names.push_back(material.name);
    check.within(ranges::youngs_modulus, path + ".youngs_modulus", material.elastic.youngs_modulus);
    check.within(ranges::density, path + ".density", material.elastic.density);
    check.within(ranges::poissons_ratio, path + ".poissons_ratio", material.elastic.poissons_ratio);
    if (material.fracture) check_fracture(check, path + ".fracture", material);
  }
}

void check_factor(const Checker& check) {
  const Definition& definition = check.definition;
  if (definition.body.factor.empty() && definition.body.factors.empty()) return;
  if (definition.lattice.springs == material::Sharing::plain)
    check.fail("body.factor",
               "cells have no springs of their own to multiply with lattice.springs = \"plain\"; take "
               "\"shared\"");
  if (!definition.body.factor.empty()) check_cell_file(check, "body.factor", "the file", definition.body.factor);
}

void check_cut(const Checker& check) {
  if (!check.definition.cuts() || check.definition.lattice.springs == material::Sharing::shared) return;
  check.fail("body.surface",
             "a cut cell has springs of its own, weaker ones, which lattice.springs = \"plain\" knows not; take "
             "\"shared\", or surface = \"stairs\"");
}

void check_box_of_cells(const Checker& check) {
  const BodyDefinition& body = check.definition.body;
  check.within(ranges::position, "body.origin", body.origin);
  check_factor(check);
  check_cut(check);
  if (body.image.empty()) {
    make_grid(check.definition);
    if (body.cells.empty()) check_material_name(check, "body.material", body.material);
    return;
  }
  check_cell_file(check, "body.image", "the image", body.image);
  const bool by_density = body.scan && !body.scan->grey.empty();
  if (by_density) check_material_name(check, "body.material", body.material);
  if (body.image_materials.empty() && !by_density)
    check.fail("body", "an image needs materials, such as materials = { 0 = \"void\", 1 = \"rock\" }");
  for (const auto& [value, material] : body.image_materials)
    check_material_name(check, fmt::format("body.materials.{}", value), material);
}

void check_region(const Checker& check, const std::string& path, const RegionDefinition& region) {
  using Shape = RegionDefinition::Shape;
  check_material_name(check, path + ".material", region.material);
  switch (region.shape) {
    case Shape::box:
      check.within(ranges::position, path + ".min", region.min);
      check.within(ranges::position, path + ".max", region.max);
      check.ordered(path, region.min, region.max);
      break;
    case Shape::sphere:
      check.within(ranges::position, path + ".center", region.center);
      check.within(ranges::size, path + ".radius", region.radius);
      break;
    case Shape::cylinder:
      check.within(ranges::position, path + ".start", region.start);
      check.within(ranges::position, path + ".end", region.end);
      check.within(ranges::size, path + ".radius", region.radius);
      if (region.start == region.end)
        check.fail(path + ".end", "start and end of the cylinder are the same point; its axis needs a length");
      break;
    case Shape::half_space:
      check.within(ranges::position, path + ".point", region.point);
      if (region.normal == Vec3{})
        check.fail(path + ".normal", "normal is zero; it needs a direction such as [0, 0, 1]");
      check.within(ranges::direction, path + ".normal", region.normal);
      break;
    case Shape::stl:
      check.within(ranges::size, path + ".scale", region.scale);
      if (region.file.empty()) check.fail(path + ".file", "file is empty; name a closed surface such as \"part.stl\"");
      break;
  }
}

}  // namespace

void check_material_name(const Checker& check, const std::string& path, const std::string& material) {
  if (material == "void") return;
  std::vector<std::string> names;
  for (const MaterialDefinition& known : check.definition.materials) names.push_back(known.name);
  if (std::find(names.begin(), names.end(), material) != names.end()) return;
  names.emplace_back("void");
  check.fail(path, fmt::format("there is no material \"{}\"; {}", material, suggestion(material, names)));
}

// Formats of files with a value for each cell.
void check_cell_file(const Checker& check, const std::string& path, const std::string& what, const std::string& file) {
  const std::vector<std::string> formats{".npy", ".vti",  ".mha", ".mhd",    ".nrrd", ".nhdr",
                                         ".tif", ".tiff", ".nii", ".nii.gz", ".raw"};
  if (file.ends_with(".h5") || file.ends_with(".hdf5"))
    check.fail(path, fmt::format("{} \"{}\" is an HDF5 file, which Koshi does not read; save its data set by itself, "
                                 "such as with numpy.save(\"scan.npy\", h5py.File(\"{}\")[\"name\"])",
                                 what, file, file));
  if (std::filesystem::path(file).extension().empty()) return;  // a folder of slices
  if (std::none_of(formats.begin(), formats.end(), [&](const auto& suffix) { return file.ends_with(suffix); }))
    check.fail(path, fmt::format("{} \"{}\" is in no known format; known: {}", what, file, quoted_list(formats)));
}

void check_body(const Checker& check) {
  check_lattice(check);
  check_materials(check);
  check_scan(check);
  check_box_of_cells(check);
  for (std::size_t i = 0; i < check.definition.regions.size(); ++i)
    check_region(check, fmt::format("region[{}]", i), check.definition.regions[i]);
  check_scatter(check);
}

}  // namespace koshi::model
