#include "model/pre_cracks.h"

#include <fmt/format.h>

#include <cmath>

#include "koshi/error.h"

namespace koshi::model {
namespace {

Vec3 unit(const Vec3& v) { return (1 / norm(v)) * v; }

// Of the planes between two layers of centres one layer is cut, the upper one if the plane lies just between.
bool cuts(const CrackDefinition& crack, const Vec3& centre, double d) {
  const double slack = 1e-6 * d;
  const Vec3 n = unit(crack.normal), from = centre - crack.center;
  const double above = dot(from, n);
  const double half_band = 0.5 * d * (std::abs(n[0]) + std::abs(n[1]) + std::abs(n[2]));
  if (above <= slack - half_band || above > half_band + slack) return false;
  const Vec3 in_plane = from - above * n;
  if (crack.shape == CrackDefinition::Shape::disc) return norm(in_plane) <= crack.radius + slack;
  const Vec3 length = unit(crack.along - dot(crack.along, n) * n), width = cross(n, length);
  return std::abs(dot(in_plane, length)) <= 0.5 * crack.length + slack &&
         std::abs(dot(in_plane, width)) <= 0.5 * crack.width + slack;
}

}  // namespace

void add_cracks(const Model& model, lattice::Field<double>& field) {
  const double d = model.lattice.grid.d;
  const std::uint16_t* cell = model.lattice.cell.component(0);
  const std::vector<CrackDefinition>& cracks = model.definition.pre_cracks;
  for (std::size_t c = 0; c < cracks.size(); ++c) {
    const Vec3 normal = unit(cracks[c].normal);
    std::int64_t cut = 0;
    int whole = 0;  // a material that cannot crack
    lattice::for_each_owned(model.layout(), [&](auto i, auto j, auto k, auto n) {
      if (cell[n] == 0) return;
      const Vec3 corner = model.lattice.grid.position(model.layout().global({i, j, k}));
      if (!cuts(cracks[c], corner + 0.5 * d * Vec3{1, 1, 1}, d)) return;
      ++cut;
      if (!model.definition.materials[cell[n] - 1U].cracks()) whole = cell[n];
      if (field.component(0)[n] >= 1) return;
      // Damage, strains, energies and their ratio as of a crack that has taken all it takes.
      for (int part = 0; part < 6; ++part) field.component(part)[n] = 1;
      for (int a = 0; a < 3; ++a) {
        field.component(6 + a)[n] = normal[static_cast<std::size_t>(a)];
        field.component(9 + a)[n] = 0;
      }
    });
    const Place place = model.definition.places.find(fmt::format("crack[{}]", c));
    const std::string name = cracks[c].name.empty() ? std::string() : " \"" + cracks[c].name + "\"";
    if (model.communicator.sum(cut) == 0)
      throw InputError(place,
                       fmt::format("crack{} cuts no cell of the body, whose cells have a side of {:.6g} m and lie "
                                   "between their box and the voids; move it, or make it larger",
                                   name, d));
    whole = static_cast<int>(model.communicator.max(whole));
    if (whole != 0)
      throw InputError(place, fmt::format("crack{} cuts cells of material \"{}\", which cannot crack; give that a "
                                          "fracture, or make the crack smaller",
                                          name, model.definition.materials[static_cast<std::size_t>(whole - 1)].name));
  }
}

}  // namespace koshi::model
