#include "driver/stiffness_studies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "io/cell_mixtures.h"
#include "koshi/error.h"
#include "model/regions.h"

namespace koshi::driver {
namespace {

/// What a global cell of a model is.
class Cells {
 public:
  explicit Cells(const model::Model& model)
      : material_(model::material_of_cells(model.definition, model.lattice.grid)),
        factor_(model::factor_of_cells(model.definition, model.lattice.grid)),
        share_(model::density_share_of_cells(model.definition, model.lattice.grid)) {}
  std::uint16_t material(const Int3& cell) const { return material_(cell); }
  float factor(const Int3& cell) const { return factor_ ? factor_(cell) : 1.0F; }
  float share(const Int3& cell) const { return share_ ? static_cast<float>(share_(cell)) : 1.0F; }
  bool partly_filled() const { return factor_ || share_; }

 private:
  std::function<std::uint16_t(const Int3&)> material_;
  std::function<float(const Int3&)> factor_;
  std::function<double(Int3)> share_;
};

template <class F>
void for_each_cell(const Int3& cells, F&& f) {
  for (std::int64_t k = 0; k < cells[2]; ++k)
    for (std::int64_t j = 0; j < cells[1]; ++j)
      for (std::int64_t i = 0; i < cells[0]; ++i) f(Int3{i, j, k});
}

// The definition of a body that is given cell by cell, still without cells.
model::Definition without_cells(const model::Model& model, const Int3& cells, double d) {
  model::Definition definition = model.definition;
  definition.lattice.spacing = d;
  model::BodyDefinition body;
  body.origin = definition.body.origin;
  body.periodic = definition.body.periodic;
  body.mixtures = definition.body.mixtures;
  for (std::size_t a = 0; a < 3; ++a) body.size[a] = d * static_cast<double>(cells[a]);
  definition.body = body;
  definition.regions.clear();
  return definition;
}

}  // namespace

model::Definition coarser(const model::Model& model) {
  const lattice::Grid& grid = model.lattice.grid;
  Int3 cells{};
  for (std::size_t a = 0; a < 3; ++a) {
    cells[a] = grid.cells[a] / 2;
    if (2 * cells[a] != grid.cells[a])
      throw InputError(
          model.definition.places.find("body"),
          fmt::format("the body has {} x {} x {} cells, but those of twice the side need even numbers; crop "
                      "it, or leave out --coarser",
                      grid.cells[0], grid.cells[1], grid.cells[2]));
  }
  model::Definition definition = without_cells(model, cells, 2 * grid.d);
  // Mixtures of the finer cells are taken apart, and made anew.
  std::map<std::uint16_t, model::Mixture> finer;
  for (const model::Mixture& mixture : definition.body.mixtures) finer[mixture.material] = mixture;
  definition.materials.resize(definition.materials.size() - definition.body.mixtures.size());
  io::CellMixtures mixtures(definition);
  const Cells fine(model);
  std::map<std::uint16_t, int> count;
  for_each_cell(cells, [&](const Int3& coarse) {
    count.clear();
    float factor = 0;
    double weight = 0;
    for_each_cell({2, 2, 2}, [&](const Int3& corner) {
      const Int3 cell{2 * coarse[0] + corner[0], 2 * coarse[1] + corner[1], 2 * coarse[2] + corner[2]};
      const std::uint16_t material = fine.material(cell);
      if (material == 0) return;
      if (const auto found = finer.find(material); found == finer.end()) {
        count[material] += 16;
      } else {
        const model::Mixture& mixture = found->second;
        const auto second = static_cast<int>(std::lround(16 * mixture.share));
        count[mixture.of[0]] += 16 - second;
        count[mixture.of[1]] += second;
      }
      factor += fine.factor(cell) / 8;
      weight += fine.share(cell) * model.materials[material].density / 8;
    });
    const std::uint16_t material = count.empty() ? std::uint16_t{0} : mixtures.material_of(count);
    definition.body.cells.push_back(material);
    definition.body.factors.push_back(count.empty() ? 1 : std::min(factor, 1.0F));
    definition.body.density_shares.push_back(count.empty() ? 1.0F
                                                           : static_cast<float>(weight / mixtures.density(material)));
  });
  const std::vector<model::MaterialDefinition> mixed = mixtures.materials(definition.body.cells, cells);
  definition.body.mixtures = mixtures.mixtures();
  definition.materials.insert(definition.materials.end(), mixed.begin(), mixed.end());
  return definition;
}

model::Definition part_of(const model::Model& model, const Int3& first, const Int3& cells) {
  model::Definition definition = without_cells(model, cells, model.lattice.grid.d);
  definition.body.periodic = {};
  definition.body.origin = model.lattice.grid.position(first);
  const Cells whole(model);
  for_each_cell(cells, [&](const Int3& within) {
    const Int3 cell{first[0] + within[0], first[1] + within[1], first[2] + within[2]};
    definition.body.cells.push_back(whole.material(cell));
    if (!whole.partly_filled()) return;
    definition.body.factors.push_back(whole.factor(cell));
    definition.body.density_shares.push_back(whole.share(cell));
  });
  return definition;
}

std::vector<BoxSample> sample_boxes(const model::Model& model, int count, homogenize::Boundary boundary,
                                    const statics::StaticOptions& options) {
  const Int3& all = model.lattice.grid.cells;
  constexpr std::int64_t least_edge = 4;
  std::vector<BoxSample> samples;
  std::mt19937 random;  // the same places every time, on every rank
  for (std::int64_t edge = *std::min_element(all.begin(), all.end()) / 2; edge >= least_edge; edge /= 2) {
    BoxSample& sample = samples.emplace_back();
    sample.edge = edge;
    for (int box = 0; box < count; ++box) {
      Int3 first{};
      for (std::size_t a = 0; a < 3; ++a)
        first[a] = static_cast<std::int64_t>(random() % static_cast<std::uint32_t>(all[a] - edge + 1));
      const model::Definition part = part_of(model, first, {edge, edge, edge});
      if (std::all_of(part.body.cells.begin(), part.body.cells.end(), [](auto cell) { return cell == 0; })) {
        sample.moduli.push_back({});
        continue;
      }
      const homogenize::Effective effective =
          homogenize::effective_stiffness(model::make_model(part, model.communicator), options, boundary);
      sample.moduli.push_back(homogenize::closest_isotropic(effective.stiffness).moduli);
    }
  }
  return samples;
}

std::vector<std::string> box_columns() {
  return {"edge [cells]", "boxes [1]", "K mean [Pa]", "K deviation [Pa]", "G mean [Pa]", "G deviation [Pa]"};
}

std::vector<std::vector<double>> box_rows(const std::vector<BoxSample>& samples) {
  std::vector<std::vector<double>> rows;
  for (const BoxSample& sample : samples) {
    const auto n = static_cast<double>(sample.moduli.size());
    std::vector<double> row{static_cast<double>(sample.edge), n};
    for (const auto member : {&homogenize::Moduli::bulk, &homogenize::Moduli::shear}) {
      double mean = 0, square = 0;
      for (const homogenize::Moduli& moduli : sample.moduli) mean += moduli.*member / n;
      for (const homogenize::Moduli& moduli : sample.moduli) square += std::pow(moduli.*member - mean, 2);
      row.push_back(mean);
      row.push_back(n > 1 ? std::sqrt(square / (n - 1)) : 0);
    }
    rows.push_back(row);
  }
  return rows;
}

}  // namespace koshi::driver
