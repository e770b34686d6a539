// Checks of [body.scan].
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/check.h"

namespace koshi::model {
namespace {

void check_whole(const Checker& check, const std::string& path, const Vec3& value) {
  for (const double v : value)
    if (v != std::round(v))
      check.fail(path, fmt::format("{} has {:.9g}, but voxels are counted by whole numbers", Checker::key(path), v));
}

void check_ascending(const Checker& check, const std::string& path, const std::vector<double>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    check.within(ranges::grey, path, values[i]);
    if (i > 0 && !(values[i] > values[i - 1]))
      check.fail(path, fmt::format("{} has {:.9g} after {:.9g}; list the values in ascending order", Checker::key(path),
                                   values[i], values[i - 1]));
  }
}

void check_raw(const Checker& check, const ScanDefinition& scan, bool raw) {
  if (!raw) {
    const ScanDefinition unset;
    if (scan.size || scan.type != unset.type || scan.byte_order != unset.byte_order || scan.offset != unset.offset)
      check.fail("body.scan",
                 "size, type, byte_order and offset tell what a raw file does not, but the image says them itself; "
                 "leave them out");
    return;
  }
  if (!scan.size) check.fail("body.scan", "a raw file needs size, such as size = [512, 512, 400]");
  check.within(ranges::voxel_count, "body.scan.size", *scan.size);
  check_whole(check, "body.scan.size", *scan.size);
  check.within(ranges::bytes, "body.scan.offset", scan.offset);
}

void check_axes(const Checker& check, const std::vector<std::string>& axes) {
  if (axes.empty()) return;
  std::string letters;
  for (const std::string& axis : axes) letters += axis.empty() ? ' ' : axis.back();
  std::sort(letters.begin(), letters.end());
  const bool known = std::all_of(axes.begin(), axes.end(), [](const auto& axis) {
    return axis.size() == 1 || (axis.size() == 2 && axis[0] == '-');
  });
  if (letters != "xyz" || !known)
    check.fail("body.scan.axes", fmt::format("axes has {}; it takes each of x, y, z once, a minus before it turns it "
                                             "around, such as [\"z\", \"y\", \"-x\"]",
                                             fmt::join(axes, ", ")));
}

void check_densities(const Checker& check, const ScanDefinition& scan) {
  if (scan.grey.empty() && scan.density.empty()) return;
  if (!scan.thresholds.empty())
    check.fail("body.scan.thresholds",
               "thresholds make materials of grey values, and grey a density; take one of them");
  if (scan.grey.size() != scan.density.size())
    check.fail("body.scan", fmt::format("grey has {} values, density has {}; each value of grey has its density",
                                        scan.grey.size(), scan.density.size()));
  check.within(ranges::exponent, "body.scan.exponent", scan.exponent);
  const auto& materials = check.definition.materials;
  const std::string& name = check.definition.body.material;
  const auto material = std::find_if(materials.begin(), materials.end(), [&](const auto& m) { return m.name == name; });
  if (material == materials.end())
    check.fail("body.material", "the densities of grey need a material that they are a part of, not \"void\"");
  for (const double density : scan.density) {
    check.within(ranges::scan_density, "body.scan.density", density);
    if (density > material->elastic.density * (1 + 1e-12))
      check.fail("body.scan.density",
                 fmt::format("density has {:.6g} kg/m^3, but the material \"{}\" has {:.6g} kg/m^3 where it is dense; "
                             "give the material the greatest density and its Young's modulus there",
                             density, name, material->elastic.density));
  }
}

}  // namespace

void check_scan(const Checker& check) {
  const BodyDefinition& body = check.definition.body;
  const LatticeDefinition& lattice = check.definition.lattice;
  if (lattice.spacing == 0 && (body.image.empty() || !body.scan || !body.scan->unit))
    check.fail("lattice.spacing",
               "spacing = \"image\" takes the voxels of an image in the unit of their sides; give an image and its "
               "unit, such as scan = { unit = \"1 um\" } in [body]");
  if (!body.scan) return;
  const ScanDefinition& scan = *body.scan;
  if (body.image.empty())
    check.fail("body.scan", "scan says how an image becomes cells; give an image, or leave it out");
  if (scan.unit) check.within(ranges::size, "body.scan.unit", *scan.unit);
  if (scan.unit && lattice.spacing != 0)
    check.fail("body.scan.unit", "the unit of the voxels counts for spacing = \"image\"; leave one of them out");
  check_raw(check, scan, body.image.ends_with(".raw"));
  if (scan.crop) {
    check.within(ranges::voxel, "body.scan.crop.min", scan.crop->first);
    check.within(ranges::voxel, "body.scan.crop.max", scan.crop->second);
    check_whole(check, "body.scan.crop.min", scan.crop->first);
    check_whole(check, "body.scan.crop.max", scan.crop->second);
    for (std::size_t a = 0; a < 3; ++a)
      if (!(scan.crop->first[a] < scan.crop->second[a]))
        check.fail("body.scan.crop",
                   fmt::format("crop keeps nothing along {}: min is {:.9g}, max is {:.9g}; max is the "
                               "first voxel left out",
                               "xyz"[a], scan.crop->first[a], scan.crop->second[a]));
  }
  check_axes(check, scan.axes);
  check.within(ranges::coarsening, "body.scan.coarsen", scan.coarsen);
  check_ascending(check, "body.scan.thresholds", scan.thresholds);
  check_ascending(check, "body.scan.grey", scan.grey);
  check_densities(check, scan);
  if ((scan.coarsen > 1 || !scan.grey.empty()) && lattice.springs == material::Sharing::plain)
    check.fail("lattice.springs",
               "cells that are partly filled have a factor on their springs, but plain springs belong to no cell; take "
               "\"shared\"");
}

}  // namespace koshi::model
