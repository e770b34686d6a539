#include "modes/block.h"

#include <cstring>
#include <string>

#include "modes/block_rows.h"

namespace koshi::modes {

Block::Block(std::int64_t rows, int columns)
    : stride_((rows + row_width - 1) / row_width * row_width),
      columns_(columns),
      data_(statics::aligned_array<double>(stride_ * columns)) {
  std::memset(data_.get(), 0, static_cast<std::size_t>(stride_ * columns) * sizeof(double));
}

Eigen::MatrixXd summed(Eigen::MatrixXd own, const Communicator& communicator) {
  if (communicator.size() == 1) return own;
  const std::size_t bytes = static_cast<std::size_t>(own.size()) * sizeof(double);
  const std::string all = communicator.all_gather(std::string(reinterpret_cast<const char*>(own.data()), bytes));
  Eigen::MatrixXd total = Eigen::MatrixXd::Zero(own.rows(), own.cols());
  for (std::size_t from = 0; from < all.size(); from += bytes) {
    std::memcpy(own.data(), all.data() + from, bytes);
    total += own;
  }
  return total;
}

Eigen::MatrixXd products(const Columns& a, const Columns& b, std::int64_t padded_rows,
                         const Communicator& communicator) {
  Eigen::MatrixXd own(a.size(), b.size());
  block_kernels().products(a.data(), static_cast<int>(a.size()), b.data(), static_cast<int>(b.size()), padded_rows,
                           own.data());
  return summed(std::move(own), communicator);
}

void combine(const Columns& in, const Eigen::MatrixXd& coefficients, const Columns& out, std::int64_t padded_rows) {
  block_kernels().combine(in.data(), static_cast<int>(in.size()), coefficients.data(), out.data(),
                          static_cast<int>(out.size()), padded_rows);
}

}  // namespace koshi::modes
