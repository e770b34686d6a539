#include "driver/surface_file.h"

#include <array>
#include <cstring>

#include "base/collective.h"
#include "io/polygon_file.h"
#include "lattice/halo.h"
#include "mechanics/surface_stress.h"
#include "model/region_surface.h"
#include "model/surface_loads.h"

namespace koshi::driver {
namespace {

// Values of a piece, on their way to the rank that writes.
struct Record {
  std::int64_t piece = 0;
  std::array<double, 9> value{};  // displacement, then stress
};

std::vector<model::SurfacePiece> all_pieces(const model::Model& model) {
  std::vector<model::SurfacePiece> pieces;
  for (std::size_t r = 0; r < model.definition.regions.size(); ++r)
    for (model::SurfacePiece& piece : surface_of(model.definition, model.lattice.grid, static_cast<int>(r)))
      pieces.push_back(std::move(piece));
  return pieces;
}

// Those of pieces in cells that this rank owns.
std::vector<Record> values_of(const model::Model& model, const model::State& state,
                              const std::vector<model::SurfacePiece>& pieces) {
  const lattice::Layout& layout = model.layout();
  const lattice::Grid& grid = model.lattice.grid;
  std::vector<std::int64_t> own, cells;
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    const Int3 local = layout.local(pieces[p].cell);
    if (!layout.owns(local)) continue;
    own.push_back(static_cast<std::int64_t>(p));
    cells.push_back(layout.index(local));
  }
  mechanics::SurfaceStress surface(model.lattice, cells);
  surface.update(state.displacement);
  std::vector<Record> records;
  for (std::size_t p = 0; p < own.size(); ++p) {
    const model::SurfacePiece& piece = pieces[static_cast<std::size_t>(own[p])];
    Record& record = records.emplace_back();
    record.piece = own[p];
    const auto shares = model::corner_shares(grid, piece.cell, piece.at);
    for (int corner = 0; corner < 8; ++corner) {
      const std::int64_t node = cells[p] + layout.offset({corner & 1, corner >> 1 & 1, corner >> 2});
      for (int c = 0; c < 3; ++c)
        record.value[static_cast<std::size_t>(c)] +=
            shares[static_cast<std::size_t>(corner)].weight * state.displacement.component(c)[node];
    }
    const Vec3 from_corner = (1 / grid.d) * (piece.at - grid.position(piece.cell));
    const auto stress = surface.at(cells[p], from_corner - Vec3{0.5, 0.5, 0.5}).stress;
    std::copy(stress.begin(), stress.end(), record.value.begin() + 3);
  }
  return records;
}

}  // namespace

void write_surface(const model::Model& model, model::State& state, const std::filesystem::path& directory) {
  model.lattice.halo->exchange(state.displacement);
  const std::vector<model::SurfacePiece> pieces = all_pieces(model);
  const std::vector<Record> own = values_of(model, state, pieces);
  std::string bytes(own.size() * sizeof(Record), '\0');
  if (!own.empty()) std::memcpy(bytes.data(), own.data(), bytes.size());
  bytes = model.communicator.gather(bytes);
  collectively(model.communicator, [&] {
    if (!model.communicator.is_root()) return;
    std::vector<Record> records(bytes.size() / sizeof(Record));
    if (!records.empty()) std::memcpy(records.data(), bytes.data(), bytes.size());
    io::PolygonValues values{{"displacement", std::vector<double>(3 * pieces.size())},
                             {"stress", std::vector<double>(6 * pieces.size())}};
    for (const Record& record : records) {
      std::copy_n(record.value.begin(), 3, values[0].second.begin() + 3 * record.piece);
      std::copy_n(record.value.begin() + 3, 6, values[1].second.begin() + 6 * record.piece);
    }
    std::vector<std::vector<Vec3>> polygons;
    for (const model::SurfacePiece& piece : pieces) polygons.push_back(piece.corners);
    io::write_polygons(directory / "surface.vtp", polygons, values);
  });
}

}  // namespace koshi::driver
