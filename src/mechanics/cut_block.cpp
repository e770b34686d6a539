// Compiled once per instruction set with KOSHI_ISA set to its name.
//
// In a cell with x, y, z from its centre in half edges the trilinear displacement is u_i = sum_p A_i^p x^p, p = (a, b,
// c) in {0, 1}^3. Its derivatives, and so strain and stress, are polynomials in
//     1, x, y, z, yz, xz, xy                                                                     (numbers 0 ... 6)
// and an integral of the product of two over the part inside is a sum of moments. With E_ij^r the coefficients of the
// strain and S_ij^r those of the stress, the energy of the part is 4 d /2 sum S_ij^r m_(r + s) E_ij^s.
#include "mechanics/cut_block.h"

#include "mechanics/vector.h"
#include "model/moments.h"

namespace koshi::mechanics::KOSHI_ISA {
namespace {

using V = Vector<double>::type;
using model::moment_index;
using model::Powers;

constexpr int monomials = 7;
constexpr Powers powers_of(int r) { return model::moment_powers[static_cast<std::size_t>(r)]; }
/// Number of the moment of the product of two.
constexpr auto product = [] {
  std::array<std::array<int, monomials>, monomials> table{};
  for (int r = 0; r < monomials; ++r)
    for (int s = 0; s < monomials; ++s) {
      const Powers p = powers_of(r), q = powers_of(s);
      table[static_cast<std::size_t>(r)][static_cast<std::size_t>(s)] = moment_index({p.x + q.x, p.y + q.y, p.z + q.z});
    }
  return table;
}();
/// Number of the monomial x^p, p as bits.
constexpr int number_of(int p) { return moment_index({p & 1, p >> 1 & 1, p >> 2}); }

/// Those that a derivative along an axis has: what is left of p = axis + ... when its bit is taken.
struct Derivative {
  int number[4], of[4];
};
constexpr Derivative derivative(int axis) {
  Derivative d{};
  int count = 0;
  for (int p = 0; p < 8; ++p)
    if ((p >> axis & 1) != 0) {
      d.number[count] = number_of(p & ~(1 << axis));
      d.of[count++] = p;
    }
  return d;
}
constexpr Derivative along[3] = {derivative(0), derivative(1), derivative(2)};

/// Sums over corners with the signs of all p; or the other way.
template <bool forth>
KOSHI_INLINE void butterfly(V* v) {
  for (int bit = 1; bit < 8; bit *= 2)
    for (int p = 0; p < 8; ++p) {
      if ((p & bit) != 0) continue;
      const V low = v[p], high = v[p + bit];
      v[p] = forth ? high + low : low - high;
      v[p + bit] = forth ? high - low : low + high;
    }
}

/// Axes after one, in turn.
constexpr int next(int axis) { return (axis + 1) % 3; }

KOSHI_INLINE void cell(CutBlock& block, int lane) {
  const auto at = [lane](CutLanes& lanes) { return load(lanes + lane); };
  V A[3][8], m[23], H[3][8];
  for (int i = 0; i < 3; ++i) {
    for (int a = 0; a < 8; ++a) A[i][a] = 0.125 * at(block.u[i][a]);
    butterfly<true>(A[i]);
  }
  for (int q = 0; q < 23; ++q) m[q] = at(block.moments[q]);
  const V part = at(block.part), whole = at(block.whole);
  const auto constant = [&](int q) { return at(block.constants[q]); };
  const V bulk = part * constant(0), shear = part * constant(1), cross = part * constant(2);

  // Strains along the axes without a third of the dilatation; the stress of the mean dilatation.
  V stretch[3][monomials] = {}, dilatation[monomials] = {};
  for (int i = 0; i < 3; ++i)
    for (int q = 0; q < 4; ++q) stretch[i][along[i].number[q]] = A[i][along[i].of[q]];
  V mean = {};
  for (int r = 0; r < monomials; ++r) {
    dilatation[r] = stretch[0][r] + stretch[1][r] + stretch[2][r];
    mean += m[r] * dilatation[r];
  }
  const V pressure = bulk * mean / m[0];
  for (int i = 0; i < 3; ++i)
    for (int r = 0; r < monomials; ++r) stretch[i][r] = shear * (stretch[i][r] - (1.0 / 3) * dilatation[r]);

  // Stresses along the axes times the monomials of the derivative of u_i, over the part inside.
  for (int i = 0; i < 3; ++i) {
    for (int p = 0; p < 8; ++p) H[i][p] = V{};
    for (int q = 0; q < 4; ++q) {
      const int s = along[i].number[q];
      V sum = pressure * m[s];
      for (int r = 0; r < monomials; ++r) sum += m[product[r][s]] * stretch[i][r];
      H[i][along[i].of[q]] += sum;
    }
  }
  // Shear stresses.
  for (int i = 0; i < 3; ++i) {
    const int j = next(i);
    V slide[monomials] = {}, stress[monomials];
    for (int q = 0; q < 4; ++q) slide[along[j].number[q]] += A[i][along[j].of[q]];
    for (int q = 0; q < 4; ++q) slide[along[i].number[q]] += A[j][along[i].of[q]];
    for (int s = 0; s < monomials; ++s) {
      V sum = {};
      // Of the seven monomials the product of x_i and x_j is missing.
      for (int r = 0; r < monomials; ++r)
        if (r != number_of(1 << i | 1 << j) && s != number_of(1 << i | 1 << j)) sum += m[product[r][s]] * slide[r];
      stress[s] = cross * sum;
    }
    for (int q = 0; q < 4; ++q) H[i][along[j].of[q]] += stress[along[j].number[q]];
    for (int q = 0; q < 4; ++q) H[j][along[i].of[q]] += stress[along[i].number[q]];
  }

  // Less the springs of the whole cell: amplitudes p + x_i of u_i belong together.
  for (int P = 0; P < 8; ++P) {
    const int bits = (P & 1) + (P >> 1 & 1) + (P >> 2);
    V a[3], sum = {};
    for (int i = 0; i < 3; ++i) a[i] = A[i][P ^ 1 << i];
    V h[3];
    if (bits == 0 || bits == 3) {
      const V own = constant(bits == 0 ? 3 : 9), other = constant(bits == 0 ? 4 : 10);
      sum = a[0] + a[1] + a[2];
      for (int i = 0; i < 3; ++i) h[i] = (own - other) * a[i] + other * sum;
    } else if (bits == 1) {
      // The component along the axis is a translation.
      const int x = P == 1 ? 0 : P == 2 ? 1 : 2, y = (x + 1) % 3, z = (x + 2) % 3;
      h[x] = V{};
      h[y] = constant(5) * a[y] + constant(6) * a[z];
      h[z] = constant(5) * a[z] + constant(6) * a[y];
    } else {
      const int z = P == 6 ? 0 : P == 5 ? 1 : 2, x = (z + 1) % 3, y = (z + 2) % 3;
      h[x] = h[y] = constant(7) * (a[x] + a[y]);
      h[z] = constant(8) * a[z];
    }
    for (int i = 0; i < 3; ++i) H[i][P ^ 1 << i] -= whole * h[i];
  }
  for (int i = 0; i < 3; ++i) {
    butterfly<false>(H[i]);
    for (int a = 0; a < 8; ++a) store(block.u[i][a] + lane, -0.125 * H[i][a]);
  }
}

void forces(CutBlock& block) {
  for (int lane = 0; lane < cut_lanes; lane += width<double>) cell(block, lane);
}

}  // namespace

extern const CutKernels cut_kernels{forces};

}  // namespace koshi::mechanics::KOSHI_ISA
