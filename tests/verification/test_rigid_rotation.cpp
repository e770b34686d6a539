// What a finite rigid rotation costs the two kinematics: both are of small rotations, and the price is known.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "koshi/model.h"
#include "mechanics/cell_stress.h"
#include "mechanics/force_kernel.h"
#include "support/cases.h"

namespace koshi {
namespace {

using material::Kinematics;

// u = (R - 1) X with node rotations w = angle a. A bond sees r = u1 - u2 - w x D =
// (cos - 1) D_across - (angle - sin) a x D: a strain cos - 1 in the plane of the turn, density 2 (lam + mu) (1 -
// cos)^2, and with node rotations the misfit angle - sin between nodes and body, 1/2 kt (angle - sin)^2 |a x D|^2 a
// bond; the two do not mix. The fit has no misfit. 10 degrees leave a strain of 1.5 %, 1 degree 1.5e-4, 0.1
// degree 1.5e-6.
TEST(RigidRotation, LeavesTheStrainOfItsCosine) {
  const double d = 0.002;
  int checked = 0;
  for (const auto kinematics : {Kinematics::rotational, Kinematics::least_squares})
    for (const double degrees : {0.1, 1.0, 10.0}) {
      model::Definition definition = test::block({4, 3, 5}, d, {1112e6, 0.3, 2000});
      definition.lattice.kinematics = kinematics;
      const model::Model model = model::make_model(definition, Communicator::world());
      const double angle = degrees * std::numbers::pi / 180, c = std::cos(angle) - 1, s = std::sin(angle);
      lattice::Field<double> u(model.layout(), model.components()), force(model.layout(), model.components());
      lattice::for_each_owned(model.layout(), [&](auto i, auto j, auto k, auto n) {
        const Vec3 X = model.lattice.grid.position({i, j, k});
        u.component(0)[n] = c * X[0] - s * X[1];
        u.component(1)[n] = s * X[0] + c * X[1];
        if (model.components() == 6) u.component(5)[n] = angle;
      });
      mechanics::ForceKernel kernel(model.lattice);
      kernel.apply(u, force);
      double energy = 0;
      lattice::for_each_owned(model.layout(), [&](auto, auto, auto, auto n) {
        for (int i = 0; i < model.components(); ++i) energy -= 0.5 * u.component(i)[n] * force.component(i)[n];
      });

      const material::Elastic& rock = model.materials[1];
      double density = 2 * (rock.lambda() + rock.mu()) * c * c;
      if (kinematics == Kinematics::rotational)
        for (const lattice::Slot& slot : lattice::slots)
          density += 0.5 * model.lattice.springs[1].kt[slot.family] * (angle - s) * (angle - s) *
                     (slot.s[0] * slot.s[0] + slot.s[1] * slot.s[1]) / d;
      // u F adds products of 1e-4 m that cancel down to strains of c; hence the tolerance.
      EXPECT_NEAR(energy / model.volume() / density, 1, 1e-14 / (c * c) + 1e-12) << degrees;
      const mechanics::CellState cell = mechanics::cell_state(model.lattice, u, model.layout().index(1, 1, 1));
      EXPECT_NEAR(cell.strain[0], c, 1e-14);
      EXPECT_NEAR(cell.strain[2], 0, 1e-14);
      ++checked;
    }
  EXPECT_EQ(checked, 6);
}

}  // namespace
}  // namespace koshi
