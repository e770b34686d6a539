// Compiled once per instruction set with KOSHI_ISA set to its name.
#include "mechanics/plain_rows.h"

#include "mechanics/bond_law.h"

namespace koshi::mechanics::KOSHI_ISA {
namespace {

// With node rotations the whole force of a bond, else that of the displacements without any rotation.
template <bool rotational>
inline void add(const BondRow& row) {
  constexpr int components = rotational ? 6 : 3;
  const double *near[components], *far[components];
  double* __restrict force[components];
  for (int c = 0; c < components; ++c) {
    near[c] = row.u + c * row.pitch;
    far[c] = near[c] + row.to;
    force[c] = row.force[c];
  }
  const Vec3 D{row.D[0], row.D[1], row.D[2]};
  const std::int64_t nodes = (row.nodes + 7) / 8 * 8;
#pragma GCC ivdep
  for (std::int64_t i = 0; i < nodes; ++i) {
    Vec3 w{};
    if constexpr (rotational)
      w = {0.5 * (near[3][i] + far[3][i]), 0.5 * (near[4][i] + far[4][i]), 0.5 * (near[5][i] + far[5][i])};
    const Vec3 r = relative_displacement({near[0][i], near[1][i], near[2][i]}, {far[0][i], far[1][i], far[2][i]}, w, D);
    const Vec3 F = bond_force(row.kn[i], row.kt[i], D, r);
    force[0][i] -= F[0];
    force[1][i] -= F[1];
    force[2][i] -= F[2];
    if constexpr (rotational) {
      const Vec3 M = bond_moment(D, F);
      force[3][i] += M[0];
      force[4][i] += M[1];
      force[5][i] += M[2];
    }
  }
}

void add_bonds(const BondRow& row, int components) { components == 6 ? add<true>(row) : add<false>(row); }

}  // namespace

extern const PlainKernels plain_kernels{add_bonds};

}  // namespace koshi::mechanics::KOSHI_ISA
