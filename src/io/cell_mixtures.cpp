#include "io/cell_mixtures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/connected_solids.h"
#include "material/mixture.h"

namespace koshi::io {

bool CellMixtures::mixes(std::uint16_t material) const {
  const auto& boundary = definition_.body.grain_boundary;
  return !solid(material).cracks() && !solid(material).stiffness_scatter && !(boundary && boundary->labels.empty());
}

std::uint16_t CellMixtures::material_of(const std::map<std::uint16_t, int>& count) {
  // The two with most voxels; of as many, those that stand first in the case.
  auto most = count.begin(), second = count.end();
  for (auto at = count.begin(); at != count.end(); ++at) {
    voxels_[at->first] += at->second;
    if (at == most) continue;
    if (at->second > most->second) {
      second = most;
      most = at;
    } else if (second == count.end() || at->second > second->second) {
      second = at;
    }
  }
  if (second == count.end() || !mixes(most->first) || !mixes(second->first)) return most->first;

  const auto [low, high] = std::minmax(most, second, [](auto a, auto b) { return a->first < b->first; });
  const auto sixteenths = static_cast<int>(std::lround(16.0 * high->second / (low->second + high->second)));
  if (sixteenths == 0) return low->first;
  if (sixteenths == 16) return high->first;
  const std::array pair{low->first, high->first};
  const auto next = static_cast<std::uint16_t>(definition_.materials.size() + mixtures_.size() + 1);
  const auto [known, is_new] = known_.try_emplace({pair, sixteenths}, next);
  if (is_new) mixtures_.push_back({next, pair, sixteenths / 16.0});
  return known->second;
}

double CellMixtures::density(std::uint16_t material) const {
  if (material <= definition_.materials.size()) return solid(material).elastic.density;
  const model::Mixture& mixture = mixtures_[material - definition_.materials.size() - 1];
  return (1 - mixture.share) * density(mixture.of[0]) + mixture.share * density(mixture.of[1]);
}

std::vector<model::MaterialDefinition> CellMixtures::materials(const std::vector<std::uint16_t>& material,
                                                               const Int3& cells) const {
  // What leads through the body is told by the solids that have most of each cell.
  std::vector<std::uint16_t> solids = material;
  for (std::uint16_t& of_cell : solids)
    if (of_cell > definition_.materials.size()) {
      const model::Mixture& mixture = mixtures_[of_cell - definition_.materials.size() - 1];
      of_cell = mixture.of[mixture.share > 0.5 ? 1 : 0];
    }
  std::map<std::uint16_t, int> through;
  if (!mixtures_.empty()) through = directions_through(solids, cells);

  std::vector<model::MaterialDefinition> all;
  for (const model::Mixture& mixture : mixtures_) {
    const auto [first, second] = mixture.of;
    const model::MaterialDefinition &a = solid(first), &b = solid(second);
    const auto voxels = static_cast<double>(voxels_.at(first) + voxels_.at(second));
    const material::Elastic inclusion =
        through[first] > through[second] ? b.elastic
        : through[first] < through[second]
            ? a.elastic
            : material::geometric_mean(a.elastic, b.elastic, static_cast<double>(voxels_.at(first)) / voxels);
    all.push_back({fmt::format("{} with {}/16 {}", a.name, std::lround(16 * mixture.share), b.name),
                   material::mixture(a.elastic, b.elastic, mixture.share, inclusion)});
  }
  return all;
}

}  // namespace koshi::io
