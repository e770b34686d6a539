// The paper's Table 1 (E = 1112 MPa, nu = 0.18, 5 x 5 x 9 nodes at 0.2 cm) from public headers and the installed
// library.
#include <cstdio>

#include "koshi/calibration.h"
#include "koshi/error.h"

int main() {
  using namespace koshi;
  const material::Elastic rock{.youngs_modulus = 1112e6, .poissons_ratio = 0.18, .density = 2600};
  const Int3 cells{4, 4, 8};
  const double d = 0.002;

  for (const auto cell : {lattice::CellType::cube_i, lattice::CellType::cube_ii, lattice::CellType::cube_iii}) {
    const auto bonds = material::box_bonds(cell, material::Sharing::plain, cells, d);
    const auto springs =
        material::calibrate(bonds, material::box_volume(cells, d), rock, material::default_equations(cell));
    std::printf("%s kn %.3f kt %.3f\n", lattice::name(cell).data(), springs.kn / 1e6, springs.kt / 1e6);
  }

  // An error of the library reaches the consumer as the type its header declares.
  try {
    material::springs_for(lattice::CellType::cube_i, material::Calibration::isotropic, material::Kinematics::rotational,
                          {.youngs_modulus = -1}, d);
  } catch (const InputError& error) {
    std::puts("negative modulus refused");
  }
}
