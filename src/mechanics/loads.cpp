#include "mechanics/loads.h"

#include <algorithm>

#include "koshi/vector3.h"
#include "model/profiled_loads.h"

namespace koshi::mechanics {

LoadRows::LoadRows(const model::Model& model) : model_(model), factor_(model.loads.size(), 0) {
  for (std::size_t l = 0; l < model.loads.size(); ++l) {
    const model::Load& load = model.loads[l];
    rows_.emplace_back(model.layout(), load.forces, [](const model::NodeForce& f) { return f.node; });
    profile_.emplace_back();
    forces_.emplace_back();
    if (!load.profiled) continue;
    profile_.back().emplace(model.definition.loads[l].profile);
    forces_.back() = load.forces;
  }
}

void LoadRows::set_time(double t) {
  acceleration_ = {};
  for (std::size_t l = 0; l < model_.loads.size(); ++l) {
    factor_[l] = model::factor(model_.loads[l].history, t);
    if (profile_[l]) model::set_forces(*model_.loads[l].profiled, *profile_[l], t, scratch_, forces_[l]);
    acceleration_ = acceleration_ + factor_[l] * model_.loads[l].acceleration;
  }
}

bool LoadRows::touch(std::int64_t j, std::int64_t k) const {
  const std::int64_t row = j + model_.layout().owned()[1] * k;
  return acceleration_ != Vec3{} ||
         std::ranges::any_of(rows_, [&](const RowIndex& rows) { return rows.begin(row) != rows.end(row); });
}

void LoadRows::add(std::int64_t j, std::int64_t k, double* const* force) const {
  const lattice::Layout& layout = model_.layout();
  const std::int64_t row = j + layout.owned()[1] * k;
  const std::int64_t first_node = layout.index(0, j, k);
  for (std::size_t l = 0; l < rows_.size(); ++l) {
    const std::vector<model::NodeForce>& forces = profile_[l] ? forces_[l] : model_.loads[l].forces;
    for (std::size_t e = rows_[l].begin(row); e < rows_[l].end(row); ++e) {
      const model::NodeForce& load = forces[e];
      for (int c = 0; c < 3; ++c) force[c][load.node - first_node] += factor_[l] * load.force[c];
    }
  }
  if (acceleration_ == Vec3{}) return;
  const double* mass = model_.inertia.component(0) + first_node;
  for (int c = 0; c < 3; ++c)
    for (std::int64_t i = 0; i < layout.owned()[0]; ++i) force[c][i] += acceleration_[c] * mass[i];
}

}  // namespace koshi::mechanics
