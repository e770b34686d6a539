// Compiled once per instruction set with KOSHI_ISA set to its name.
//
// The stiffness of a cell in the Walsh basis. With f^m = sum_s s^m f(s) over the corners s, m = (a, b, c) in {0, 1}^3,
// s^m = s_x^a s_y^b s_z^c, the energy of a cell splits into eight sums, one for each parity P of the motion under the
// three mirrors. In class P the six amplitudes are
//     X, Y, Z = u_x, u_y, u_z of modes P + x, P + y, P + z,   A, B, C = rho_x, rho_y, rho_z of P + y + z, P + x + z,
//     P + x + y
// (bits added modulo 2), S = X + Y + Z, and each spring is a square; with the constants of cell_rows.h:
//     edges along x    P_x = 0: en X^2;  P_x = 1: et ((Y - C)^2 + (Z + B)^2)          and cyclic
//     faces in xy      P_x = P_y: fb (X + Y)^2 + ft ((X + C)^2 + (Y - C)^2);  else ft (Z - A + B)^2   and cyclic
//     body diagonals   P even: bb S^2 + bt ((X - B + C)^2 + (Y - C + A)^2 + (Z - A + B)^2)
//     volume           P = 0: v S^2
// The least-squares rotation makes the energy smallest: C = (Y - X)/2 for P = x + y, and cyclic, and zero otherwise.
#include "mechanics/cell_rows.h"

#include "mechanics/vector64.h"

namespace koshi::mechanics::KOSHI_ISA {
namespace {

// The last element of `before` and all but the last of `v`: what the cells give to their upper corners in x, moved to
// the nodes they belong to.
KOSHI_INLINE Vector<float>::type shifted(const Vector<float>::type& before, const Vector<float>::type& v) {
  return __builtin_shufflevector(before, v, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30);
}
KOSHI_INLINE Vector<double>::type shifted(const Vector<double>::type& before, const Vector<double>::type& v) {
  return __builtin_shufflevector(before, v, 7, 8, 9, 10, 11, 12, 13, 14);
}

/// The constants of `width` cells and what the classes need of them.
template <class V>
struct Constants {
  V en, et, fb, ft, bb, bt, v;
  V t, g;  // et + ft, ft + bt
};

// P = 0 and P = x + y + z: G_X = along X + sum S + turn (C - B), G_A = turn (Y - Z) + own A - spread (A + B + C).
template <class V, bool rotational>
KOSHI_INLINE void symmetric_class(const V& along, const V& sum, const V& turn, const V& own, const V* spread, V& X,
                                  V& Y, V& Z, V& A, V& B, V& C) {
  const V s = sum * (X + Y + Z);
  if constexpr (!rotational) {
    X = along * X + s;
    Y = along * Y + s;
    Z = along * Z + s;
    return;
  }
  V w = turn * (Y - Z), wy = turn * (Z - X), wz = turn * (X - Y);
  X = along * X + s + turn * (C - B);
  Y = along * Y + s + turn * (A - C);
  Z = along * Z + s + turn * (B - A);
  if (spread != nullptr) {
    const V r = *spread * (A + B + C);
    w -= r;
    wy -= r;
    wz -= r;
  }
  A = own * A + w;
  B = own * B + wy;
  C = own * C + wz;
}

// P = x; X is a translation.
template <class V, bool rotational>
KOSHI_INLINE void single_class(const Constants<V>& k, V& X, V& Y, V& Z, V& A, V& B, V& C) {
  const V own = k.en + k.fb + k.ft + k.t;
  const V y = Y, z = Z;
  X = V{};
  Y = own * y + k.fb * z;
  Z = own * z + k.fb * y;
  if constexpr (!rotational) return;
  const V a = k.ft * A, tb = k.t * B, tc = k.t * C;
  Y += 2 * a - tc;
  Z += tb - 2 * a;
  A = 4 * a + k.ft * (2 * (y - z) - B - C);
  B = tb + k.t * z - a;
  C = tc - k.t * y - a;
}

// P = x + y.
template <class V, bool rotational>
KOSHI_INLINE void double_class(const Constants<V>& k, V& X, V& Y, V& Z, V& A, V& B, V& C) {
  const V in_plane = X + Y;
  const V s = k.bb * (in_plane + Z);
  if constexpr (!rotational) {
    X = Y = (0.5f * (k.t + k.g) + k.fb) * in_plane + s;
    Z = (2 * k.et + k.en + k.bt) * Z + s;
    return;
  }
  const V m1 = k.t * (X + C), m2 = k.t * (Y - C);
  const V p = k.g * (X - B + C), q = k.g * (Y - C + A), r = k.bt * (Z - A + B);
  const V e1 = k.et * (Z + B), e2 = k.et * (Z - A);
  const V f = k.fb * in_plane + s;
  X = m1 + p + f;
  Y = m2 + q + f;
  Z = k.en * Z + e1 + e2 + r + s;
  A = q - e2 - r;
  B = e1 - p + r;
  C = (m1 - m2) + (p - q);
}

template <class T, bool rotational>
void forces(const CellRow<T>& row, std::int64_t first, std::int64_t last) {
  using V = typename Vector<T>::type;
  constexpr int components = rotational ? 6 : 3;
  V upper[6][4] = {};  // of the cells before
  std::int64_t i = first;
  for (; i < last; i += width<T>) {
    // To the Walsh basis, mode a + 2 b + 4 c.
    V f[6][8];
    for (int c = 0; c < components; ++c) {
      V even[4], odd[4];
      for (int r = 0; r < 4; ++r) {
        const V low = load(row.u[r] + c * row.u_pitch + i), high = load(row.u[r] + c * row.u_pitch + i + 1);
        even[r] = high + low;
        odd[r] = high - low;
      }
      for (int a = 0; a < 2; ++a) {
        const V* const x = a == 0 ? even : odd;
        const V y0 = x[1] + x[0], y1 = x[1] - x[0], z0 = x[3] + x[2], z1 = x[3] - x[2];
        f[c][a] = z0 + y0;
        f[c][a + 2] = z1 + y1;
        f[c][a + 4] = z0 - y0;
        f[c][a + 6] = z1 - y1;
      }
    }
    const auto constant = [&](int c) { return load(row.constants + c * row.constant_pitch + i); };
    Constants<V> k{constant(0), constant(1), constant(2), constant(3), constant(4), constant(5), constant(6), V{}, V{}};
    k.t = k.et + k.ft;
    k.g = k.ft + k.bt;
    V none{};
    // Amplitude of component c in class P.
    const auto at = [&f](int c, int P) -> V& {
      constexpr int flip[6] = {1, 2, 4, 6, 5, 3};
      return f[c][P ^ flip[c]];
    };
    const auto rotation = [&](int c, int P) -> V& {
      if constexpr (rotational)
        return at(3 + c, P);
      else
        return none;
    };
    symmetric_class<V, rotational>(k.en + k.fb + k.ft + k.g, k.fb + k.bb + k.v, k.g, 2 * k.g + k.bt, &k.bt, at(0, 0),
                                   at(1, 0), at(2, 0), rotation(0, 0), rotation(1, 0), rotation(2, 0));
    symmetric_class<V, rotational>(2 * k.t + k.fb, k.fb, k.t, 2 * k.t, nullptr, at(0, 7), at(1, 7), at(2, 7),
                                   rotation(0, 7), rotation(1, 7), rotation(2, 7));
#pragma GCC unroll 3
    for (int a = 0; a < 3; ++a) {
      const int b = (a + 1) % 3, c = (a + 2) % 3;
      single_class<V, rotational>(k, at(a, 1 << a), at(b, 1 << a), at(c, 1 << a), rotation(a, 1 << a),
                                  rotation(b, 1 << a), rotation(c, 1 << a));
      const int P = (1 << a) + (1 << b);
      double_class<V, rotational>(k, at(a, P), at(b, P), at(c, P), rotation(a, P), rotation(b, P), rotation(c, P));
    }
    // Back to the corners.
    for (int c = 0; c < components; ++c) {
      V corner[2][4];
      for (int a = 0; a < 2; ++a) {
        const V low0 = f[c][a] - f[c][a + 4], low1 = f[c][a + 2] - f[c][a + 6];
        const V high0 = f[c][a] + f[c][a + 4], high1 = f[c][a + 2] + f[c][a + 6];
        corner[a][0] = low0 - low1;
        corner[a][1] = low0 + low1;
        corner[a][2] = high0 - high1;
        corner[a][3] = high0 + high1;
      }
      for (int r = 0; r < 4; ++r) {
        T* const to = row.force[r] + c * row.force_pitch + i;
        const V low = corner[0][r] - corner[1][r], high = corner[0][r] + corner[1][r];
        store(to, load(to) - low - shifted(upper[c][r], high));
        upper[c][r] = high;
      }
    }
  }
  for (int c = 0; c < components; ++c)
    for (int r = 0; r < 4; ++r) row.force[r][c * row.force_pitch + i] -= upper[c][r][width<T> - 1];
}

}  // namespace

extern const CellKernels<float> cell_kernels_float{forces<float, true>, forces<float, false>};
extern const CellKernels<double> cell_kernels_double{forces<double, true>, forces<double, false>};

}  // namespace koshi::mechanics::KOSHI_ISA
