#include "statics/free_motions.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include <fmt/format.h>

#include <cmath>
#include <span>

#include "base/exact_sum.h"
#include "koshi/error.h"

namespace koshi::statics {
namespace {

// Candidates for a free motion: three translations, three rotations about the grid's centre.
constexpr int candidates = 6;

/// Sums over the nodes of one part, all integers so that they do not depend on the ranks: coordinates count half cells
/// from the grid's centre. `held`: products of the candidates' values at prescribed components.
struct PartSums {
  std::array<std::int64_t, candidates * candidates> held{};
  std::int64_t nodes = 0;
  std::array<std::int64_t, 3> first{};   ///< sum X
  std::array<std::int64_t, 9> second{};  ///< sum X X^T
};

// Values of the candidates at one component of a node at X [half cells]; displacements in half cells.
std::array<std::int64_t, candidates> values(const Int3& X, int component) {
  std::array<std::int64_t, candidates> v{};
  v[component] = 1;
  if (component < 3) {
    const int b = (component + 1) % 3, c = (component + 2) % 3;
    v[3 + b] = X[c];  // (w x X)_a = w_b X_c - w_c X_b
    v[3 + c] = -X[b];
  }
  return v;
}

Int3 half_cells(const model::SpringLattice& body, const Int3& node) {
  const Int3 global = body.layout.global(node);
  Int3 X;
  for (int a = 0; a < 3; ++a) X[a] = 2 * global[a] - body.grid.cells[a];
  return X;
}

std::vector<PartSums> sum_parts(const model::Model& model, const Parts& parts, const FixedNodes& fixed) {
  const model::SpringLattice& body = model.lattice;
  std::vector<PartSums> sums(parts.list().size());
  lattice::for_each_owned(body.layout, [&](auto i, auto j, auto k, auto n) {
    if (!(model.inertia.component(0)[n] > 0)) return;
    PartSums& s = sums[static_cast<std::size_t>(parts.of_node({i, j, k}))];
    const Int3 X = half_cells(body, {i, j, k});
    ++s.nodes;
    for (int a = 0; a < 3; ++a) {
      s.first[a] += X[a];
      for (int b = 0; b < 3; ++b) s.second[3 * a + b] += X[a] * X[b];
    }
  });
  for (const FixedNode& f : fixed) {
    PartSums& s = sums[static_cast<std::size_t>(parts.of_node(f.node))];
    const Int3 X = half_cells(body, f.node);
    for (int c = 0; c < model.components(); ++c) {
      if ((f.mask >> c & 1) == 0) continue;
      const auto v = values(X, c);
      for (int a = 0; a < candidates; ++a)
        for (int b = 0; b < candidates; ++b) s.held[candidates * a + b] += v[a] * v[b];
    }
  }
  constexpr std::size_t numbers = sizeof(PartSums) / sizeof(std::int64_t);
  static_assert(numbers == candidates * candidates + 13);
  model.communicator.sum(std::span(reinterpret_cast<std::int64_t*>(sums.data()), sums.size() * numbers));
  return sums;
}

// By part, products of the candidates' values at the springs to the ground, as if each was a prescribed component.
std::vector<Eigen::MatrixXd> held_by_ground(const model::Model& model, const Parts& parts) {
  std::vector<Eigen::MatrixXd> held(parts.list().size(), Eigen::MatrixXd::Zero(candidates, candidates));
  const model::SpringLattice& body = model.lattice;
  if (!model.communicator.any(!body.ground.empty())) return held;
  std::vector<ExactSum> sums(parts.list().size() * candidates * candidates);
  for (const model::GroundSpring& spring : body.ground) {
    const Int3 cell = body.layout.place(spring.cell);
    if (!body.layout.owns(cell)) continue;
    // Its place in half cells from the grid's centre is the mean of the corners by their weights.
    const Int3 lowest = half_cells(body, cell);
    Vec3 X{};
    for (std::size_t corner = 0; corner < 8; ++corner)
      for (std::size_t a = 0; a < 3; ++a)
        X[a] += spring.weights[corner] * static_cast<double>(lowest[a] + 2 * static_cast<int>(corner >> a & 1));
    const Vec3 turn = cross(X, spring.direction);  // (w x X).n = w.(X x n)
    std::array<double, candidates> v{};
    for (std::size_t a = 0; a < 3; ++a) v[a] = spring.direction[a], v[3 + a] = turn[a];
    const auto part = static_cast<std::size_t>(parts.of_node(cell));
    for (std::size_t a = 0; a < candidates; ++a)
      for (std::size_t b = 0; b < candidates; ++b) sums[(part * candidates + a) * candidates + b] += v[a] * v[b];
  }
  sum_ranks(sums, model.communicator);
  for (std::size_t s = 0; s < sums.size(); ++s)
    held[s / (candidates * candidates)](static_cast<Eigen::Index>(s / candidates % candidates),
                                        static_cast<Eigen::Index>(s % candidates)) = sums[s].value();
  return held;
}

// Columns that span the null space of a symmetric positive semidefinite matrix whose rows have been scaled alike.
Eigen::MatrixXd null_space(const Eigen::MatrixXd& A) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(A);
  const double largest = eigen.eigenvalues().maxCoeff();
  Eigen::Index count = 0;
  while (count < A.rows() && eigen.eigenvalues()(count) <= 1e-10 * largest) ++count;
  return eigen.eigenvectors().leftCols(largest > 0 ? count : A.rows());
}

}  // namespace

FreeMotions::FreeMotions(const model::Model& model, const FixedNodes& fixed)
    : model_(model), components_(model.components()), parts_(model.lattice) {
  const auto sums = sum_parts(model, parts_, fixed);
  const auto ground = held_by_ground(model, parts_);
  const auto& periodic = model.lattice.grid.periodic;
  std::vector<std::int32_t> free_of_part(sums.size(), -1);
  for (std::size_t p = 0; p < sums.size(); ++p) {
    const PartSums& s = sums[p];
    // Move the rotations to the part's centre, lengths from half cells to the part's size.
    Vec3 centre;
    double size = 1;
    for (int a = 0; a < 3; ++a) {
      centre[a] = static_cast<double>(s.first[a]) / static_cast<double>(s.nodes);
      size = std::max(size, static_cast<double>(parts_.list()[p].hi[a] - parts_.list()[p].lo[a]));
    }
    Eigen::MatrixXd move = Eigen::MatrixXd::Identity(candidates, candidates);
    const auto turn = [&](int a, int b, double x) { move(b, 3 + a) = x; };
    // w x (X - centre): rotation about a shifts b by +centre_c and c by -centre_b.
    for (int a = 0; a < 3; ++a) {
      const int b = (a + 1) % 3, c = (a + 2) % 3;
      turn(a, b, centre[c]);
      turn(a, c, -centre[b]);
    }
    move.rightCols(3) /= size;
    Eigen::MatrixXd held(candidates, candidates);
    for (int a = 0; a < candidates; ++a)
      for (int b = 0; b < candidates; ++b)
        held(a, b) = static_cast<double>(s.held[candidates * a + b]) + ground[p](a, b);
    held = (move.transpose() * held * move).eval();
    // Rotations that do not fit a periodic direction are no motions.
    const double hold = static_cast<double>(s.nodes);
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b)
        if (b != a && periodic[b]) held(3 + a, 3 + a) += hold;
    const Eigen::MatrixXd motions = null_space(held);
    if (motions.cols() == 0) continue;

    // Orthonormal in the unknowns of the part's nodes, lengths in cells: u = t + w x X, rho = w/2.
    Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(6, 6);
    Eigen::Matrix3d second;
    double square = 0;
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) {
        second(a, b) = (static_cast<double>(s.second[3 * a + b]) - hold * centre[a] * centre[b]) / 4;
        if (a == b) square += second(a, b);
      }
    gram.topLeftCorner(3, 3) = hold * Eigen::Matrix3d::Identity();
    gram.bottomRightCorner(3, 3) = square * Eigen::Matrix3d::Identity() - second;
    if (components_ == 6) gram.bottomRightCorner(3, 3) += hold / 4 * Eigen::Matrix3d::Identity();
    Eigen::MatrixXd V = motions;
    V.topRows(3) /= 2;  // from half cells to cells
    V.bottomRows(3) /= size;
    const Eigen::LLT<Eigen::MatrixXd> factor(V.transpose() * gram * V);
    V = factor.matrixL().solve(V.transpose()).transpose().eval();
    for (double& x : centre) x /= 2;
    free_of_part[p] = static_cast<std::int32_t>(free_.size());
    free_.push_back({static_cast<std::int32_t>(p), centre, size, V, !V.bottomRows(3).isZero()});
  }
  if (free_.empty()) return;
  lattice::for_each_owned(model.layout(), [&](auto i, auto j, auto k, auto) {
    const std::int32_t part = parts_.of_node({i, j, k});
    free_of_node_.push_back(part < 0 ? -1 : free_of_part[static_cast<std::size_t>(part)]);
  });
}

int FreeMotions::count() const {
  int count = 0;
  for (const FreePart& part : free_) count += static_cast<int>(part.motions.cols());
  return count;
}

// Calls use(unknown of component 0, index into free_, X [cells] from the part's centre) for the nodes of free parts.
template <class F>
void FreeMotions::for_each_free_node(F&& use) const {
  const lattice::Layout& layout = model_.layout();
  std::int64_t unknown = 0;
  lattice::for_each_owned(layout, [&](auto i, auto j, auto k, auto) {
    const std::int64_t at = unknown++;
    const std::int32_t f = free_of_node_[static_cast<std::size_t>(at)];
    if (f < 0) return;
    const Int3 X = half_cells(model_.lattice, {i, j, k});
    Vec3 from_centre;
    for (int a = 0; a < 3; ++a)
      from_centre[a] = 0.5 * static_cast<double>(X[a]) - free_[static_cast<std::size_t>(f)].centre[a];
    use(at, static_cast<std::size_t>(f), from_centre);
  });
}

FreeMotions::Amounts FreeMotions::work(const double* x, bool absolute) const {
  const std::int64_t nodes = model_.layout().owned_count();
  std::vector<ExactSum> sums(free_.size() * candidates);
  for_each_free_node([&](std::int64_t at, std::size_t f, const Vec3& X) {
    const auto add = [&](int motion, double term) {
      sums[f * candidates + static_cast<std::size_t>(motion)] += absolute ? std::abs(term) : term;
    };
    for (int a = 0; a < 3; ++a) add(a, x[at + a * nodes]);
    if (!free_[f].turns) return;
    for (int a = 0; a < 3; ++a) {
      const int b = (a + 1) % 3, c = (a + 2) % 3;
      const double u = x[at + a * nodes];
      add(3 + b, X[c] * u);
      add(3 + c, -X[b] * u);
      if (components_ == 6) add(3 + a, 0.5 * x[at + (3 + a) * nodes]);
    }
  });
  return amounts(sums);
}

FreeMotions::Amounts FreeMotions::amounts(std::vector<ExactSum>& sums) const {
  sum_ranks(sums, model_.communicator);
  Amounts total(free_.size(), Eigen::Matrix<double, 6, 1>::Zero());
  for (std::size_t s = 0; s < sums.size(); ++s)
    total[s / candidates](static_cast<Eigen::Index>(s % candidates)) = sums[s].value();
  return total;
}

void FreeMotions::project(double* x) const {
  if (free_.empty()) return;
  Amounts motion = work(x, false);
  keep_free(motion);
  subtract(motion, x);
}

void FreeMotions::keep_free(Amounts& motion) const {
  for (std::size_t f = 0; f < free_.size(); ++f)
    motion[f] = free_[f].motions * (free_[f].motions.transpose() * motion[f]);
}

void FreeMotions::project(RowField<float>& x) const {
  if (free_.empty()) return;
  // Sums of a row, of the part that its last nodes belong to.
  std::vector<ExactSum> sums(free_.size() * candidates);
  std::array<double, candidates> row{};
  std::size_t part = 0;
  const auto close = [&](std::size_t next) {
    for (std::size_t motion = 0; motion < candidates; ++motion) sums[part * candidates + motion] += row[motion];
    row = {};
    part = next;
  };
  const std::int64_t width = x.owned()[0];
  const auto value = [&](std::int64_t at, int c) -> float& {
    const std::int64_t line = at / width;
    return x.row(line % x.owned()[1], line / x.owned()[1])[c * x.pitch() + at % width];
  };
  std::int64_t line = 0;
  for_each_free_node([&](std::int64_t at, std::size_t f, const Vec3& X) {
    if (f != part || at / width != line) close(f);
    line = at / width;
    for (int a = 0; a < 3; ++a) {
      const double u = static_cast<double>(value(at, a));
      row[static_cast<std::size_t>(a)] += u;
      if (!free_[f].turns) continue;
      const int b = (a + 1) % 3, c = (a + 2) % 3;
      row[static_cast<std::size_t>(3 + b)] += X[c] * u;
      row[static_cast<std::size_t>(3 + c)] -= X[b] * u;
      if (components_ == 6) row[static_cast<std::size_t>(3 + a)] += 0.5 * static_cast<double>(value(at, 3 + a));
    }
  });
  close(0);
  Amounts motion = amounts(sums);
  keep_free(motion);
  for_each_free_node([&](std::int64_t at, std::size_t f, const Vec3& X) {
    for (int a = 0; a < 3; ++a) {
      const int b = (a + 1) % 3, c = (a + 2) % 3;
      value(at, a) -= static_cast<float>(motion[f](a) + motion[f](3 + b) * X[c] - motion[f](3 + c) * X[b]);
      if (components_ == 6) value(at, 3 + a) -= static_cast<float>(0.5 * motion[f](3 + a));
    }
  });
}

void FreeMotions::subtract(const Amounts& motion, double* x) const {
  const std::int64_t nodes = model_.layout().owned_count();
  for_each_free_node([&](std::int64_t at, std::size_t f, const Vec3& X) {
    for (int a = 0; a < 3; ++a) {
      const int b = (a + 1) % 3, c = (a + 2) % 3;
      x[at + a * nodes] -= motion[f](a) + motion[f](3 + b) * X[c] - motion[f](3 + c) * X[b];
      if (components_ == 6) x[at + (3 + a) * nodes] -= 0.5 * motion[f](3 + a);
    }
  });
}

void FreeMotions::require_balance(const double* b) const {
  if (free_.empty()) return;
  const Amounts net = work(b, false), gross = work(b, true);
  for (std::size_t f = 0; f < free_.size(); ++f) {
    const Eigen::MatrixXd& V = free_[f].motions;
    const Eigen::VectorXd along = V.transpose() * net[f];
    // Against the work of the same forces if all of them pushed along the motion: rounding alone leaves no zero.
    const auto size = [&](const auto& w, double length) {
      return w.topRows(3).norm() + length * w.bottomRows(3).norm();
    };
    if (along.norm() <= 1e-6 * size(V, free_[f].size) * size(gross[f], 1 / free_[f].size)) continue;
    throw InputError(model_.definition.places.find("boundary"),
                     fmt::format("{} is free to {}, and its loads do not balance; fix it or balance the loads",
                                 title(free_[f].part), in_words(V)));
  }
}

std::string FreeMotions::description() const {
  std::string text;
  for (std::size_t f = 0; f < free_.size(); ++f) {
    if (f == 3) return text + fmt::format("; and {} more", free_.size() - f);
    text += fmt::format("{}{} is free to {}", f == 0 ? "" : "; ", title(free_[f].part), in_words(free_[f].motions));
  }
  return text;
}

std::string FreeMotions::title(std::int32_t p) const {
  const Part& part = parts_.list()[static_cast<std::size_t>(p)];
  const lattice::Grid& grid = model_.lattice.grid;
  const Vec3 lo = grid.position(part.lo), hi = grid.position(part.hi);
  const std::string name =
      parts_.list().size() == 1 ? "the body" : fmt::format("part {} of {}", p + 1, parts_.list().size());
  return fmt::format("{} ({} cells, x {:.6g} to {:.6g} m, y {:.6g} to {:.6g} m, z {:.6g} to {:.6g} m)", name,
                     part.cells, lo[0], hi[0], lo[1], hi[1], lo[2], hi[2]);
}

namespace {

// Orthonormal columns that span the columns of A, as far as they are longer than `least`. A may have none.
Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& A, double least) {
  if (A.cols() == 0) return A;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(A, Eigen::ComputeFullU);
  Eigen::Index rank = 0;
  while (rank < svd.singularValues().size() && svd.singularValues()(rank) > least) ++rank;
  return svd.matrixU().leftCols(rank);
}

// "x, y" or "(0.707, 0.707, 0)": the coordinate axes within a space first, then axes that span what is left of it.
std::string axes_in_words(const Eigen::MatrixXd& space) {
  std::string list;
  const auto append = [&](const std::string& word) { list += (list.empty() ? "" : ", ") + word; };
  Eigen::MatrixXd rest = space;
  for (int a = 0; a < 3; ++a)
    if (space.cols() > 0 && (space.transpose() * Eigen::Vector3d::Unit(a)).norm() > 1 - 1e-6) {
      append(std::string(1, "xyz"[a]));
      rest.row(a).setZero();
    }
  const Eigen::MatrixXd axes = orthonormal(rest, 1e-3);
  for (Eigen::Index i = 0; i < axes.cols(); ++i) {
    // An axis has no sign: its largest component is shown positive, and no zero as "-0".
    Eigen::Vector3d axis = axes.col(i);
    Eigen::Index largest = 0;
    axis.cwiseAbs().maxCoeff(&largest);
    if (axis(largest) < 0) axis = -axis;
    for (double& x : axis) x = std::round(1e3 * x) / 1e3 + 0.0;
    append(fmt::format("({:.3g}, {:.3g}, {:.3g})", axis(0), axis(1), axis(2)));
  }
  return list;
}

}  // namespace

std::string FreeMotions::in_words(const Eigen::MatrixXd& V) {
  // Translations are combinations without rotation; an axis is free to turn when some motion turns about it.
  const double unit = V.norm();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(V.bottomRows(3), Eigen::ComputeFullV);
  Eigen::Index rank = 0;
  while (rank < svd.singularValues().size() && svd.singularValues()(rank) > 1e-6 * unit) ++rank;
  const Eigen::MatrixXd straight = V.topRows(3) * svd.matrixV().rightCols(V.cols() - rank);
  const std::string moves = axes_in_words(orthonormal(straight, 1e-6 * unit));
  const std::string turns = axes_in_words(orthonormal(V.bottomRows(3), 1e-6 * unit));
  std::string text;
  if (!moves.empty()) text = "move along " + moves;
  if (!turns.empty()) text += (text.empty() ? "rotate about " : " and rotate about ") + turns;
  return text;
}

}  // namespace koshi::statics
