#include "driver/crack_files.h"

#include "base/collective.h"
#include "driver/crack_events.h"
#include "driver/crack_surface.h"
#include "driver/cracked_cells.h"
#include "io/polygon_file.h"
#include "io/summary.h"
#include "lattice/halo.h"

namespace koshi::driver {
namespace {

// Values of the polygons, one for each cell.
io::PolygonValues values_of(const std::vector<CrackedCell>& cells) {
  io::PolygonValues values;
  const auto add = [&](const char* name, double CrackedCell::*member) {
    auto& [column, numbers] = values.emplace_back(name, std::vector<double>{});
    for (const CrackedCell& cell : cells) numbers.push_back(cell.*member);
  };
  add("time", &CrackedCell::moment);
  add("damage", &CrackedCell::damage);
  add("opening", &CrackedCell::opening);
  add("energy", &CrackedCell::energy);
  add("shear", &CrackedCell::shear);
  return values;
}

}  // namespace

nlohmann::ordered_json write_crack_files(const model::Model& model, model::State& state,
                                         std::span<const double> load_factors, const std::filesystem::path& directory) {
  model.lattice.halo->exchange(state.displacement);
  const std::vector<CrackedCell> cells = cracked_cells(model, state);
  const std::vector<CrackEvent> events =
      crack_events(model.lattice.grid, cells,
                   !load_factors.empty()                      ? within_one_rise(load_factors)
                   : model.definition.cracks_in_equilibrium() ? within_one_step()
                                                              : within_window(model));
  io::write_table(model.communicator, directory / "events.csv", event_columns(load_factors),
                  event_rows(events, load_factors));
  if (model.definition.output.crack_surface)
    collectively(model.communicator, [&] {
      if (model.communicator.is_root())
        io::write_polygons(directory / "cracks.vtp", crack_surface(model.lattice.grid, cells), values_of(cells));
    });
  return {{"cells", cells.size()}, {"events", events_summary(events)}};
}

}  // namespace koshi::driver
