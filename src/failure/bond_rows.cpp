// Compiled once per instruction set with KOSHI_ISA set to its name.
#include "failure/bond_rows.h"

namespace koshi::failure::KOSHI_ISA {
namespace {

// r.D/|D|^2 with r = u_1 - u_2: the rotation across D adds nothing along it.
void stretches(const BondRow& row, const BondSlot& slot, std::int64_t count, double* __restrict stretch) {
  const double *const x = row.u, *const y = x + row.component, *const z = y + row.component;
  const double Dx = slot.D[0], Dy = slot.D[1], Dz = slot.D[2];
  const double square = Dx * Dx + Dy * Dy + Dz * Dz, a = Dx / square, b = Dy / square, c = Dz / square;
  const std::ptrdiff_t to = slot.to;
  for (std::int64_t i = 0; i < count; ++i) {
    const double e = a * (x[i] - x[i + to]) + b * (y[i] - y[i + to]) + c * (z[i] - z[i + to]);
    stretch[i] = e > stretch[i] ? e : stretch[i];
  }
}

// (|r|^2 - (r.D)^2/|D|^2)/|D|^2 with r = u_1 - u_2 - (w_1 + w_2)/2 x D.
void shears(const BondRow& row, const BondSlot& slot, std::int64_t count, double* __restrict shear) {
  const double *const x = row.u, *const y = x + row.component, *const z = y + row.component;
  const double *const p = z + row.component, *const q = p + row.component, *const s = q + row.component;
  const double Dx = slot.D[0], Dy = slot.D[1], Dz = slot.D[2];
  const double over = 1 / (Dx * Dx + Dy * Dy + Dz * Dz);
  const std::ptrdiff_t to = slot.to;
  for (std::int64_t i = 0; i < count; ++i) {
    const double wx = 0.5 * (p[i] + p[i + to]), wy = 0.5 * (q[i] + q[i + to]), wz = 0.5 * (s[i] + s[i + to]);
    const double rx = x[i] - x[i + to] - (wy * Dz - wz * Dy);
    const double ry = y[i] - y[i + to] - (wz * Dx - wx * Dz);
    const double rz = z[i] - z[i + to] - (wx * Dy - wy * Dx);
    const double along = rx * Dx + ry * Dy + rz * Dz;
    const double square = over * (rx * rx + ry * ry + rz * rz - over * along * along);
    shear[i] = square > shear[i] ? square : shear[i];
  }
}

void rows(const BondRow& row, const BondSlot* slots, std::size_t slot_count, std::int64_t count, double* stretch,
          double* shear) {
  for (std::int64_t i = 0; i < count; ++i) stretch[i] = 0;
  for (std::size_t b = 0; b < slot_count; ++b) stretches(row, slots[b], count, stretch);
  if (shear == nullptr) return;
  for (std::int64_t i = 0; i < count; ++i) shear[i] = 0;
  for (std::size_t b = 0; b < slot_count; ++b) shears(row, slots[b], count, shear);
}

}  // namespace

extern const BondRows bonds{rows};

}  // namespace koshi::failure::KOSHI_ISA
