#include "statics/fixed_nodes.h"

#include <algorithm>

namespace koshi::statics {
namespace {

bool before(const FixedNode& a, const FixedNode& b) {
  for (int axis = 2; axis > 0; --axis)
    if (a.node[axis] != b.node[axis]) return a.node[axis] < b.node[axis];
  return a.node[0] < b.node[0];
}

}  // namespace

FixedNodes fixed_nodes(const model::Model& model) {
  FixedNodes list;
  for (const model::PrescribedMotion& motion : model.motions) {  // by node
    const Int3 node = model.layout().place(motion.node);
    if (list.empty() || list.back().node != node) list.push_back({node, 0, {}});
    list.back().mask |= static_cast<std::uint8_t>(1 << motion.component);
  }
  return list;
}

FixedNodes coarsened(const FixedNodes& fine, const Int3& owned, const Int3& coarse_owned) {
  FixedNodes halved;
  for (const FixedNode& fixed : fine) {
    Int3 first, last;
    for (int a = 0; a < 3; ++a) {
      first[a] = last[a] = fixed.node[a] / 2;
      const bool is_end = fixed.node[a] == owned[a] - 1 && fixed.node[a] % 2 == 1;
      if (is_end && first[a] + 2 == coarse_owned[a]) ++last[a];
    }
    for (std::int64_t k = first[2]; k <= last[2]; ++k)
      for (std::int64_t j = first[1]; j <= last[1]; ++j)
        for (std::int64_t i = first[0]; i <= last[0]; ++i) halved.push_back({{i, j, k}, fixed.mask, fixed.spring});
  }
  std::stable_sort(halved.begin(), halved.end(), before);
  FixedNodes coarse;
  for (const FixedNode& fixed : halved) {
    if (coarse.empty() || coarse.back().node != fixed.node) coarse.push_back({fixed.node, 0, {}});
    coarse.back().mask |= fixed.mask;
    for (std::size_t s = 0; s < fixed.spring.size(); ++s) coarse.back().spring[s] += fixed.spring[s];
  }
  return coarse;
}

void clear_fixed(const FixedNodes& fixed, RowField<float>& field) {
  for (const FixedNode& f : fixed) {
    float* const at = field.row(f.node[1], f.node[2]) + f.node[0];
    for (int c = 0; c < field.components(); ++c)
      if (f.mask >> c & 1) at[c * field.pitch()] = 0;
  }
}

}  // namespace koshi::statics
