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

FixedNodes coarsened(const FixedNodes& fine) {
  FixedNodes halved = fine;
  for (FixedNode& fixed : halved)
    for (std::int64_t& x : fixed.node) x /= 2;
  std::sort(halved.begin(), halved.end(), before);
  FixedNodes coarse;
  for (const FixedNode& fixed : halved) {
    if (coarse.empty() || coarse.back().node != fixed.node) coarse.push_back({fixed.node, 0});
    coarse.back().mask |= fixed.mask;
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
