// Compiled once per instruction set with KOSHI_ISA set to its name.
#include "failure/strain_rows.h"

#include <algorithm>
#include <cmath>

namespace koshi::failure::KOSHI_ISA {
namespace {

void rows(const StrainRow& row, double scale, std::int64_t cells, double* __restrict mean, double* __restrict radius) {
  const std::ptrdiff_t y = row.component, z = 2 * row.component;
  const double *const a = row.u[0], *const b = row.u[1], *const c = row.u[2], *const d = row.u[3];
  // Four times the mean over the cell of the derivatives of one component, from its corners; (2.5).
  const auto along_x = [=](std::int64_t i) {
    return (a[i + 1] - a[i]) + (b[i + 1] - b[i]) + (c[i + 1] - c[i]) + (d[i + 1] - d[i]);
  };
  const auto along_y = [=](std::int64_t i) {
    return (b[i + 1] + b[i]) - (a[i + 1] + a[i]) + (d[i + 1] + d[i]) - (c[i + 1] + c[i]);
  };
  const auto along_z = [=](std::int64_t i) {
    return (c[i + 1] + c[i]) - (a[i + 1] + a[i]) + (d[i + 1] + d[i]) - (b[i + 1] + b[i]);
  };
  for (std::int64_t i = 0; i < cells; ++i) {
    const double xx = along_x(i), yy = along_y(i + y), zz = along_z(i + z);
    const double yz = along_z(i + y) + along_y(i + z), xz = along_z(i) + along_x(i + z),
                 xy = along_y(i) + along_x(i + y);
    const double p = (xx + yy + zz) * (1.0 / 3);
    const double deviator =
        (xx - p) * (xx - p) + (yy - p) * (yy - p) + (zz - p) * (zz - p) + 0.5 * (yz * yz + xz * xz + xy * xy);
    mean[i] = scale * p;
    radius[i] = scale * std::sqrt(2.0 / 3 * deviator);
  }
}

double largest_square(const double* x, std::ptrdiff_t component, std::int64_t count) {
  // Lanes of their own, since a maximum in order cannot be taken by vectors.
  constexpr std::int64_t lanes = 16;
  double largest[lanes]{};
  const double *const y = x + component, *const z = y + component;
  const auto square = [=](std::int64_t i) { return x[i] * x[i] + y[i] * y[i] + z[i] * z[i]; };
  std::int64_t i = 0;
  for (; i + lanes <= count; i += lanes)
    for (std::int64_t l = 0; l < lanes; ++l) {
      const double s = square(i + l);
      largest[l] = s > largest[l] ? s : largest[l];
    }
  for (; i < count; ++i) largest[0] = square(i) > largest[0] ? square(i) : largest[0];
  return *std::max_element(largest, largest + lanes);
}

}  // namespace

extern const StrainRows functions{rows, largest_square};

}  // namespace koshi::failure::KOSHI_ISA
