#include "mechanics/plain_fit.h"

#include "koshi/vector3.h"
#include "mechanics/cell_bonds.h"

namespace koshi::mechanics {
namespace {

Vec3 sign_of(int corner) { return {corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0, corner & 4 ? 1.0 : -1.0}; }

}  // namespace

template <class T>
void add_plain_fit(const model::SpringLattice& body, const lattice::Field<T>& u, std::int64_t j, std::int64_t k,
                   std::int64_t first, std::int64_t last, T* const force[6]) {
  const lattice::Layout& layout = body.layout;
  const double d = body.grid.d;
  const std::uint8_t* cell = body.cell.component(0);
  std::array<std::int64_t, 8> corner_offset;
  for (int corner = 0; corner < 8; ++corner)
    corner_offset[corner] = layout.offset({corner & 1, corner >> 1 & 1, corner >> 2});

  for (std::int64_t i = first; i < last; ++i)
    for (int own = 0; own < 8; ++own) {
      // The cell in which the node is corner `own`.
      const std::int64_t c = layout.index(i, j, k) - corner_offset[own];
      if (cell[c] == 0) continue;
      std::array<Vec3, 8> corner;
      Vec3 w{};
      for (int a = 0; a < 8; ++a) {
        for (int x = 0; x < 3; ++x) corner[a][x] = static_cast<double>(u.component(x)[c + corner_offset[a]]);
        w = w + (1 / (8 * d)) * cross(sign_of(a), corner[a]);
      }
      // Moment of the bonds about w, and the node's own bonds.
      Vec3 moment{}, arm{};
      for (const CellBond& bond : cell_bonds) {
        const double kt = cell_part(body, bond.slot, c + corner_offset[bond.a], cell[c]).kt;
        const auto& s = lattice::slots[bond.slot].s;
        const Vec3 D = -d * Vec3{static_cast<double>(s[0]), static_cast<double>(s[1]), static_cast<double>(s[2])};
        moment = moment + kt * cross(D, corner[bond.a] - corner[bond.b] - cross(w, D));
        if (bond.a == own) arm = arm + kt * D;
        if (bond.b == own) arm = arm - kt * D;
      }
      const Vec3 F = cross(w, arm) + (1 / (8 * d)) * cross(moment, sign_of(own));
      for (int x = 0; x < 3; ++x) force[x][i] += static_cast<T>(F[x]);
    }
}

template void add_plain_fit<double>(const model::SpringLattice&, const lattice::Field<double>&, std::int64_t,
                                    std::int64_t, std::int64_t, std::int64_t, double* const[6]);
template void add_plain_fit<float>(const model::SpringLattice&, const lattice::Field<float>&, std::int64_t,
                                   std::int64_t, std::int64_t, std::int64_t, float* const[6]);

}  // namespace koshi::mechanics
