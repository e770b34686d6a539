#include "failure/principal.h"

#include <Eigen/Eigenvalues>

namespace koshi::failure {

Principal principal(const Tensor6& t) {
  Eigen::Matrix3d matrix;
  matrix << t[0], t[5], t[4], t[5], t[1], t[3], t[4], t[3], t[2];
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(matrix);
  Principal result;
  for (int a = 0; a < 3; ++a) {
    const auto column = solver.eigenvectors().col(2 - a);
    Vec3& direction = result.direction[static_cast<std::size_t>(a)];
    result.value[static_cast<std::size_t>(a)] = solver.eigenvalues()[2 - a];
    // A direction and its opposite mean the same plane: choose one.
    const double last = column[2] != 0 ? column[2] : column[1] != 0 ? column[1] : column[0];
    const double sign = last < 0 ? -1 : 1;
    for (int c = 0; c < 3; ++c) direction[static_cast<std::size_t>(c)] = sign * column[c];
  }
  return result;
}

}  // namespace koshi::failure
