#include "model/scatter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/check.h"
#include "model/grains.h"
#include "model/noise.h"

namespace koshi::model {
namespace {

using lattice::Field;
using material::Scatter;

// Multiplies the values of the cells of one material, by its index, by random factors.
void scatter_material(const SpringLattice& body, int material, const Scatter& scatter, Field<float>& values) {
  const std::uint16_t* cell = body.cell.component(0);
  const Int3 lo = body.layout.global({-1, -1, -1}), hi = body.layout.global(body.layout.owned());
  const std::vector<double> numbers = gaussian_numbers(body.grid, lo, hi, scatter.correlation_length / body.grid.d,
                                                       static_cast<std::uint64_t>(scatter.seed));
  std::size_t at = 0;
  lattice::for_each(body.layout, {-1, -1, -1}, body.layout.owned(), [&](auto, auto, auto, auto n) {
    const double number = numbers[at++];
    if (cell[n] == material) values.component(0)[n] *= static_cast<float>(scattered(scatter, number));
  });
}

Field<float> ones(const SpringLattice& body) {
  Field<float> field(body.layout, 1);
  std::fill_n(field.component(0), field.count(), 1.0F);
  return field;
}

// Values from a file or a program, one for each cell of the body.
void multiply_given(const Definition& definition, const SpringLattice& body, Field<float>& values) {
  const std::vector<float>& given = definition.body.strengths;
  const Int3& n = body.grid.cells;
  const Checker check(definition);
  if (static_cast<std::int64_t>(given.size()) != body.grid.cell_count())
    check.fail("body.strength", fmt::format("there are strengths for {} cells, but the body has {} x {} x {}",
                                            given.size(), n[0], n[1], n[2]));
  for (std::size_t at = 0; at < given.size(); ++at)
    if (!(given[at] > 0 && std::isfinite(given[at]))) {
      const auto cell = static_cast<std::int64_t>(at);
      check.fail("body.strength",
                 fmt::format("the strength of cell ({}, {}, {}) is {:.6g} times its material's; factors are above 0",
                             cell % n[0], cell / n[0] % n[1], cell / (n[0] * n[1]), given[at]));
    }
  for_each_cell(body, [&](const Int3& cell, std::int64_t at) {
    values.component(0)[at] *= given[static_cast<std::size_t>(cell[0] + n[0] * (cell[1] + n[1] * cell[2]))];
  });
}

}  // namespace

double scattered(const Scatter& scatter, double normal_number) {
  // Beyond three standard deviations normal factors stay at their ends, so that all are positive.
  if (scatter.distribution == material::Distribution::normal)
    return 1 + scatter.variation * std::clamp(normal_number, -3.0, 3.0);
  // The part of the normal distribution above the number is the part of Weibull's above the factor, exp(-(f/f_0)^m);
  // the mean is f_0 Gamma(1 + 1/m).
  const double above = 0.5 * std::erfc(normal_number / std::numbers::sqrt2);
  return std::pow(-std::log(above), 1 / scatter.modulus) / std::tgamma(1 + 1 / scatter.modulus);
}

void scatter_stiffness(const Definition& definition, SpringLattice& body) {
  for (std::size_t m = 0; m < definition.materials.size(); ++m) {
    const auto& scatter = definition.materials[m].stiffness_scatter;
    if (!scatter) continue;
    if (body.factor.components() == 0) body.factor = ones(body);
    scatter_material(body, static_cast<int>(m) + 1, *scatter, body.factor);
  }
}

Field<float> strength_of_cells(const Definition& definition, const SpringLattice& body) {
  if (!definition.varies_in_strength()) return {};
  Field<float> strength = ones(body);
  for (std::size_t m = 0; m < definition.materials.size(); ++m) {
    const auto& fracture = definition.materials[m].fracture;
    if (fracture && fracture->strength_scatter)
      scatter_material(body, static_cast<int>(m) + 1, *fracture->strength_scatter, strength);
  }
  if (!definition.body.strengths.empty()) multiply_given(definition, body, strength);
  const auto& boundary = definition.body.grain_boundary;
  if (boundary && boundary->strength) {
    const auto on_boundary = grain_boundaries(definition, body.grid);
    for_each_cell(body, [&](const Int3& cell, std::int64_t at) {
      if (on_boundary(cell)) strength.component(0)[at] *= static_cast<float>(*boundary->strength);
    });
  }
  return strength;
}

}  // namespace koshi::model
