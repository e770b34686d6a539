#include "mechanics/stencil.h"

#include "mechanics/cell_matrix.h"

namespace koshi::mechanics {
namespace {

// Force on component `to` of a node from component `from` of its neighbour at offset o: the sum over all pairs of cell
// corners that lie o apart, `counts(a)` telling in which cells (those with the node at corner a) there is material.
template <class Counts>
double entry(const Eigen::MatrixXd& K, const std::array<int, 3>& o, int to, int from, Counts&& counts) {
  const int components = static_cast<int>(K.rows()) / 8;
  double sum = 0;
  for (int a = 0; a < 8; ++a)
    for (int b = 0; b < 8; ++b) {
      bool apart = counts(a);
      for (int axis = 0; axis < 3; ++axis) apart = apart && (b >> axis & 1) - (a >> axis & 1) == o[axis];
      if (apart) sum -= K(components * a + to, components * b + from);
    }
  return sum;
}

}  // namespace

template <class T>
Stencil<T> make_stencil(const material::Springs& springs, double d, material::Kinematics kinematics) {
  const Eigen::MatrixXd K = cell_matrix(springs, d, kinematics);
  const auto entry = [&K](const std::array<int, 3>& o, int to, int from) {
    return static_cast<T>(mechanics::entry(K, o, to, from, [](int) { return true; }));
  };
  const auto vector = [&](int c) {
    return typename Stencil<T>::Vector{entry({0, 0, 0}, c, c),     entry({1, 0, 0}, c, c),    entry({0, 1, 0}, c, c),
                                       entry({1, 1, 0}, c, c),     entry({0, 1, 1}, c, c),    entry({1, 1, 1}, c, c),
                                       entry({1, 1, 0}, c, c + 1), entry({1, 1, 1}, c, c + 1)};
  };
  Stencil<T> stencil{vector(0), {}, {}};
  if (kinematics == material::Kinematics::rotational) {
    stencil.rotation = vector(3);
    // (o x v)_x = o_y v_z - ...: the force along x from the rotation about z.
    stencil.coupling = {entry({0, 1, 0}, 0, 5), entry({1, 1, 0}, 0, 5), entry({1, 1, 1}, 0, 5)};
  }
  return stencil;
}

template <class T>
FaceStencil<T> make_face_stencil(const material::Springs& springs, double d, material::Kinematics kinematics,
                                 int toward) {
  const Eigen::MatrixXd K = cell_matrix(springs, d, kinematics);
  const int components = static_cast<int>(K.rows()) / 8;
  const int node_side = toward > 0 ? 0 : 1;  // the node is the lower corner of cells above it
  FaceStencil<T> stencil{};
  stencil.toward = toward;
  int neighbour = 0;
  for (int z = -1; z <= 1; ++z)
    for (int y = -1; y <= 1; ++y)
      for (int x = 0; x <= 1; ++x, ++neighbour)
        for (int from = 0; from < components; ++from)
          for (int to = 0; to < components; ++to)
            stencil.column[neighbour][from][to] = static_cast<T>(
                entry(K, {x * toward, y, z}, to, from, [node_side](int a) { return (a & 1) == node_side; }));
  return stencil;
}

template Stencil<double> make_stencil<double>(const material::Springs&, double, material::Kinematics);
template Stencil<float> make_stencil<float>(const material::Springs&, double, material::Kinematics);
template FaceStencil<double> make_face_stencil<double>(const material::Springs&, double, material::Kinematics, int);
template FaceStencil<float> make_face_stencil<float>(const material::Springs&, double, material::Kinematics, int);

}  // namespace koshi::mechanics
