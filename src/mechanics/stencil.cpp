#include "mechanics/stencil.h"

#include "mechanics/cell_matrix.h"

namespace koshi::mechanics {

template <class T>
Stencil<T> make_stencil(const material::Springs& springs, double d, material::Kinematics kinematics) {
  const Eigen::MatrixXd K = cell_matrix(springs, d, kinematics);
  const int components = static_cast<int>(K.rows()) / 8;
  // Force on component `to` of a node from component `from` of its neighbour at offset o: the sum over all pairs of
  // cell corners that lie o apart.
  const auto entry = [&](const std::array<int, 3>& o, int to, int from) {
    double sum = 0;
    for (int a = 0; a < 8; ++a)
      for (int b = 0; b < 8; ++b) {
        bool apart = true;
        for (int axis = 0; axis < 3; ++axis) apart = apart && (b >> axis & 1) - (a >> axis & 1) == o[axis];
        if (apart) sum -= K(components * a + to, components * b + from);
      }
    return static_cast<T>(sum);
  };
  const auto vector = [&](int c) {
    return typename Stencil<T>::Vector{entry({0, 0, 0}, c, c),     entry({1, 0, 0}, c, c),    entry({0, 1, 0}, c, c),
                                       entry({1, 1, 0}, c, c),     entry({0, 1, 1}, c, c),    entry({1, 1, 1}, c, c),
                                       entry({1, 1, 0}, c, c + 1), entry({1, 1, 1}, c, c + 1)};
  };
  Stencil<T> stencil{vector(0), {}, {}};
  if (components == 6) {
    stencil.rotation = vector(3);
    // (o x v)_x = o_y v_z - ...: the force along x from the rotation about z.
    stencil.coupling = {entry({0, 1, 0}, 0, 5), entry({1, 1, 0}, 0, 5), entry({1, 1, 1}, 0, 5)};
  }
  return stencil;
}

template Stencil<double> make_stencil<double>(const material::Springs&, double, material::Kinematics);
template Stencil<float> make_stencil<float>(const material::Springs&, double, material::Kinematics);

}  // namespace koshi::mechanics
