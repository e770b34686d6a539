// An effective stiffness on the page.
#pragma once

#include <nlohmann/json.hpp>

namespace koshi::report {

/// Adds tables, curves and the surface of Young's modulus of the object of a stiffness.json. Throws json::exception
/// when it has another form than Koshi gives it.
void add_stiffness(const nlohmann::ordered_json& stiffness, nlohmann::ordered_json& data);

}  // namespace koshi::report
