// Loads that vary in space, and with time otherwise than by a factor: a profile times the force at each place.
#pragma once

#include <vector>

#include "koshi/model.h"
#include "model/formula.h"
#include "model/region_surface.h"
#include "model/selection.h"

namespace koshi::model {

/// Shares of forces that nodes take of a load with a factor of 1 at every place, in an order that is the same on any
/// ranks. They are those of the nodes' shape functions at points of quadrature: force and moment are exact where the
/// profile is linear.
class ForceShares {
 public:
  /// Of a pressure or traction on pieces of surfaces.
  ForceShares(const Model& model, const LoadDefinition& load, const std::vector<SurfacePiece>& pieces);
  /// Of one on faces between solid and empty cells.
  ForceShares(const Model& model, const LoadDefinition& load, const NodeSet& nodes);
  /// Of an acceleration of the whole body.
  ForceShares(const Model& model, const LoadDefinition& load);

  bool empty() const { return shares_.empty(); }
  /// The load with its profile (collective). Errors: InputError where the profile is not finite at the start.
  Load with_profile(const Model& model, const LoadDefinition& load, const std::string& path) &&;

 private:
  struct Share {
    std::int64_t node = 0;
    std::size_t place = 0;
    Vec3 force{};
  };
  std::vector<Vec3> places_;
  std::vector<Share> shares_;
};

/// Sets the forces of a load to what its profile makes of them at time t [s], without its history. `values` is scratch.
void set_forces(const ProfiledForces& profiled, const Formula& profile, double t, std::vector<double>& values,
                std::vector<NodeForce>& forces);

}  // namespace koshi::model
