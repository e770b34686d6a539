// How an effective stiffness depends on the size of cells and of the sample.
#pragma once

#include <vector>

#include "koshi/homogenize.h"

namespace koshi::driver {

/// The body of a model with cells of twice the side: of the material of most of their solid cells, with the mean of the
/// factors and density shares of all eight. Errors: InputError when a number of cells is odd.
model::Definition coarser(const model::Model& model);

/// A box of cells of the body of a model, not periodic: `cells` from `first` on.
model::Definition part_of(const model::Model& model, const Int3& first, const Int3& cells);

/// Moduli of random boxes of one size.
struct BoxSample {
  std::int64_t edge = 0;                   ///< cells
  std::vector<homogenize::Moduli> moduli;  ///< of the closest isotropic tensor, a box each
};

/// Boxes of half, a quarter ... of the shortest edge of the body, `count` of each size, at places that depend on
/// nothing but their number (collective). Errors as effective_stiffness(); boxes without a solid cell have no moduli.
std::vector<BoxSample> sample_boxes(const model::Model& model, int count, homogenize::Boundary boundary,
                                    const statics::StaticOptions& options);

/// Mean and standard deviation of the samples: columns and rows of boxes.csv.
std::vector<std::string> box_columns();
std::vector<std::vector<double>> box_rows(const std::vector<BoxSample>& samples);

}  // namespace koshi::driver
