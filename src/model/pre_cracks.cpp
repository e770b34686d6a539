#include "model/pre_cracks.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "koshi/error.h"

namespace koshi::model {
namespace {

Vec3 unit(const Vec3& v) { return (1 / norm(v)) * v; }

// Whether the piece of the plane has this place, `from` its centre.
bool has(const CrackDefinition& crack, const Vec3& from, double slack) {
  const Vec3 n = unit(crack.normal), in_plane = from - dot(from, n) * n;
  if (crack.shape == CrackDefinition::Shape::disc) return norm(in_plane) <= crack.radius + slack;
  const Vec3 length = unit(crack.along - dot(crack.along, n) * n), width = cross(n, length);
  return std::abs(dot(in_plane, length)) <= 0.5 * crack.length + slack &&
         std::abs(dot(in_plane, width)) <= 0.5 * crack.width + slack;
}

// Of the planes between two layers of centres one layer is cut, the upper one if the plane lies just between.
bool cuts_cell(const CrackDefinition& crack, const Vec3& centre, double d) {
  const double slack = 1e-6 * d;
  const Vec3 n = unit(crack.normal), from = centre - crack.center;
  const double above = dot(from, n);
  const double half_band = 0.5 * d * (std::abs(n[0]) + std::abs(n[1]) + std::abs(n[2]));
  return above > slack - half_band && above <= half_band + slack && has(crack, from, slack);
}

// A node in the plane belongs to the side below it, so that here too the layer above is cut.
bool cuts_bond(const CrackDefinition& crack, const Vec3& a, const Vec3& b, double d) {
  const double slack = 1e-6 * d;
  const Vec3 n = unit(crack.normal);
  const double above = dot(a - crack.center, n), beyond = dot(b - crack.center, n);
  if ((above > slack) == (beyond > slack)) return false;
  return has(crack, a + (above / (above - beyond)) * (b - a) - crack.center, slack);
}

// Calls f(cell) for the owned cells that the crack cuts.
template <class F>
void for_each_cut_cell(const Model& model, const CrackDefinition& crack, F&& f) {
  const double d = model.lattice.grid.d;
  const std::uint16_t* const cell = model.lattice.cell.component(0);
  lattice::for_each_owned(model.layout(), [&](auto i, auto j, auto k, auto n) {
    if (cell[n] == 0) return;
    const Vec3 corner = model.lattice.grid.position(model.layout().global({i, j, k}));
    if (cuts_cell(crack, corner + 0.5 * d * Vec3{1, 1, 1}, d)) f(n);
  });
}

// Calls f(cell, node, slot) for the bonds that the crack cuts, by their first nodes and once for each of their cells:
// where the cell lies in the box, also along a period.
template <class F>
void for_each_cut_bond(const Model& model, const CrackDefinition& crack, F&& f) {
  const double d = model.lattice.grid.d;
  const std::uint16_t* const cell = model.lattice.cell.component(0);
  const auto look = [&](const Vec3& corner, std::int64_t n, std::int64_t node, int slot) {
    const lattice::Slot& of = lattice::slots[static_cast<std::size_t>(slot)];
    if (model.lattice.springs[cell[n]].kn[of.family] == 0) return;
    const Vec3 along{d * of.s[0], d * of.s[1], d * of.s[2]};
    if (cuts_bond(crack, corner, corner + along, d)) f(n, node, slot);
  };
  for_each_cell(model.lattice, [&](const Int3& at, std::int64_t n) {
    if (cell[n] == 0) return;
    const Vec3 lowest = model.lattice.grid.position(at);
    for (int slot = 0; slot < lattice::slot_count; ++slot)
      for (int corner = 0; corner < 8; ++corner) {
        bool inside = true;
        std::array<int, 3> from{};
        for (std::size_t a = 0; a < 3; ++a) {
          from[a] = corner >> a & 1;
          const int to = from[a] + lattice::slots[static_cast<std::size_t>(slot)].s[a];
          inside = inside && (to == 0 || to == 1);
        }
        if (!inside) continue;
        const Vec3 step{d * from[0], d * from[1], d * from[2]};
        look(lowest + step, n, n + model.layout().offset(from), slot);
      }
  });
}

// Refuses crack c if it cuts nothing, or what cannot crack: `whole` is the index of such a material, or 0.
void check_cut(const Model& model, std::size_t c, std::int64_t cut, int whole, const char* what) {
  const Place place = model.definition.places.find(fmt::format("crack[{}]", c));
  const std::string& given = model.definition.pre_cracks[c].name;
  const std::string name = given.empty() ? std::string() : " \"" + given + "\"";
  if (model.communicator.sum(cut) == 0)
    throw InputError(place, fmt::format("crack{} cuts no {} of the body, whose cells have a side of {:.6g} m and lie "
                                        "between their box and the voids; move it, or make it larger",
                                        name, what, model.lattice.grid.d));
  whole = static_cast<int>(model.communicator.max(whole));
  if (whole != 0)
    throw InputError(place,
                     fmt::format("crack{} cuts {}s of material \"{}\", which cannot crack; give that a "
                                 "fracture, or make the crack smaller",
                                 name, what, model.definition.materials[static_cast<std::size_t>(whole - 1)].name));
}

}  // namespace

void check_pre_cracks(const Model& model) {
  const bool by_bonds = model.definition.breaks_bonds();
  for (std::size_t c = 0; c < model.definition.pre_cracks.size(); ++c) {
    const CrackDefinition& crack = model.definition.pre_cracks[c];
    std::int64_t cut = 0;
    int whole = 0;  // a material that cannot crack
    const auto count = [&](std::int64_t n) {
      const int material = model.lattice.cell.component(0)[n];
      ++cut;
      if (!model.definition.materials[static_cast<std::size_t>(material - 1)].cracks()) whole = material;
    };
    if (by_bonds)
      for_each_cut_bond(model, crack, [&](auto n, auto, auto) { count(n); });
    else
      for_each_cut_cell(model, crack, count);
    check_cut(model, c, cut, whole, by_bonds ? "bond" : "cell");
  }
}

void add_cracks(const Model& model, lattice::Field<double>& field) {
  for (const CrackDefinition& crack : model.definition.pre_cracks) {
    const Vec3 normal = unit(crack.normal);
    for_each_cut_cell(model, crack, [&](auto n) {
      if (field.component(0)[n] >= 1) return;
      // Damage, strains, energies and their ratio as of a crack that has taken all it takes.
      for (int part = 0; part < 6; ++part) field.component(part)[n] = 1;
      for (int a = 0; a < 3; ++a) {
        field.component(6 + a)[n] = normal[static_cast<std::size_t>(a)];
        field.component(9 + a)[n] = 0;
      }
      field.component(crack_offset)[n] = std::numeric_limits<double>::infinity();
    });
  }
}

void break_bonds(const Model& model, lattice::Field<double>& bonds) {
  // What ghosts get is left to their owners.
  for (const CrackDefinition& crack : model.definition.pre_cracks)
    for_each_cut_bond(model, crack, [&](auto, auto node, int slot) {
      double& bits = bonds.component(0)[node];
      if ((static_cast<unsigned>(bits) >> slot & 1) == 0) bits += 1U << slot;
    });
}

}  // namespace koshi::model
