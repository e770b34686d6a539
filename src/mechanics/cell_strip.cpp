// Compiled once per instruction set with KOSHI_ISA set to its name.
//
// The stiffness of a cell in the Walsh basis. With f^m = sum_s s^m f(s) over the corners s, m = (a, b, c) in {0, 1}^3,
// s^m = s_x^a s_y^b s_z^c, the energy of a cell splits into eight sums, one for each parity P of the motion under the
// three mirrors. In class P the six amplitudes are
//     X, Y, Z = u_x, u_y, u_z of modes P + x, P + y, P + z,   A, B, C = rho_x, rho_y, rho_z of P + y + z, P + x + z,
//     P + x + y
// (bits added modulo 2), S = X + Y + Z, and each spring is a square; with the constants of cell_strip.h:
//     edges along x    P_x = 0: en X^2;  P_x = 1: et ((Y - C)^2 + (Z + B)^2)          and cyclic
//     faces in xy      P_x = P_y: fb (X + Y)^2 + ft ((X + C)^2 + (Y - C)^2);  else ft (Z - A + B)^2   and cyclic
//     body diagonals   P even: bb S^2 + bt ((X - B + C)^2 + (Y - C + A)^2 + (Z - A + B)^2)
//     volume           P = 0: v S^2
// The least-squares rotation makes the energy smallest: C = (Y - X)/2 for P = x + y, and cyclic, and zero otherwise.
#include "mechanics/cell_strip.h"

#include "mechanics/vector.h"

namespace koshi::mechanics::KOSHI_ISA {
namespace {

// What the classes need of the constants, with t = et + ft and g = ft + bt; the first eight serve the least-squares
// rotation.
enum Prepared {
  along_0,  // en + fb + ft + g
  sum_0,    // fb + bb + v
  along_7,  // 2 t + fb
  fb,
  own_1,    // en + fb + ft + t
  sum_sum,  // (t + g)/2 + fb + bb
  bb,       // 0 where strain is not tied
  third,    // 2 et + en + bt + bb
  g,
  own_0,  // 2 g + bt
  bt,
  t,
  axial_1,  // en + fb + ft
  ft,
  half_g,      // 0 where strain is not tied
  turn_third,  // et + bt
  turn_turn,   // (et + g)/2 + bt
  et,
  strain_turn  // g; 0 where strain is not tied
};
static_assert(strain_turn < prepared_constants);

template <class T>
KOSHI_INLINE void store_prepared(const typename Vector<T>::type* k, T tied, T* to) {
  const auto en_ = k[0], et_ = k[1], fb_ = k[2], ft_ = k[3], bb_ = k[4], bt_ = k[5], v_ = k[6];
  const auto t_ = et_ + ft_, g_ = ft_ + bt_, axial = en_ + fb_ + ft_;
  const T half = T(0.5);
  const auto put = [to](int q, const auto& value) { store(to + q * strip_cells, value); };
  put(along_0, axial + g_);
  put(sum_0, fb_ + bb_ + v_);
  put(along_7, t_ + t_ + fb_);
  put(fb, fb_);
  put(own_1, axial + t_);
  put(sum_sum, half * (t_ + g_) + (fb_ + bb_));
  put(bb, tied * bb_);
  put(third, (et_ + et_) + (en_ + bt_) + bb_);
  put(g, g_);
  put(own_0, g_ + g_ + bt_);
  put(bt, bt_);
  put(t, t_);
  put(axial_1, axial);
  put(ft, ft_);
  put(half_g, tied * half * g_);
  put(turn_third, et_ + bt_);
  put(turn_turn, half * (et_ + g_) + bt_);
  put(et, et_);
  put(strain_turn, tied * g_);
}

template <class T>
void prepare(const std::uint16_t* material, const float* factor, const T* table, T tied, std::int64_t cells,
             T* prepared) {
  using V = typename Vector<T>::type;
  constexpr std::int64_t lanes = width<T>;
  constexpr int parts = (table_constants + lanes - 1) / lanes;
  for (std::int64_t i = 0; i < cells; i += lanes) {
    // A row of constants for each cell becomes a row of cells for each constant.
    V constants[parts * lanes];
    for (int part = 0; part < parts; ++part) {
      V* const block = constants + part * lanes;
      for (std::int64_t cell = 0; cell < lanes; ++cell)
        block[cell] = load(table + table_constants * material[i + cell] + part * lanes);
      transpose<T>(block);
    }
    if (factor != nullptr) {
      const V s = widened<T>(factor + i);
      for (int q = 0; q < cell_constants; ++q) constants[q] *= s;
    }
    store_prepared<T>(constants, tied, prepared + i);
  }
}

template <class T>
void prepare_rows(const T* constants, std::ptrdiff_t pitch, T tied, std::int64_t cells, T* prepared) {
  for (std::int64_t i = 0; i < cells; i += width<T>) {
    typename Vector<T>::type k[cell_constants];
    for (int q = 0; q < cell_constants; ++q) k[q] = load(constants + q * pitch + i);
    store_prepared<T>(k, tied, prepared + i);
  }
}

template <class T, bool scaled>
KOSHI_INLINE void transform_component(T half_d, const T* low, const T* high, std::int64_t cells, T* to) {
  using V = typename Vector<T>::type;
  // The row in the next plane, which no layer has read yet, is fetched on the way.
  const T* const next = high + (high - low);
  for (std::int64_t i = 0; i < cells; i += width<T>) {
    __builtin_prefetch(next + i, 0, 2);
    V l0 = load(low + i), l1 = load(low + i + 1), h0 = load(high + i), h1 = load(high + i + 1);
    if constexpr (scaled) {
      l0 *= half_d;
      h0 *= half_d;
      l1 *= half_d;
      h1 *= half_d;
    }
    const V le = l1 + l0, lo = l1 - l0, he = h1 + h0, ho = h1 - h0;
    store(to + i, he + le);
    store(to + strip_cells + i, ho + lo);
    store(to + 2 * strip_cells + i, he - le);
    store(to + 3 * strip_cells + i, ho - lo);
  }
}

template <class T>
void transform(int components, T half_d, const NodeRow<const T>& low, const NodeRow<const T>& high, std::int64_t cells,
               T* values) {
  for (int c = 0; c < components; ++c) {
    const T *const l = low.at + c * low.component, *const h = high.at + c * high.component;
    T* const to = values + c * pair_values * strip_cells;
    c < 3 ? transform_component<T, false>(half_d, l, h, cells, to)
          : transform_component<T, true>(half_d, l, h, cells, to);
  }
}

/// Constants of a vector of cells.
template <class T>
struct Constants {
  const T* at;
  KOSHI_INLINE typename Vector<T>::type operator[](Prepared q) const { return load(at + q * strip_cells); }
};

// P = 0.
template <class T, bool rotational, class V>
KOSHI_INLINE void class_0(const Constants<T>& k, V& X, V& Y, V& Z, V& A, V& B, V& C) {
  const V s = k[sum_0] * (X + Y + Z), along = k[along_0];
  if constexpr (!rotational) {
    X = along * X + s;
    Y = along * Y + s;
    Z = along * Z + s;
    return;
  }
  const V turn = k[strain_turn], own = k[own_0];
  const V r = k[bt] * (A + B + C);
  const V yz = Y - Z, zx = Z - X, xy = X - Y;
  X = along * X + (turn * (C - B) + s);
  Y = along * Y + (turn * (A - C) + s);
  Z = along * Z + (turn * (B - A) + s);
  A = own * A + (turn * yz - r);
  B = own * B + (turn * zx - r);
  C = own * C + (turn * xy - r);
}

// P = x + y + z.
template <class T, bool rotational, class V>
KOSHI_INLINE void class_7(const Constants<T>& k, V& X, V& Y, V& Z, V& A, V& B, V& C) {
  const V s = k[fb] * (X + Y + Z), along = k[along_7];
  if constexpr (!rotational) {
    X = along * X + s;
    Y = along * Y + s;
    Z = along * Z + s;
    return;
  }
  const V turn = k[t];
  const V yz = Y - Z, zx = Z - X, xy = X - Y;
  X = along * X + (turn * (C - B) + s);
  Y = along * Y + (turn * (A - C) + s);
  Z = along * Z + (turn * (B - A) + s);
  const T two = 2;
  A = turn * (two * A + yz);
  B = turn * (two * B + zx);
  C = turn * (two * C + xy);
}

// P = x; X is a translation.
template <class T, bool rotational, class V>
KOSHI_INLINE void single_class(const Constants<T>& k, V& X, V& Y, V& Z, V& A, V& B, V& C) {
  X = V{};
  const V y = Y, z = Z;
  if constexpr (!rotational) {
    const V own = k[own_1], both = k[fb];
    Y = own * y + both * z;
    Z = own * z + both * y;
    return;
  }
  const T two = 2, four = 4;
  const V axial = k[axial_1], both = k[fb], turn = k[t], face = k[ft];
  const V u = B + z, v = y - C;
  const V tu = turn * u, tv = turn * v, a = face * A;
  Y = axial * y + (both * z + (two * a + tv));
  Z = axial * z + (both * y + (tu - two * a));
  A = face * ((y - z) + (v - u)) + four * a;
  B = tu - a;
  C = -tv - a;
}

// P = x + y, in the sums and differences s = X + Y, M = X - Y + 2 C, a = A - B, b = A + B.
template <class T, bool rotational, class V>
KOSHI_INLINE void double_class(const Constants<T>& k, V& X, V& Y, V& Z, V& A, V& B, V& C) {
  const V s = X + Y;
  const V kss = k[sum_sum], ksz = k[bb], kzz = k[third];
  if constexpr (!rotational) {
    const V z = Z;
    X = Y = kss * s + ksz * z;
    Z = ksz * s + kzz * z;
    return;
  }
  const T two = 2, half = T(0.5);
  const V m = X - Y, a = A - B, b = A + B, z = Z;
  const V M = two * C + m;
  const V gd = k[g] * (M - b);
  const V hM = k[t] * M + gd, hb = k[et] * b - gd;
  const V ksa = k[half_g], kza = k[turn_third], kaa = k[turn_turn];
  const V hs = kss * s + (ksz * z + ksa * a);
  const V ha = ksa * s + (kaa * a - kza * z);
  Z = ksz * s + (kzz * z - kza * a);
  X = half * hM + hs;
  Y = hs - half * hM;
  A = half * hb + ha;
  B = half * hb - ha;
  C = hM;
}

// Classes P and P + y, P without y: both need the same values, one the even, the other the odd sums over y.
template <class T, bool rotational, int P>
KOSHI_INLINE void two_classes(const T* constants, const T* lower, const T* upper, std::int64_t cells, T* pending,
                              T* force) {
  using V = typename Vector<T>::type;
  constexpr int components = rotational ? 6 : 3;
  constexpr int flip[6] = {1, 2, 4, 6, 5, 3};
  // Where the values of component c stand.
  constexpr auto place = [](int c) {
    constexpr int bits[6] = {1, 2, 4, 6, 5, 3};
    const int mode = P ^ bits[c];
    return (pair_values * c + (mode & 1) + 2 * (mode >> 2)) * strip_cells;
  };
  for (std::int64_t i = 0; i < cells; i += width<T>) {
    V f[2][6];  // amplitudes of P and of P + y
    for (int c = 0; c < components; ++c) {
      const V old = load(lower + place(c) + i), fresh = load(upper + place(c) + i);
      const int odd = flip[c] >> 1 & 1;
      f[odd][c] = fresh + old;
      f[1 - odd][c] = fresh - old;
    }
    const Constants<T> k{constants + i};
    V *const p = f[0], *const q = f[1];
    if constexpr (P == 0) {
      class_0<T, rotational>(k, p[0], p[1], p[2], p[3], p[4], p[5]);
      single_class<T, rotational>(k, q[1], q[2], q[0], q[4], q[5], q[3]);
    } else if constexpr (P == 1) {
      single_class<T, rotational>(k, p[0], p[1], p[2], p[3], p[4], p[5]);
      double_class<T, rotational>(k, q[0], q[1], q[2], q[3], q[4], q[5]);
    } else if constexpr (P == 4) {
      single_class<T, rotational>(k, p[2], p[0], p[1], p[5], p[3], p[4]);
      double_class<T, rotational>(k, q[1], q[2], q[0], q[4], q[5], q[3]);
    } else {
      double_class<T, rotational>(k, p[2], p[0], p[1], p[5], p[3], p[4]);
      class_7<T, rotational>(k, q[0], q[1], q[2], q[3], q[4], q[5]);
    }
    for (int c = 0; c < components; ++c) {
      const int odd = flip[c] >> 1 & 1;
      const V even_part = f[odd][c], odd_part = f[1 - odd][c];
      T* const waiting = pending + place(c) + i;
      store(force + place(c) + i, (odd_part - even_part) - load(waiting));
      store(waiting, even_part + odd_part);
    }
  }
}

template <class T, bool rotational>
void add_cells(const T* constants, const T* lower, const T* upper, std::int64_t cells, T* pending, T* force) {
  two_classes<T, rotational, 0>(constants, lower, upper, cells, pending, force);
  two_classes<T, rotational, 1>(constants, lower, upper, cells, pending, force);
  two_classes<T, rotational, 4>(constants, lower, upper, cells, pending, force);
  two_classes<T, rotational, 5>(constants, lower, upper, cells, pending, force);
}

template <class T>
void cells(int components, const T* constants, const T* lower, const T* upper, std::int64_t count, T* pending,
           T* force) {
  (components == 6 ? add_cells<T, true> : add_cells<T, false>)(constants, lower, upper, count, pending, force);
}

template <class T, bool scaled, bool first>
KOSHI_INLINE void deliver_component(T half_d, const T* values, std::int64_t cells, T& low_carry, T& high_carry, T* low,
                                    T* high) {
  using V = typename Vector<T>::type;
  V low_before = last_lane<T>(low_carry), high_before = last_lane<T>(high_carry);
  for (std::int64_t i = 0; i < cells; i += width<T>) {
    const V e0 = load(values + i), o0 = load(values + strip_cells + i), e1 = load(values + 2 * strip_cells + i),
            o1 = load(values + 3 * strip_cells + i);
    const V le = e0 - e1, lo = o0 - o1, he = e0 + e1, ho = o0 + o1;
    const V low_upper = le + lo, high_upper = he + ho;
    V low_sum = (le - lo) + shifted<T>(low_before, low_upper);
    V high_sum = (he - ho) + shifted<T>(high_before, high_upper);
    if constexpr (scaled) {
      low_sum *= half_d;
      high_sum *= half_d;
    }
    store(low + i, first ? low_sum : load(low + i) + low_sum);
    store(high + i, high_sum);
    low_before = low_upper;
    high_before = high_upper;
  }
  low_carry = low_before[width<T> - 1];
  high_carry = high_before[width<T> - 1];
}

template <class T, bool first>
KOSHI_INLINE void deliver_rows(int components, T half_d, const T* values, std::int64_t cells, T* carry,
                               const NodeRow<T>& low, const NodeRow<T>& high) {
  for (int c = 0; c < components; ++c) {
    const T* const from = values + c * pair_values * strip_cells;
    T *const l = low.at + c * low.component, *const h = high.at + c * high.component;
    c < 3 ? deliver_component<T, false, first>(half_d, from, cells, carry[c], carry[6 + c], l, h)
          : deliver_component<T, true, first>(half_d, from, cells, carry[c], carry[6 + c], l, h);
  }
}

template <class T>
void deliver(int components, T half_d, const T* values, std::int64_t cells, bool first, T* carry, const NodeRow<T>& low,
             const NodeRow<T>& high) {
  (first ? deliver_rows<T, true> : deliver_rows<T, false>)(components, half_d, values, cells, carry, low, high);
}

}  // namespace

extern const StripKernels<float> strip_kernels_float{prepare<float>, prepare_rows<float>, transform<float>,
                                                     cells<float>, deliver<float>};
extern const StripKernels<double> strip_kernels_double{prepare<double>, prepare_rows<double>, transform<double>,
                                                       cells<double>, deliver<double>};

}  // namespace koshi::mechanics::KOSHI_ISA
