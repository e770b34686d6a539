#include "model/memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include "koshi/model.h"
#include "model/regions.h"

namespace koshi::model {
namespace {

// A process before it holds a model, with its libraries [bytes].
constexpr double process = 35e6;

// The static solver's levels and vectors beside the model and the state [bytes per node and component].
constexpr double solver = 60;

// Bytes per node of the fields of a sample: those that are computed, and the copies that go to the file.
double sample_bytes(const Definition& definition) {
  double bytes = 0;
  for (const std::string& name : definition.output.fields) {
    const bool tensor = name == "stress" || name == "strain";
    const int components = tensor ? 6 : name == "energy" ? 1 : 3;
    const bool in_state = name == "displacement" || name == "velocity" || name == "rotation";
    bytes += 8 * components * (in_state ? 1 : 2);
    if (name == "reaction") bytes += 24;  // moments, which are not written
  }
  return bytes;
}

double available_memory() {
  std::ifstream file("/proc/meminfo");
  std::string key;
  double kilobytes = 0;
  while (file >> key) {
    if (key == "MemAvailable:" && file >> kilobytes) return 1024 * kilobytes;
    file.ignore(256, '\n');
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace

double predicted_memory(const Definition& definition, int ranks) {
  const lattice::Grid grid = make_grid(definition);
  const Int3 nodes = grid.nodes();
  const lattice::Layout whole({0, 0, 0}, nodes);
  const bool rotational = definition.lattice.kinematics == material::Kinematics::rotational;
  const bool statics = definition.analysis.type == AnalysisDefinition::Type::statics;
  const int components = rotational ? 6 : 3, inertias = rotational ? 2 : 1;

  // The cell and its bonds; inertia; displacement and velocity. Explicit runs keep the inverse inertia as well.
  double bytes = 1 + lattice::slot_count + 8 * inertias + 16 * components;
  const bool orients = std::count(definition.output.fields.begin(), definition.output.fields.end(), "orientation") != 0;
  bytes += statics ? solver * components : 8 * inertias + (orients ? 32 : 0);
  const double count = static_cast<double>(nodes[0] * nodes[1]) * static_cast<double>(nodes[2]);
  return process * ranks + bytes * static_cast<double>(whole.size()) + sample_bytes(definition) * count;
}

void check_memory(const Definition& definition, int ranks) {
  const double needed = predicted_memory(definition, ranks), available = available_memory();
  if (needed <= available) return;
  const double spacing = definition.lattice.spacing * std::cbrt(needed / available);
  throw InputError(
      definition.places.find("lattice.spacing"),
      fmt::format("the run needs {:.3g} GB of memory and {:.3g} GB are free; a spacing of about {:.3g} m would fit",
                  needed / 1e9, available / 1e9, 1.02 * spacing));
}

}  // namespace koshi::model
