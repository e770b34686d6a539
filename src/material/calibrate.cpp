// Nishimura et al.'s calibration: entries of (N21) set equal to those of the elastic tensor.
#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <Eigen/Dense>

#include "koshi/calibration.h"
#include "koshi/error.h"

namespace koshi::material {
namespace {

/// A factor times an entry C_ijkl, indices from 0.
struct Term {
  double factor;
  std::array<int, 4> index;
};

[[noreturn]] void unreadable(const std::string& equation, const std::string& why) {
  throw InputError(fmt::format(
      "equation \"{}\": {}; expected a sum of entries such as \"C1122\" or \"C1111 - 2 C1212\"", equation, why));
}

/// Reads terms [+-] [factor [*]] Cijkl with i, j, k, l in 1..3; blanks do not count.
std::vector<Term> parse_equation(const std::string& equation) {
  std::string text = equation;
  std::erase_if(text, [](unsigned char c) { return c == ' ' || c == '\t' || c == '*'; });
  if (text.empty()) unreadable(equation, "it is empty");
  std::vector<Term> terms;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at != end) {
    Term term{1, {}};
    if (*at == '+' || *at == '-')
      term.factor = *at++ == '-' ? -1 : 1;
    else if (!terms.empty())
      unreadable(equation, fmt::format("\"{}\" is not joined by + or -", std::string(at, end)));

    double factor = 1;
    if (const auto [rest, error] = std::from_chars(at, end, factor, std::chars_format::fixed); error == std::errc{})
      at = rest;
    term.factor *= factor;

    if (at == end || (*at != 'C' && *at != 'c') || end - at < 5)
      unreadable(equation, fmt::format("\"{}\" is no entry", std::string(at, end)));
    for (int place = 0; place < 4; ++place) {
      const char digit = at[1 + place];
      if (digit < '1' || digit > '3') unreadable(equation, fmt::format("index \"{}\" is not 1, 2 or 3", digit));
      term.index[place] = digit - '1';
    }
    at += 5;
    terms.push_back(term);
  }
  return terms;
}

/// Body axis (0..2) that plays the role of axis 1, 2, 3.
std::array<int, 3> parse_axes(const std::string& axes) {
  std::string sorted = axes;
  std::sort(sorted.begin(), sorted.end());
  if (sorted != "xyz")
    throw InputError(fmt::format("axes = \"{}\"; expected a permutation of \"xyz\", such as \"yxz\"", axes));
  return {axes[0] - 'x', axes[1] - 'x', axes[2] - 'x'};
}

double evaluate(const std::vector<Term>& terms, const std::array<int, 3>& axis, const ElasticTensor& C) {
  double sum = 0;
  for (const Term& term : terms)
    sum += term.factor * C(axis[term.index[0]], axis[term.index[1]], axis[term.index[2]], axis[term.index[3]]);
  return sum;
}

/// Stiffness tensor of the bonds with kn = `kn`, kt = `kt` each.
ElasticTensor tensor_with(std::span<const BondGroup> bonds, double volume, double kn, double kt) {
  std::vector<BondGroup> uniform(bonds.begin(), bonds.end());
  for (BondGroup& bond : uniform) {
    bond.kn = kn;
    bond.kt = kt;
  }
  return lattice_tensor(uniform, volume);
}

}  // namespace

std::vector<std::string> default_equations(lattice::CellType cell) {
  switch (cell) {
    case lattice::CellType::cube_i:
      return {"C1111-C1122"};
    case lattice::CellType::cube_ii:
      return {"C1122", "C1212"};
    case lattice::CellType::cube_iii:
      return {"C1122", "C1111"};
  }
  return {};
}

void check_equation(const std::string& equation) { parse_equation(equation); }

BondStiffness calibrate(std::span<const BondGroup> bonds, double volume, const Elastic& elastic,
                        std::span<const std::string> equations, const std::string& axes) {
  if (equations.empty() || equations.size() > 2)
    throw InputError(fmt::format("{} equations; expected one (then kn = kt) or two", equations.size()));
  const std::array<int, 3> axis = parse_axes(axes);

  // C is linear in kn and kt: each equation reads a kn + b kt = target, with a, b in units of the elastic modulus.
  const ElasticTensor target = elastic_tensor(elastic);
  const ElasticTensor per_kn = tensor_with(bonds, volume, elastic.youngs_modulus, 0);
  const ElasticTensor per_kt = tensor_with(bonds, volume, 0, elastic.youngs_modulus);
  const Eigen::Index rows = static_cast<Eigen::Index>(equations.size());
  Eigen::MatrixX2d A(rows, 2);
  Eigen::VectorXd b(rows);
  for (Eigen::Index row = 0; row < rows; ++row) {
    const std::vector<Term> terms = parse_equation(equations[row]);
    A(row, 0) = evaluate(terms, axis, per_kn);
    A(row, 1) = evaluate(terms, axis, per_kt);
    b(row) = evaluate(terms, axis, target);
  }

  // What counts as zero beside the largest entry a set of bonds can give.
  const double largest = std::max(per_kn(0, 0, 0, 0), per_kt(0, 0, 0, 0));
  for (Eigen::Index row = 0; row < rows; ++row)
    if (A.row(row).cwiseAbs().maxCoeff() < 1e-12 * largest)
      throw InputError(fmt::format(
          "equation \"{}\" holds no stiffness: these bonds add nothing to it; choose another entry", equations[row]));

  BondStiffness stiffness;
  if (rows == 1) {
    const double sum = A(0, 0) + A(0, 1);
    if (std::abs(sum) < 1e-12 * largest)
      throw InputError(fmt::format("equation \"{}\" does not determine kn = kt: their parts cancel", equations[0]));
    stiffness.kn = stiffness.kt = b(0) / sum * elastic.youngs_modulus;
  } else {
    if (std::abs(A.determinant()) < 1e-12 * A.row(0).norm() * A.row(1).norm())
      throw InputError(
          fmt::format("equations \"{}\" and \"{}\" do not determine kn and kt: both hold them in the same ratio; "
                      "choose another entry",
                      equations[0], equations[1]));
    const Eigen::Vector2d k = A.topRows<2>().partialPivLu().solve(b) * elastic.youngs_modulus;
    stiffness = {k(0), k(1)};
  }

  // At a limit such as nu = 1/4 rounding may leave a zero just below zero.
  const double rounding = 1e-12 * std::max(std::abs(stiffness.kn), std::abs(stiffness.kt));
  if (std::abs(stiffness.kn) < rounding) stiffness.kn = 0;
  if (std::abs(stiffness.kt) < rounding) stiffness.kt = 0;
  if (const double least = std::min(stiffness.kn, stiffness.kt); !(least >= 0))
    throw InputError(fmt::format(
        "equation{} \"{}\" give{} kn = {:.6g} N/m, kt = {:.6g} N/m at nu = {}; a negative stiffness is unstable. Equal "
        "bonds cannot have this Poisson's ratio: use calibration \"isotropic\"",
        rows == 1 ? "" : "s", fmt::join(equations, "\", \""), rows == 1 ? "s" : "", stiffness.kn, stiffness.kt,
        elastic.poissons_ratio));
  return stiffness;
}

}  // namespace koshi::material
