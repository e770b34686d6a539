#include "model/profiled_loads.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/collective.h"
#include "model/surface_loads.h"
#include "model/triangle_points.h"

namespace koshi::model {
namespace {

// Of a pressure or traction on an area vector that points out of the body.
Vec3 force_on(const Vec3& area, double size, const LoadDefinition& load) {
  return load.pressure ? -*load.pressure * area : size * *load.traction;
}

}  // namespace

ForceShares::ForceShares(const Model& model, const LoadDefinition& load, const std::vector<SurfacePiece>& pieces) {
  const lattice::Layout& layout = model.layout();
  for (const SurfacePiece& piece : pieces) {
    const Vec3 normal = (1 / norm(piece.area)) * piece.area;
    // Triangles about the first corner: exact for linear profiles.
    for (std::size_t v = 2; v < piece.corners.size(); ++v) {
      const Vec3 &a = piece.corners[0], &b = piece.corners[v - 1], &c = piece.corners[v];
      const double area = 0.5 * norm(cross(b - a, c - a));
      for_each_point(a, b, c, [&](const Vec3& place, double part) {
        const Vec3 force = force_on(part * area * normal, part * area, load);
        bool taken = false;
        for (const CornerShare& share : corner_shares(model.lattice.grid, piece.cell, place)) {
          const Int3 local = layout.local(share.node);
          if (!layout.owns(local)) continue;
          shares_.push_back({layout.index(local), places_.size(), share.weight * force});
          taken = true;
        }
        if (taken) places_.push_back(place);
      });
    }
  }
}

ForceShares::ForceShares(const Model& model, const LoadDefinition& load, const NodeSet& nodes) {
  const lattice::Grid& grid = model.lattice.grid;
  // Two by two points of Gauss on each face, of which each of its four corners takes the part of its bilinear function.
  const std::array<double, 2> along{0.5 - 0.5 / std::numbers::sqrt3, 0.5 + 0.5 / std::numbers::sqrt3};
  const double area = 0.25 * grid.d * grid.d;
  for (const FaceQuarter& quarter : selected_quarters(model.lattice, nodes)) {
    const auto axis = static_cast<std::size_t>(quarter.axis);
    const std::size_t b = (axis + 1) % 3, c = (axis + 2) % 3;
    for (const double s : along)
      for (const double t : along) {
        Vec3 place = grid.position(quarter.global), outward{};
        place[b] += grid.d * quarter.side[0] * s;
        place[c] += grid.d * quarter.side[1] * t;
        // Below the first node of a periodic direction the body ends at its upper side.
        for (const std::size_t a : {b, c})
          if (grid.periodic[a] && place[a] < grid.origin[a]) place[a] += grid.d * static_cast<double>(grid.cells[a]);
        outward[axis] = quarter.outward * area;
        shares_.push_back({quarter.node, places_.size(), (1 - s) * (1 - t) * force_on(outward, area, load)});
        places_.push_back(place);
      }
  }
}

ForceShares::ForceShares(const Model& model, const LoadDefinition& load) {
  const double* mass = model.inertia.component(0);
  lattice::for_each_owned(model.layout(), [&](auto i, auto j, auto k, auto n) {
    if (mass[n] == 0) return;
    shares_.push_back({n, places_.size(), mass[n] * *load.acceleration});
    places_.push_back(model.lattice.grid.position(model.layout().global({i, j, k})));
  });
}

Load ForceShares::with_profile(const Model& model, const LoadDefinition& load, const std::string& path) && {
  std::stable_sort(shares_.begin(), shares_.end(), [](const Share& a, const Share& b) { return a.node < b.node; });
  Load made{{}, {}, load.history, ProfiledForces{std::move(places_), {}}};
  for (const Share& share : shares_) {
    if (made.forces.empty() || made.forces.back().node != share.node) made.forces.push_back({share.node, {}});
    made.profiled->shares.push_back({share.place, made.forces.size() - 1, share.force});
  }
  shares_.clear();

  const Formula profile(load.profile);
  std::vector<double> values;
  set_forces(*made.profiled, profile, 0, values, made.forces);
  collectively(model.communicator, [&] {
    for (std::size_t p = 0; p < values.size(); ++p) {
      if (std::isfinite(values[p])) continue;
      throw InputError(model.definition.places.find(path + ".profile"),
                       fmt::format("the formula \"{}\" has no finite value at x = {:.6g}, y = {:.6g}, z = {:.6g} m, "
                                   "where load \"{}\" acts; limit it, for example by max or min",
                                   load.profile, made.profiled->places[p][0], made.profiled->places[p][1],
                                   made.profiled->places[p][2], load.name));
    }
  });
  if (!profile.varies_in_time()) made.profiled.reset();
  return made;
}

void set_forces(const ProfiledForces& profiled, const Formula& profile, double t, std::vector<double>& values,
                std::vector<NodeForce>& forces) {
  values.resize(profiled.places.size());
  for (std::size_t p = 0; p < values.size(); ++p) values[p] = profile.at(profiled.places[p], t);
  for (NodeForce& force : forces) force.force = {};
  for (const ProfiledForces::Share& share : profiled.shares) {
    Vec3& sum = forces[share.entry].force;
    sum = sum + values[share.place] * share.force;
  }
}

}  // namespace koshi::model
