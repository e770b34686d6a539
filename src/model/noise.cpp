#include "model/noise.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace koshi::model {
namespace {

// The output function of SplitMix64 (Steele, Lea, Flood 2014): every bit of the result depends on every bit of z.
std::uint64_t mixed(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31);
}

// Between 0 and 1, ends excluded.
double uniform(std::uint64_t bits) { return (static_cast<double>(bits >> 11) + 0.5) * 0x1p-53; }

// Weights of the noise within `radius` cells on a line, squares adding up to 1. A Gaussian of half the length: with
// itself it gives one of the length, over sqrt 2.
std::vector<double> weights_of(double length, std::int64_t radius) {
  std::vector<double> weights;
  double squares = 0;
  for (std::int64_t x = -radius; x <= radius; ++x) {
    const double over = radius == 0 ? 0 : static_cast<double>(x) / length;
    weights.push_back(std::exp(-2 * over * over));
    squares += weights.back() * weights.back();
  }
  for (double& weight : weights) weight /= std::sqrt(squares);
  return weights;
}

// sum of weights[w] from[w step]
double weighted(const std::vector<double>& weights, const double* from, std::int64_t step) {
  double sum = 0;
  for (std::size_t w = 0; w < weights.size(); ++w) sum += weights[w] * from[static_cast<std::int64_t>(w) * step];
  return sum;
}

}  // namespace

double normal_number(const Int3& cell, std::uint64_t seed) {
  constexpr std::uint64_t golden = 0x9e3779b97f4a7c15U;
  std::uint64_t key = mixed(seed + golden);
  for (const std::int64_t index : cell) key = mixed(key + golden + static_cast<std::uint64_t>(index));
  // Box and Muller.
  const double radius = std::sqrt(-2 * std::log(uniform(mixed(key + golden))));
  return radius * std::cos(2 * std::numbers::pi * uniform(mixed(key + 2 * golden)));
}

std::vector<double> gaussian_numbers(const lattice::Grid& grid, const Int3& lo, const Int3& hi, double length,
                                     std::uint64_t seed) {
  // Beyond two lengths the weights are below e^-8.
  const auto radius = static_cast<std::int64_t>(std::ceil(2 * length));
  const std::vector<double> weights = weights_of(length, radius);
  const Int3 n{hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]};
  const auto count = [](std::int64_t a, std::int64_t b) { return static_cast<std::size_t>(a * b); };
  std::vector<double> numbers(static_cast<std::size_t>(n[0] * n[1] * n[2]), 0.0);

  // One layer of noise after the other, each spread along x and along y, and then over the layers within reach. Terms
  // come in the order of the noise, whatever the box.
  std::vector<double> line(static_cast<std::size_t>(n[0] + 2 * radius)), rows(count(n[0], n[1] + 2 * radius));
  for (std::int64_t k = lo[2] - radius; k < hi[2] + radius; ++k) {
    for (std::int64_t j = 0; j < n[1] + 2 * radius; ++j) {
      for (std::int64_t i = 0; i < n[0] + 2 * radius; ++i) {
        Int3 cell{lo[0] - radius + i, lo[1] - radius + j, k};
        for (std::size_t a = 0; a < 3; ++a)
          if (grid.periodic[a]) cell[a] = (cell[a] % grid.cells[a] + grid.cells[a]) % grid.cells[a];
        line[static_cast<std::size_t>(i)] = normal_number(cell, seed);
      }
      for (std::int64_t i = 0; i < n[0]; ++i)
        rows[count(n[0], j) + static_cast<std::size_t>(i)] = weighted(weights, &line[static_cast<std::size_t>(i)], 1);
    }
    for (std::int64_t j = 0; j < n[1]; ++j)
      for (std::int64_t i = 0; i < n[0]; ++i) {
        const double spread = weighted(weights, &rows[count(n[0], j) + static_cast<std::size_t>(i)], n[0]);
        for (std::int64_t layer = std::max(lo[2], k - radius); layer < std::min(hi[2], k + radius + 1); ++layer)
          numbers[count(n[0] * n[1], layer - lo[2]) + count(n[0], j) + static_cast<std::size_t>(i)] +=
              weights[static_cast<std::size_t>(layer - k + radius)] * spread;
      }
  }
  return numbers;
}

}  // namespace koshi::model
