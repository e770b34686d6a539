// Compiled once per instruction set with KOSHI_ISA set to its name. Loops run over whole vectors of `width` nodes, so
// no remainder loop rounds differently and a node's force does not depend on its place in the row.
#include "mechanics/row_kernels.h"

#include <type_traits>

#define KOSHI_TEXT_(x) #x
#define KOSHI_TEXT(x) KOSHI_TEXT_(x)

namespace koshi::mechanics::KOSHI_ISA {
namespace {

template <class T>
constexpr std::int64_t width = 64 / static_cast<std::int64_t>(sizeof(T));

// First multiple of 8 at or below x: rows start at i = -8.
constexpr std::int64_t aligned(std::int64_t x) { return x >= 0 ? x / 8 * 8 : -((-x + 7) / 8 * 8); }

// --- Constant coefficients ------------------------------------------------------------------------------------------
//
// The nine rows of a field around the node's row are first combined over y and z into sums (even) and differences
// (odd). Every output is r(i) + g(i+1) + g(i-1) + h(i+1) - h(i-1), where r, g, h are combinations of those rows at the
// node, so the shifts along x come last and act on combined rows only.

template <class T>
struct Combined {
  T c;                                      // the row itself
  T even_y, odd_y;                          // rows y+1 and y-1: sum, difference
  T even_z, odd_z;                          // rows z+1 and z-1
  T even, odd_y_even_z, even_y_odd_z, odd;  // the four diagonal rows

  inline __attribute__((always_inline)) Combined(const T* f, std::ptrdiff_t y, std::ptrdiff_t z) {
    c = f[0];
    even_y = f[y] + f[-y];
    odd_y = f[y] - f[-y];
    even_z = f[z] + f[-z];
    odd_z = f[z] - f[-z];
    const T upper_even = f[y + z] + f[z - y], upper_odd = f[y + z] - f[z - y];
    const T lower_even = f[y - z] + f[-y - z], lower_odd = f[y - z] - f[-y - z];
    even = upper_even + lower_even;
    even_y_odd_z = upper_even - lower_even;
    odd_y_even_z = upper_odd + lower_odd;
    odd = upper_odd - lower_odd;
  }
};

// One output component: r, g, h above.
template <class T>
struct Output {
  T r = 0, g = 0, h = 0;
};

template <class T>
inline __attribute__((always_inline)) void add_vector(const typename Stencil<T>::Vector& k, const Combined<T>& x,
                                                      const Combined<T>& y, const Combined<T>& z, Output<T> (&out)[3]) {
  // Component x: its own axis is the row's.
  const T cross_x = x.even_y + x.even_z;
  out[0].r += k.centre * x.c + k.edge_across * cross_x + k.face_across * x.even;
  out[0].g += k.edge_along * x.c + k.face_along * cross_x + k.body * x.even;
  out[0].h += k.face_mixed * (y.odd_y + z.odd_z) + k.body_mixed * (y.odd_y_even_z + z.even_y_odd_z);
  out[1].h += k.face_mixed * x.odd_y + k.body_mixed * x.odd_y_even_z;
  out[2].h += k.face_mixed * x.odd_z + k.body_mixed * x.even_y_odd_z;
  // Components y and z.
  out[1].r += k.centre * y.c + k.edge_along * y.even_y + k.edge_across * y.even_z + k.face_along * y.even +
              k.face_mixed * z.odd;
  out[1].g +=
      k.edge_across * y.c + k.face_along * y.even_y + k.face_across * y.even_z + k.body * y.even + k.body_mixed * z.odd;
  out[2].r += k.centre * z.c + k.edge_along * z.even_z + k.edge_across * z.even_y + k.face_along * z.even +
              k.face_mixed * y.odd;
  out[2].g +=
      k.edge_across * z.c + k.face_along * z.even_z + k.face_across * z.even_y + k.body * z.even + k.body_mixed * y.odd;
}

// sum_o c(o) o x v(o).
template <class T>
inline __attribute__((always_inline)) void add_cross(const typename Stencil<T>::Cross& k, const Combined<T>& x,
                                                     const Combined<T>& y, const Combined<T>& z, Output<T> (&out)[3]) {
  out[0].r += k.edge * (z.odd_y - y.odd_z) + k.face * (z.odd_y_even_z - y.even_y_odd_z);
  out[0].g += k.face * (z.odd_y - y.odd_z) + k.body * (z.odd_y_even_z - y.even_y_odd_z);
  out[1].r += k.edge * x.odd_z + k.face * x.even_y_odd_z;
  out[1].g += k.face * x.odd_z + k.body * x.even_y_odd_z;
  out[1].h -= k.edge * z.c + k.face * (z.even_y + z.even_z) + k.body * z.even;
  out[2].r -= k.edge * x.odd_y + k.face * x.odd_y_even_z;
  out[2].g -= k.face * x.odd_y + k.body * x.odd_y_even_z;
  out[2].h += k.edge * y.c + k.face * (y.even_y + y.even_z) + k.body * y.even;
}

template <class T, bool rotational>
void uniform(const Stencil<T>& stencil, const Row<T>& row, std::int64_t first, std::int64_t last,
             const Scratch<T>& scratch, T* const force[6]) {
  constexpr int components = rotational ? 6 : 3;
  const Stencil<T> k = stencil;
  const std::ptrdiff_t y = row.pitch, z = row.plane;
  const T* const u0 = row.u[0];
  const T* const u1 = row.u[1];
  const T* const u2 = row.u[2];
  const T* const w0 = rotational ? row.u[3] : nullptr;
  const T* const w1 = rotational ? row.u[4] : nullptr;
  const T* const w2 = rotational ? row.u[5] : nullptr;

  // Combine the rows. The next row's newest neighbour, which no row has read yet, is fetched on the way.
  for (std::int64_t begin = aligned(first - 1); begin < last + 1; begin += width<T>) {
    for (int c = 0; c < components; ++c) __builtin_prefetch(row.u[c] + begin + 2 * y + z, 0, 2);
#pragma GCC ivdep
    for (std::int64_t i = begin; i < begin + width<T>; ++i) {
      Output<T> F[3], M[3];
      {
        const Combined<T> ux(u0 + i, y, z), uy(u1 + i, y, z), uz(u2 + i, y, z);
        add_vector<T>(k.displacement, ux, uy, uz, F);
        if constexpr (rotational) add_cross<T>(k.coupling, ux, uy, uz, M);
      }
      if constexpr (rotational) {
        const Combined<T> wx(w0 + i, y, z), wy(w1 + i, y, z), wz(w2 + i, y, z);
        add_vector<T>(k.rotation, wx, wy, wz, M);
        add_cross<T>(k.coupling, wx, wy, wz, F);
      }
      for (int c = 0; c < components; ++c) {
        const Output<T>& out = c < 3 ? F[c] : M[c - 3];
        scratch.stencil[3 * c][i] = out.r;
        scratch.stencil[3 * c + 1][i] = out.g + out.h;
        scratch.stencil[3 * c + 2][i] = out.g - out.h;
      }
    }
  }
  // Shift along x.
  for (int c = 0; c < components; ++c) {
    const T* const r = scratch.stencil[3 * c];
    const T* const ahead = scratch.stencil[3 * c + 1];
    const T* const behind = scratch.stencil[3 * c + 2];
    T* const f = force[c];
#pragma GCC ivdep
    for (std::int64_t i = first; i < last; ++i) f[i] = (r[i] + ahead[i + 1]) + behind[i - 1];
  }
}

// One node: the lanes are the components of its force, with a chain of additions for each component it reads.
template <class T, bool rotational>
void face(const FaceStencil<T>& stencil, const Row<T>& row, std::int64_t i, T* const force[6]) {
  constexpr int components = rotational ? 6 : 3;
  using Vector __attribute__((vector_size(FaceStencil<T>::lanes * sizeof(T)))) = T;
  Vector sum[components] = {};
  int neighbour = 0;
  for (int z = -1; z <= 1; ++z)
    for (int y = -1; y <= 1; ++y)
      for (int x = 0; x <= 1; ++x, ++neighbour) {
        const std::ptrdiff_t at = i + x * stencil.toward + y * row.pitch + z * row.plane;
        for (int c = 0; c < components; ++c) {
          Vector column;
          __builtin_memcpy(&column, stencil.column[neighbour][c], sizeof column);
          sum[c] += column * row.u[c][at];
        }
      }
  Vector total = (sum[0] + sum[1]) + sum[2];
  if constexpr (rotational) total += (sum[3] + sum[4]) + sum[5];
  for (int c = 0; c < components; ++c) force[c][i] = total[c];
}

// --- Bonds of any class
// -----------------------------------------------------------------------------------------------

template <int slot>
constexpr int direction(int axis) {
  constexpr int s[13][3] = {{1, 0, 0}, {0, 1, 0},  {0, 0, 1}, {1, 1, 0},  {-1, 1, 0}, {1, 0, 1},  {-1, 0, 1},
                            {0, 1, 1}, {0, -1, 1}, {1, 1, 1}, {-1, 1, 1}, {1, -1, 1}, {-1, -1, 1}};
  return s[slot][axis];
}

// Several nodes at once; short runs of nodes, as at the ends of rows, take short vectors.
template <class T, int lanes>
struct Simd {
  using Integer = std::conditional_t<sizeof(T) == 8, std::int64_t, std::int32_t>;
  using Vector __attribute__((vector_size(lanes * sizeof(T)))) = T;
  using Index __attribute__((vector_size(lanes * sizeof(T)))) = Integer;
  using Bytes __attribute__((vector_size(lanes))) = std::uint8_t;

  static inline __attribute__((always_inline)) Vector load(const T* p) {
    Vector v;
    __builtin_memcpy(&v, p, sizeof v);
    return v;
  }

  static inline __attribute__((always_inline)) void store(T* p, const Vector& v) { __builtin_memcpy(p, &v, sizeof v); }
  static inline __attribute__((always_inline)) void add(T* p, const Vector& v) { store(p, load(p) + v); }

  static constexpr int scattered = 0;  // table of any size

  // Entries of a table for the given bonds. It is held in one register or two; a larger one is read lane by lane.
  template <int registers>
  static inline __attribute__((always_inline)) Vector look_up(const T* table, std::uint8_t first,
                                                              const std::uint8_t* bond) {
    Vector v;
    if constexpr (registers == scattered) {
      for (int i = 0; i < lanes; ++i) v[i] = table[bond[i]];
    } else {
      Bytes entry;
      __builtin_memcpy(&entry, bond, sizeof entry);
      entry = entry > first ? entry - first : Bytes{};
      const Index index = __builtin_convertvector(entry, Index);
      if constexpr (registers == 1)
        v = __builtin_shuffle(load(table + first), index);
      else
        v = __builtin_shuffle(load(table + first), load(table + first + lanes), index);
    }
    return v;
  }
};

// Adds the bonds of one direction, forward (sign +1) or backward, to the nodes from `begin` on. With D = -d s the
// relative displacement is r = u1 - u2 + d/2 (w1 + w2) x s; the force on the node is -F, its moment -d/2 s x F.
template <class T, int lanes, bool rotational, int edge_registers, int other_registers, int slot, int sign>
inline __attribute__((always_inline)) void add_bond(const Tables<T>& tables, const Row<T>& row, std::int64_t begin,
                                                    typename Simd<T, lanes>::Vector (&F)[6]) {
  using S = Simd<T, lanes>;
  using Vector = typename S::Vector;
  constexpr int ox = sign * direction<slot>(0), oy = sign * direction<slot>(1), oz = sign * direction<slot>(2);
  constexpr T sx = ox, sy = oy, sz = oz;
  const std::ptrdiff_t to = ox + row.pitch * oy + row.plane * oz;
  constexpr int family = ox * ox + oy * oy + oz * oz - 1, registers = family == 0 ? edge_registers : other_registers;
  const typename Tables<T>::Family& classes = tables.family[family];
  const std::uint8_t* const bond = row.bond[slot] + begin + (sign > 0 ? 0 : to);
  const Vector kt = S::template look_up<registers>(classes.kt, classes.first, bond);
  const Vector kb = S::template look_up<registers>(classes.kb, classes.first, bond);
  const auto difference = [&](int c) { return S::load(row.u[c] + begin) - S::load(row.u[c] + begin + to); };
  const T h = tables.half_d;
  Vector rx = difference(0), ry = difference(1), rz = difference(2);
  if constexpr (rotational) {
    const auto mean = [&](int c) { return h * (S::load(row.u[c] + begin) + S::load(row.u[c] + begin + to)); };
    const Vector wx = mean(3), wy = mean(4), wz = mean(5);
    rx += wy * sz - wz * sy;
    ry += wz * sx - wx * sz;
    rz += wx * sy - wy * sx;
  }
  const Vector along = kb * (rx * sx + ry * sy + rz * sz);
  const Vector fx = kt * rx + along * sx, fy = kt * ry + along * sy, fz = kt * rz + along * sz;
  F[0] -= fx;
  F[1] -= fy;
  F[2] -= fz;
  if constexpr (rotational) {
    F[3] -= h * (fz * sy - fy * sz);
    F[4] -= h * (fx * sz - fz * sx);
    F[5] -= h * (fy * sx - fx * sy);
  }
}

template <class T, int lanes, bool rotational, int edge_registers, int other_registers, int slot = 0>
inline __attribute__((always_inline)) void add_bonds(const Tables<T>& tables, const Row<T>& row, std::int64_t begin,
                                                     typename Simd<T, lanes>::Vector (&F)[6]) {
  if constexpr (slot < 13) {
    add_bond<T, lanes, rotational, edge_registers, other_registers, slot, 1>(tables, row, begin, F);
    add_bond<T, lanes, rotational, edge_registers, other_registers, slot, -1>(tables, row, begin, F);
    add_bonds<T, lanes, rotational, edge_registers, other_registers, slot + 1>(tables, row, begin, F);
  }
}

template <class T, int lanes, bool rotational, int edge_registers, int other_registers>
void bonds_with(const Tables<T>& tables, const Row<T>& row, std::int64_t first, std::int64_t last, T* const force[6]) {
  for (std::int64_t begin = first; begin < last; begin += lanes) {
    typename Simd<T, lanes>::Vector F[6] = {};
    add_bonds<T, lanes, rotational, edge_registers, other_registers>(tables, row, begin, F);
    for (int c = 0; c < (rotational ? 6 : 3); ++c) __builtin_memcpy(force[c] + begin, &F[c], sizeof F[c]);
  }
}

template <class T, bool rotational>
void bonds(const Tables<T>& tables, const Row<T>& row, std::int64_t first, std::int64_t last, T* const force[6]) {
  constexpr int lanes = width<T>, scattered = Simd<T, lanes>::scattered;
  const int edges = tables.family[0].size, faces = tables.family[1].size, bodies = tables.family[2].size;
  const int others = faces > bodies ? faces : bodies;
  if (last - first <= 2)
    bonds_with<T, 2, rotational, scattered, scattered>(tables, row, first, last, force);
  else if (edges <= lanes && others <= lanes)
    bonds_with<T, lanes, rotational, 1, 1>(tables, row, first, last, force);
  else if (edges <= 2 * lanes && others <= 2 * lanes)
    bonds_with<T, lanes, rotational, 2, 2>(tables, row, first, last, force);
  else if (others <= 2 * lanes)
    bonds_with<T, lanes, rotational, scattered, 2>(tables, row, first, last, force);
  else
    bonds_with<T, lanes, rotational, scattered, scattered>(tables, row, first, last, force);
}

// --- Cells
// ------------------------------------------------------------------------------------------------------------
//
// The linear field fitted to a cell's corners has the gradient du_i/dx_j = 1/(4d) sum_s s_j u_i(s). A node row touches
// four rows of cells; in each, the cell before and the cell after a node in x.

// Sums over the four corners of a cell's low or high x face, with the signs of y and z.
template <class T>
struct CellRow {
  using S = Simd<T, width<T>>;
  const T *near, *y, *z, *far;  // the four node rows of the row of cells
  CellRow(const T* u, std::ptrdiff_t pitch, std::ptrdiff_t plane)
      : near(u), y(u + pitch), z(u + plane), far(u + pitch + plane) {}
  auto even(std::int64_t i) const { return (S::load(near + i) + S::load(y + i)) + (S::load(z + i) + S::load(far + i)); }
  auto odd_y(std::int64_t i) const {
    return (S::load(y + i) - S::load(near + i)) + (S::load(far + i) - S::load(z + i));
  }
  auto odd_z(std::int64_t i) const {
    return (S::load(z + i) - S::load(near + i)) + (S::load(far + i) - S::load(y + i));
  }
};

// Calls kernel<registers> for the number of registers that hold a table of materials.
template <class T, class Kernel>
inline __attribute__((always_inline)) void with_materials(const Tables<T>& tables, Kernel&& kernel) {
  constexpr int lanes = width<T>;
  if (tables.materials <= lanes)
    kernel(std::integral_constant<int, 1>{});
  else
    kernel(std::integral_constant<int, Simd<T, lanes>::scattered>{});
}

template <class T, int registers>
void volumetric_with(const Tables<T>& tables, const Row<T>& row, std::int64_t first, std::int64_t last,
                     const Scratch<T>& scratch, T* const force[6]) {
  using S = Simd<T, width<T>>;
  using Vector = typename S::Vector;
  for (int side = 0; side < 4; ++side) {
    const int below_y = side & 1, below_z = side >> 1;
    const std::ptrdiff_t at = -below_y * row.pitch - below_z * row.plane;
    const CellRow<T> ux(row.u[0] + at, row.pitch, row.plane), uy(row.u[1] + at, row.pitch, row.plane),
        uz(row.u[2] + at, row.pitch, row.plane);
    T* const p = scratch.cell[0];
    // p = kappa d^2 theta / 4 with theta = (sum_s s . u) / (4 d).
    for (std::int64_t i = aligned(first - 1); i < last; i += width<T>) {
      const Vector kappa = S::template look_up<registers>(tables.volumetric, 0, row.cell + at + i);
      S::store(p + i, kappa * ((ux.even(i + 1) - ux.even(i)) + (uy.odd_y(i) + uy.odd_y(i + 1)) +
                               (uz.odd_z(i) + uz.odd_z(i + 1))));
    }
    // Force -p s on the cell's corner s; the node is the upper corner of cells below it.
    const T sy = below_y ? 1 : -1, sz = below_z ? 1 : -1;
    for (std::int64_t i = first; i < last; i += width<T>) {
      const Vector after = S::load(p + i), before = S::load(p + i - 1), sum = after + before;
      S::add(force[0] + i, after - before);
      S::add(force[1] + i, -sy * sum);
      S::add(force[2] + i, -sz * sum);
    }
  }
}

template <class T>
void volumetric(const Tables<T>& tables, const Row<T>& row, std::int64_t first, std::int64_t last,
                const Scratch<T>& scratch, T* const force[6]) {
  with_materials(
      tables, [&](auto registers) { volumetric_with<T, registers.value>(tables, row, first, last, scratch, force); });
}

template <class T, int registers>
void fit_with(const Tables<T>& tables, const Row<T>& row, std::int64_t first, std::int64_t last,
              const Scratch<T>& scratch, T* const force[6]) {
  using S = Simd<T, width<T>>;
  using Vector = typename S::Vector;
  for (int side = 0; side < 4; ++side) {
    const int below_y = side & 1, below_z = side >> 1;
    const std::ptrdiff_t at = -below_y * row.pitch - below_z * row.plane;
    const CellRow<T> ux(row.u[0] + at, row.pitch, row.plane), uy(row.u[1] + at, row.pitch, row.plane),
        uz(row.u[2] + at, row.pitch, row.plane);
    T *const ax = scratch.cell[0], *const ay = scratch.cell[1], *const az = scratch.cell[2];
    // a = q d w with 8 d w = sum_s s x u and q = kt1/4 + kt2 + kt3.
    for (std::int64_t i = aligned(first - 1); i < last; i += width<T>) {
      const Vector q = S::template look_up<registers>(tables.fit, 0, row.cell + at + i);
      S::store(ax + i, q * ((uz.odd_y(i) + uz.odd_y(i + 1)) - (uy.odd_z(i) + uy.odd_z(i + 1))));
      S::store(ay + i, q * ((ux.odd_z(i) + ux.odd_z(i + 1)) - (uz.even(i + 1) - uz.even(i))));
      S::store(az + i, q * ((uy.even(i + 1) - uy.even(i)) - (ux.odd_y(i) + ux.odd_y(i + 1))));
    }
    // Force a x s; s_x = +1 for the cell before the node, -1 for the one after it.
    const T sy = below_y ? 1 : -1, sz = below_z ? 1 : -1;
    for (std::int64_t i = first; i < last; i += width<T>) {
      const auto sum = [i](const T* a) { return S::load(a + i) + S::load(a + i - 1); };
      const auto difference = [i](const T* a) { return S::load(a + i - 1) - S::load(a + i); };
      S::add(force[0] + i, sz * sum(ay) - sy * sum(az));
      S::add(force[1] + i, difference(az) - sz * sum(ax));
      S::add(force[2] + i, sy * sum(ax) - difference(ay));
    }
  }
}

template <class T>
void fit(const Tables<T>& tables, const Row<T>& row, std::int64_t first, std::int64_t last, const Scratch<T>& scratch,
         T* const force[6]) {
  with_materials(tables,
                 [&](auto registers) { fit_with<T, registers.value>(tables, row, first, last, scratch, force); });
}

}  // namespace

extern const RowKernels<double> kernels_double{
    uniform<double, true>, uniform<double, false>, face<double, true>, face<double, false>,  bonds<double, true>,
    bonds<double, false>,  volumetric<double>,     fit<double>,        KOSHI_TEXT(KOSHI_ISA)};
extern const RowKernels<float> kernels_float{
    uniform<float, true>, uniform<float, false>, face<float, true>, face<float, false>,   bonds<float, true>,
    bonds<float, false>,  volumetric<float>,     fit<float>,        KOSHI_TEXT(KOSHI_ISA)};

}  // namespace koshi::mechanics::KOSHI_ISA
