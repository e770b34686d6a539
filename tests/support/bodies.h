// Small bodies for tests.
#pragma once

#include <functional>

#include "koshi/communicator.h"
#include "koshi/spring_lattice.h"
#include "lattice/halo.h"

namespace koshi::test {

inline model::SpringLattice make_body(const Int3& cells, double d, material::Sharing sharing,
                                      material::Kinematics kinematics, std::vector<material::Springs> springs,
                                      const std::function<std::uint16_t(const Int3&)>& material_of,
                                      std::array<bool, 3> periodic = {}) {
  lattice::Grid grid{cells, d, {}, periodic};
  const Communicator world = Communicator::world();
  const auto partition = std::make_shared<const lattice::Partition>(lattice::make_partition(grid, world.size()));
  const auto halo = std::make_shared<const lattice::Halo>(grid, *partition, world);
  model::SpringLattice body = model::make_cells(grid, partition, halo, material_of);
  model::set_springs(body, sharing, kinematics, std::move(springs));
  return body;
}

}  // namespace koshi::test
