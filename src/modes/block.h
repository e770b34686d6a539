// A few dozen long vectors side by side, spread over the ranks.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "koshi/communicator.h"
#include "statics/row_field.h"

namespace koshi::modes {

/// Columns of numbers of one rank, zero at first.
class Block {
 public:
  Block(std::int64_t rows, int columns);

  int columns() const { return columns_; }
  double* column(int j) { return data_.get() + stride_ * j; }
  const double* column(int j) const { return data_.get() + stride_ * j; }
  /// Rows with the zeros that fill up the last vector.
  std::int64_t padded_rows() const { return stride_; }

 private:
  std::int64_t stride_;
  int columns_;
  statics::AlignedArray<double> data_;
};

/// Columns of one or several blocks, in order.
using Columns = std::vector<double*>;

/// The sum over all ranks, in their order (collective).
Eigen::MatrixXd summed(Eigen::MatrixXd own, const Communicator& communicator);

/// a_i . b_j summed over all ranks in their order (collective).
Eigen::MatrixXd products(const Columns& a, const Columns& b, std::int64_t padded_rows,
                         const Communicator& communicator);

/// out_j = sum_i in_i coefficients(i, j); an output may be one of the inputs.
void combine(const Columns& in, const Eigen::MatrixXd& coefficients, const Columns& out, std::int64_t padded_rows);

}  // namespace koshi::modes
