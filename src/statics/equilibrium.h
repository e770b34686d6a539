// The equations of equilibrium K x = b on one rank's nodes.
#pragma once

#include <vector>

#include "koshi/model.h"
#include "mechanics/added_forces.h"
#include "mechanics/cell_stress.h"
#include "mechanics/force_kernel.h"
#include "statics/fixed_nodes.h"

namespace koshi::statics {

/// Unknowns of equilibrium: all components of all owned nodes, component by component, x fastest, without ghosts. So
/// that all have one unit, the rotations w of nodes are measured as rho = (d/2) w [m], their moments as M / (d/2) [N].
/// Fixed components and nodes without a cell keep their place with a value of zero.
class Equilibrium {
 public:
  /// `t`: time [s] at which loads and prescribed motions are taken. `work` is memory for one field. Throws InputError
  /// for a prescribed velocity (collective).
  Equilibrium(const model::Model& model, double t, lattice::Field<double>& work);

  /// Takes loads and prescribed motions at another time [s] from now on.
  void set_time(double t);

  std::int64_t size() const { return node_count_ * components_; }
  /// Loads, and forces from prescribed displacements and a mean strain of periodic bodies, on free components: the
  /// right-hand side for what has to be added to both (collective).
  void right_hand_side(double* b, const mechanics::Tensor6& mean_strain = {});
  /// Forces -K u of a field whose ghosts are set, on free components: the right-hand side for what has to be added to
  /// u.
  void right_hand_side(const lattice::Field<double>& u, double* b);
  /// y = P K P x + (I - P) x, P the projection on free components (collective).
  void apply(const double* x, double* y);
  /// Displacements and rotations of a solution, with the prescribed ones.
  void fill(const double* x, lattice::Field<double>& displacement) const;

  /// The unknowns of a field of displacements, zero where they are prescribed.
  void gather(const lattice::Field<double>& displacement, double* x) const;

  /// What counts beside the springs of the lattice from now on; it must outlive this.
  void add(mechanics::AddedForces& added) { added_ = &added; }

  const FixedNodes& fixed() const { return fixed_; }

 private:
  /// Calls use(j, k, force) for every row with its forces -K u.
  template <class F>
  void for_each_row(const lattice::Field<double>& u, F&& use);
  /// b = -K u and what add_loads(j, k, force) adds to row (j, k).
  template <class F>
  void forces(const lattice::Field<double>& u, double* b, F&& add_loads);
  void to_field(const double* x, lattice::Field<double>& field) const;
  /// Number of component 0 of the first node of row (j, k).
  std::int64_t unknown_of(std::int64_t j, std::int64_t k) const;
  // Unknowns per unit of a component: 1, or d/2 for rotations.
  double scale(int component) const { return component < 3 ? 1 : half_d_; }

  const model::Model& model_;
  int components_;
  std::int64_t node_count_;
  double t_, half_d_;
  lattice::Field<double>& work_;
  mechanics::ForceKernel kernel_;
  mechanics::AddedForces* added_ = nullptr;
  FixedNodes fixed_;
  struct Prescribed {
    std::int64_t unknown, node;
    int component, boundary;
    double amount, value;  ///< of its definition, and at the present time
  };
  std::vector<Prescribed> prescribed_;
};

}  // namespace koshi::statics
