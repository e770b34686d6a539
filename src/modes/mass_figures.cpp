#include "modes/mass_figures.h"

#include <algorithm>
#include <cmath>

#include "base/exact_sum.h"

namespace koshi::modes {
namespace {

// Value of component c of a motion by 1 along (a < 3) or about (a - 3) an axis, X from the centre [m]; rotations as
// statics::Equilibrium measures them.
double motion(int a, int c, const Vec3& X, double half_d) {
  if (a < 3) return a == c ? 1 : 0;
  const int axis = a - 3;
  if (c >= 3) return c - 3 == axis ? half_d : 0;
  if (c == (axis + 1) % 3) return -X[static_cast<std::size_t>((axis + 2) % 3)];
  if (c == (axis + 2) % 3) return X[static_cast<std::size_t>((axis + 1) % 3)];
  return 0;
}

// Calls use(node among the owned ones, index in a field, position).
template <class F>
void for_each_node(const model::Model& model, F&& use) {
  std::size_t at = 0;
  lattice::for_each_owned(model.layout(), [&](auto i, auto j, auto k, auto n) {
    use(at++, n, model.lattice.grid.position(model.layout().global({i, j, k})));
  });
}

}  // namespace

MassFigures::MassFigures(const model::Model& model, Vibration& vibration) : model_(model), vibration_(vibration) {
  std::array<ExactSum, 4> moments;
  for_each_node(model, [&](std::size_t, std::int64_t n, const Vec3& X) {
    const double mass = model.inertia.component(0)[n];
    for (std::size_t a = 0; a < 3; ++a) moments[a] += mass * X[a];
    moments[3] += mass;
  });
  for (ExactSum& sum : moments) sum.sum_ranks(model.communicator);
  for (std::size_t a = 0; a < 3; ++a) centre_[a] = moments[a].value() / moments[3].value();

  // What is left of a motion without its free part belongs to the vibrations.
  const std::vector<double>& root = vibration.root();
  const auto nodes = static_cast<std::size_t>(model.layout().owned_count());
  std::vector<double> r(root.size());
  const auto square = [&] {
    ExactSum sum;
    for (std::size_t i = 0; i < r.size(); ++i) sum += root[i] * root[i] * r[i] * r[i];
    sum.sum_ranks(model.communicator);
    return sum.value() * vibration.mass();
  };
  for (int a = 0; a < 6; ++a) {
    for_each_node(model, [&](std::size_t at, std::int64_t, const Vec3& X) {
      for (int c = 0; c < model.components(); ++c)
        r[at + static_cast<std::size_t>(c) * nodes] = motion(a, c, X - centre_, 0.5 * model.lattice.grid.d);
    });
    total_[static_cast<std::size_t>(a)] = square();
    if (vibration.free().count() == 0) continue;
    vibration.project(r.data());
    rigid_[static_cast<std::size_t>(a)] = total_[static_cast<std::size_t>(a)] - square();
  }
}

void MassFigures::measure(const double* y, Mode& mode) const {
  const std::vector<double>& root = vibration_.root();
  const auto nodes = static_cast<std::size_t>(model_.layout().owned_count());
  const int components = model_.components();
  const double half_d = 0.5 * model_.lattice.grid.d;

  // The shape from y = sqrt(M / m) x, and its products with the motions of the whole.
  mode.shape.assign(y, y + root.size());
  std::array<ExactSum, 6> work;
  double largest = 0, largest_turn = 0;
  for_each_node(model_, [&](std::size_t at, std::int64_t, const Vec3& X) {
    double length = 0, turn = 0;
    for (int c = 0; c < components; ++c) {
      const std::size_t i = at + static_cast<std::size_t>(c) * nodes;
      if (root[i] == 0) continue;
      for (int a = 0; a < 6; ++a) {
        const double r = motion(a, c, X - centre_, half_d);
        if (r != 0) work[static_cast<std::size_t>(a)] += root[i] * y[i] * r;
      }
      mode.shape[i] /= root[i] * (c < 3 ? 1 : half_d);
      (c < 3 ? length : turn) += mode.shape[i] * mode.shape[i];
    }
    largest = std::max(largest, length);
    largest_turn = std::max(largest_turn, turn);
  });
  largest = std::sqrt(model_.communicator.max(largest));
  largest_turn = std::sqrt(model_.communicator.max(largest_turn));
  const double scale = largest > 1e-9 * half_d * largest_turn ? largest : largest_turn;
  for (double& value : mode.shape) value /= scale;

  mode.modal_mass = vibration_.mass() / (scale * scale);
  for (std::size_t a = 0; a < 6; ++a) {
    work[a].sum_ranks(model_.communicator);
    const double product = work[a].value();
    mode.participation[a] = product * scale;
    mode.effective_mass[a] = vibration_.mass() * product * product;
  }
}

}  // namespace koshi::modes
