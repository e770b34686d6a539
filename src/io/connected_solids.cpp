#include "io/connected_solids.h"

#include <algorithm>

namespace koshi::io {

std::map<std::uint16_t, int> directions_through(const std::vector<std::uint16_t>& solid, const Int3& cells) {
  const Int3 stride{1, cells[0], cells[0] * cells[1]};
  std::map<std::uint16_t, std::array<bool, 3>> through;
  std::vector<bool> seen(solid.size());
  std::vector<std::int64_t> waiting;
  for (std::size_t start = 0; start < solid.size(); ++start) {
    if (solid[start] == 0 || seen[start]) continue;
    // The part that this cell belongs to, and how far it reaches.
    Int3 least = cells, most{};
    seen[start] = true;
    waiting.assign(1, static_cast<std::int64_t>(start));
    while (!waiting.empty()) {
      const std::int64_t at = waiting.back();
      waiting.pop_back();
      for (std::size_t a = 0; a < 3; ++a) {
        const std::int64_t x = at / stride[a] % cells[a];
        least[a] = std::min(least[a], x);
        most[a] = std::max(most[a], x);
        for (const std::int64_t step : {-1, 1}) {
          if (x + step < 0 || x + step == cells[a]) continue;
          const std::int64_t next = at + step * stride[a];
          const auto n = static_cast<std::size_t>(next);
          if (solid[n] != solid[start] || seen[n]) continue;
          seen[n] = true;
          waiting.push_back(next);
        }
      }
    }
    for (std::size_t a = 0; a < 3; ++a)
      if (least[a] == 0 && most[a] == cells[a] - 1) through[solid[start]][a] = true;
  }
  std::map<std::uint16_t, int> directions;
  for (const auto& [material, axes] : through)
    directions[material] = static_cast<int>(std::count(axes.begin(), axes.end(), true));
  return directions;
}

}  // namespace koshi::io
