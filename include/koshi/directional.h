// What an elastic solid does along a direction.
#pragma once

#include <optional>

#include "koshi/calibration.h"
#include "koshi/vector3.h"

namespace koshi::material {

/// E [Pa] for tension along a direction of any length but 0; nothing when C is singular.
std::optional<double> youngs_modulus(const ElasticTensor& C, const Vec3& direction);

/// Speeds [m/s] of the plane waves along a direction (of any length but 0), the fastest first.
Vec3 wave_speeds(const ElasticTensor& C, double density, const Vec3& direction);

}  // namespace koshi::material
