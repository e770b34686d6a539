#include "homogenize/mixed_phases.h"

#include <algorithm>
#include <map>

namespace koshi::homogenize {

void split_mixtures(const model::Definition& definition, Effective& effective) {
  if (definition.body.mixtures.empty()) return;
  std::map<std::uint16_t, model::Mixture> mixture_of;
  for (const model::Mixture& mixture : definition.body.mixtures) mixture_of[mixture.material] = mixture;
  // Calls f(solid, its part of the phase); a phase that is no mixture is all its own.
  const auto for_each_solid = [&](std::uint16_t material, auto&& f) {
    const auto found = mixture_of.find(material);
    if (found == mixture_of.end()) return f(material, 1.0);
    f(found->second.of[0], 1 - found->second.share);
    f(found->second.of[1], found->second.share);
  };

  std::map<std::uint16_t, double> fraction, whole;
  for (const Phase& phase : effective.phases) {
    whole[phase.material] = phase.fraction;
    for_each_solid(phase.material, [&](std::uint16_t solid, double part) { fraction[solid] += part * phase.fraction; });
  }
  std::map<std::uint16_t, PhaseMeans> means;
  for (const PhaseMeans& mean : effective.means)
    for_each_solid(mean.material, [&](std::uint16_t solid, double part) {
      PhaseMeans& sum = means[solid];
      sum.material = solid;
      const double weight = part * whole[mean.material] / fraction[solid];
      for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < 6; ++j) {
          sum.stress[i][j] += weight * mean.stress[i][j];
          sum.strain[i][j] += weight * mean.strain[i][j];
        }
    });

  effective.phases.clear();
  for (const auto& [material, share] : fraction) effective.phases.push_back({material, share});
  effective.means.clear();
  for (const auto& [material, mean] : means) effective.means.push_back(mean);
}

}  // namespace koshi::homogenize
