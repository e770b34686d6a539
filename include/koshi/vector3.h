// Arithmetic on three-component vectors.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace koshi {

using Vec3 = std::array<double, 3>;        ///< x, y, z
using Int3 = std::array<std::int64_t, 3>;  ///< along x, y, z

/// Axes of the components xx, yy, zz, yz, xz, xy of a symmetric tensor.
inline constexpr std::array<std::array<std::size_t, 2>, 6> tensor_axes{
    {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}};

/// Sum.
constexpr Vec3 operator+(const Vec3& a, const Vec3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
/// Difference.
constexpr Vec3 operator-(const Vec3& a, const Vec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
/// Multiple.
constexpr Vec3 operator*(double f, const Vec3& a) { return {f * a[0], f * a[1], f * a[2]}; }
/// Inner product.
constexpr double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
/// Cross product.
constexpr Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
/// Length.
inline double norm(const Vec3& a) { return std::sqrt(dot(a, a)); }

}  // namespace koshi
