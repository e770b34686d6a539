// Young's modulus by direction as a surface.
#pragma once

#include <nlohmann/json.hpp>

#include "koshi/directional.h"

namespace koshi::report {

/// A `mesh` of the data block (docs/formats/report-data.md): points E(n) n over the largest E, with Young's modulus and
/// the three wave speeds upon them. C is not singular, the density above 0.
nlohmann::ordered_json directional_surface(const material::ElasticTensor& C, double density);

}  // namespace koshi::report
