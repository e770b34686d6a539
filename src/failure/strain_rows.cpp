// Compiled once per instruction set with KOSHI_ISA set to its name.
#include "failure/strain_rows.h"

#include <cmath>

#include "mechanics/vector.h"

namespace koshi::failure::KOSHI_ISA {
namespace {

using Values = mechanics::KOSHI_ISA::Vector<double>::type;
constexpr std::int64_t lanes = mechanics::KOSHI_ISA::width<double>;

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

// Of the elements of a vector and one number more, in pairs.
template <class Choose>
double chosen(const Values& values, double other, Choose&& choose) {
  double left[lanes];
  mechanics::KOSHI_ISA::store(left, values);
  for (std::int64_t half = lanes / 2; half > 0; half /= 2)
    for (std::int64_t l = 0; l < half; ++l) left[l] = choose(left[l], left[l + half]);
  return choose(left[0], other);
}

void range(const double* x, std::int64_t count, double* low, double* high) {
  const auto lesser = [](const auto& a, const auto& b) { return a < b ? a : b; };
  const auto greater = [](const auto& a, const auto& b) { return a > b ? a : b; };
  Values least[2]{Values{} + x[0], Values{} + x[0]}, most[2]{least[0], least[0]};
  std::int64_t i = 0;
  for (; i + 2 * lanes <= count; i += 2 * lanes)
    for (std::int64_t v = 0; v < 2; ++v) {
      const Values at = mechanics::KOSHI_ISA::load(x + i + v * lanes);
      least[v] = lesser(least[v], at);
      most[v] = greater(most[v], at);
    }
  double least_left = x[0], most_left = x[0];
  for (; i < count; ++i) {
    least_left = lesser(least_left, x[i]);
    most_left = greater(most_left, x[i]);
  }
  *low = chosen(lesser(least[0], least[1]), least_left, lesser);
  *high = chosen(greater(most[0], most[1]), most_left, greater);
}

}  // namespace

extern const StrainRows functions{rows, range};

}  // namespace koshi::failure::KOSHI_ISA
