#include "failure/face_forces.h"

#include "failure/principal.h"
#include "failure/row_reach.h"

namespace koshi::failure {

FaceForces::FaceForces(const lattice::Layout& layout)
    : layout_(layout), first_(cell_row(layout, layout.owned()[1], layout.owned()[2]) + 1, 0) {}

void FaceForces::begin() {
  cells_.clear();
  row_ = 0;
}

void FaceForces::push(std::int64_t cell, const mechanics::Tensor6& pull) {
  const Int3 at = layout_.place(cell);
  const std::size_t row = cell_row(layout_, at[1], at[2]);
  for (; row_ <= row; ++row_) first_[row_] = cells_.size();
  cells_.push_back({at[0], pull});
}

void FaceForces::end() {
  for (; row_ < first_.size(); ++row_) first_[row_] = cells_.size();
}

// A node gets its forces in the order of the cells in memory, whatever cells this rank has beside them.
void FaceForces::add(std::int64_t j, std::int64_t k, double* const* force) const {
  for (const int z : {1, -1})
    for (const int y : {1, -1}) {
      // The node is the upper corner of the cells before it.
      const std::size_t row = cell_row(layout_, y > 0 ? j - 1 : j, z > 0 ? k - 1 : k);
      for (std::size_t m = first_[row]; m < first_[row + 1]; ++m) {
        const auto& [i, pull] = cells_[m];
        for (const int x : {-1, 1}) {
          const std::int64_t node = x > 0 ? i + 1 : i;
          if (node < 0 || node >= layout_.owned()[0]) continue;
          const Vec3 f = times(pull, {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)});
          for (std::size_t c = 0; c < 3; ++c) force[c][node] += f[c];
        }
      }
    }
}

}  // namespace koshi::failure
