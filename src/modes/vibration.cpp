#include "modes/vibration.h"

#include <algorithm>
#include <cmath>

namespace koshi::modes {
namespace {

// Uniform in [-1, 1): the finaliser of splitmix64 as a counter-based generator.
double noise(std::uint64_t counter) {
  std::uint64_t z = (counter + 1) * 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return static_cast<double>(static_cast<std::int64_t>(z ^ (z >> 31))) * 0x1p-63;
}

}  // namespace

Vibration::Vibration(const model::Model& model, lattice::Field<double>& work)
    : model_(model),
      equilibrium_(model, 0, work),
      free_(model, equilibrium_.fixed()),
      preconditioner_(model, equilibrium_.fixed(), free_),
      root_(static_cast<std::size_t>(size())),
      inverse_root_(root_.size()),
      scaled_(root_.size()) {
  const double d = model.lattice.grid.d;
  for (const material::Elastic& elastic : model.materials) {
    mass_ = std::max(mass_, elastic.density * d * d * d);
    stiffness_ = std::max(stiffness_, elastic.youngs_modulus * d);
  }

  // Rotations are measured as rho = (d/2) w, their inertia as J / (d/2)^2.
  const std::size_t nodes = static_cast<std::size_t>(model.layout().owned_count());
  const double* const mass = model.inertia.component(0);
  const double* const inertia = model.components() == 6 ? model.inertia.component(1) : nullptr;
  std::size_t at = 0;
  auto fixed = equilibrium_.fixed().begin();
  lattice::for_each_owned(model.layout(), [&](auto i, auto j, auto k, auto n) {
    const bool held = fixed != equilibrium_.fixed().end() && fixed->node == Int3{i, j, k};
    for (int c = 0; c < model.components(); ++c) {
      if (mass[n] == 0 || (held && (fixed->mask >> c & 1))) continue;
      const double own = c < 3 ? mass[n] : inertia[n] / (0.25 * d * d);
      root_[at + static_cast<std::size_t>(c) * nodes] = std::sqrt(own / mass_);
      inverse_root_[at + static_cast<std::size_t>(c) * nodes] = std::sqrt(mass_ / own);
    }
    if (held) ++fixed;
    ++at;
  });

  // Products of the free motions of each part, weighted by the masses, column by column.
  std::vector<Eigen::MatrixXd> gram;
  std::vector<double> motion(root_.size());
  for (std::size_t f = 0; f < free_.free_part_count(); ++f)
    gram.emplace_back(Eigen::MatrixXd::Zero(free_.motions(f).cols(), free_.motions(f).cols()));
  for (Eigen::Index column = 0; free_.free_part_count() > 0 && column < 6; ++column) {
    statics::FreeMotions::Amounts amounts(gram.size(), Eigen::Matrix<double, 6, 1>::Zero());
    for (std::size_t f = 0; f < gram.size(); ++f)
      if (column < gram[f].cols()) amounts[f] = -free_.motions(f).col(column);
    std::fill(motion.begin(), motion.end(), 0.0);
    free_.subtract(amounts, motion.data());
    for (std::size_t i = 0; i < motion.size(); ++i) motion[i] *= root_[i] * root_[i];
    const auto work_done = free_.work(motion.data());
    for (std::size_t f = 0; f < gram.size(); ++f)
      if (column < gram[f].cols()) gram[f].col(column) = free_.motions(f).transpose() * work_done[f];
  }
  for (const Eigen::MatrixXd& products : gram) gram_.emplace_back(products);
}

void Vibration::project(double* x) {
  if (gram_.empty()) return;
  for (std::size_t i = 0; i < scaled_.size(); ++i) scaled_[i] = root_[i] * root_[i] * x[i];
  auto amounts = free_.work(scaled_.data());
  for (std::size_t f = 0; f < gram_.size(); ++f)
    amounts[f] = free_.motions(f) * gram_[f].solve(free_.motions(f).transpose() * amounts[f]);
  free_.subtract(amounts, x);
}

void Vibration::apply(const double* y, double* Ay) {
  for (std::size_t i = 0; i < scaled_.size(); ++i) scaled_[i] = inverse_root_[i] * y[i];
  equilibrium_.apply(scaled_.data(), Ay);
  for (std::size_t i = 0; i < scaled_.size(); ++i) Ay[i] *= inverse_root_[i] / stiffness_;
}

void Vibration::precondition(const double* r, double* z) {
  for (std::size_t i = 0; i < scaled_.size(); ++i) scaled_[i] = root_[i] * r[i];
  preconditioner_.apply(scaled_.data(), z);
  project(z);
  for (std::size_t i = 0; i < scaled_.size(); ++i) z[i] *= root_[i];
}

void Vibration::start(int number, bool smooth, double* y) {
  const lattice::Layout& layout = model_.layout();
  const Int3 all = model_.lattice.grid.nodes();
  const std::int64_t nodes = layout.owned_count();
  std::vector<double> white(root_.size());
  std::int64_t at = 0;
  lattice::for_each_owned(layout, [&](auto i, auto j, auto k, auto) {
    const Int3 g = layout.global({i, j, k});
    const std::int64_t node = g[0] + all[0] * (g[1] + all[1] * g[2]);
    for (int c = 0; c < model_.components(); ++c) {
      const auto unknown = static_cast<std::uint64_t>(node * model_.components() + c);
      const auto place = static_cast<std::size_t>(at + c * nodes);
      white[place] = root_[place] * noise(unknown + (static_cast<std::uint64_t>(number) << 48));
    }
    ++at;
  });
  if (smooth) {
    precondition(white.data(), y);
    return;
  }
  // Already in the units of displacements, where free motions are taken out.
  for (std::size_t i = 0; i < root_.size(); ++i) y[i] = root_[i] == 0 ? 0 : white[i] / root_[i];
  project(y);
  for (std::size_t i = 0; i < root_.size(); ++i) y[i] *= root_[i];
}

}  // namespace koshi::modes
