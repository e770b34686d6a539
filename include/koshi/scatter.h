// How a property differs from cell to cell.
#pragma once

namespace koshi::material {

/// Weibull's distribution of strengths, or the normal one.
enum class Distribution { weibull, normal };

/// Random factors of mean 1, one for each cell of a material, the same on any number of ranks (theory, section 12).
struct Scatter {
  Distribution distribution = Distribution::weibull;  ///< decides which of the next two counts
  double modulus = 0;             ///< weibull: m, at least 1; the larger, the less the factors differ
  double variation = 0;           ///< normal: standard deviation over mean, above 0 and at most 0.3
  double correlation_length = 0;  ///< l [m]: cells r apart are correlated by exp(-(r/l)^2); 0: each for itself
  int seed = 1;                   ///< of the random numbers, from 0; equal seeds give equal numbers
  bool operator==(const Scatter&) const = default;
};

}  // namespace koshi::material
