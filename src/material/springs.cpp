// Closed forms of theory.md, sections 7 and 8.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "koshi/calibration.h"
#include "koshi/error.h"

namespace koshi::material {
namespace {

/// Springs given in units of mu d, kappa in units of mu.
Springs scaled(const Springs& unit, double mu, double d) {
  Springs springs;
  for (int family = 0; family < lattice::family_count; ++family) {
    springs.kn[family] = unit.kn[family] * mu * d;
    springs.kt[family] = unit.kt[family] * mu * d;
  }
  springs.kappa = unit.kappa * mu;
  return springs;
}

/// lambda / mu without the loss of digits of (lambda / E) / (mu / E).
double lambda_over_mu(double nu) { return 2 * nu / (1 - 2 * nu); }

Springs bending_exact_rotational(double nu, double floor = 0.03) {
  // Uniform strain (isotropy, C1111, C1122, C1212), bending, its Poisson coupling and torsion: seven conditions for
  // seven constants. From nu = 0.302 on, the floor holds the node rotations and torsion gives way.
  const double c = 2 * nu / (3 * (1 - nu));
  const double t = nu <= 0 ? 2.0 / 9 * (1 - 2 * nu) / (1 - nu) : std::max(2.0 / 9 * (1 - 3 * nu) / (1 - nu), floor);
  Springs unit;
  unit.kn[0] = 2.0 / 3 - 2 * t;
  unit.kt[0] = 2.0 / 3 - 2 * t - 2 * c;
  if (nu >= 0) unit.kt[0] = std::max(unit.kt[0], floor);
  unit.kn[1] = t + c;
  unit.kt[1] = t;
  unit.kt[2] = 0.5 - 1 / (6 * (1 - nu)) - t / 2;
  unit.kn[2] = 0.75 * (1 - unit.kt[0] / 2 - unit.kn[1] - unit.kt[1] - 2.0 / 3 * unit.kt[2]);
  unit.kappa = lambda_over_mu(nu) - c - 4.0 / 3 * (unit.kn[2] - unit.kt[2]);
  return unit;
}

Springs beam_exact_rotational(double nu) {
  // Node rotations need kt >= f in edges and face diagonals. Where torsion then leaves less coupling
  // C = kn2 - kt2 than a plate has, a beam still bends exactly if B - C^2 / B = 2/3 (1 + nu), B = kn1 + kn2 + kt2: its
  // section curls freely, by -C / B of the curvature.
  constexpr double f = 0.02;
  if (nu <= 0 || 2.0 / 9 * (1 - 3 * nu) / (1 - nu) >= f) return bending_exact_rotational(nu, f);
  Springs unit;
  unit.kt[0] = unit.kt[1] = f;
  unit.kn[1] = 1.0 / 3 - f / 2;
  const double beam = 2.0 / 3 * (1 + nu), C = unit.kn[1] - f;
  const double B = (beam + std::sqrt(beam * beam + 4 * C * C)) / 2;
  unit.kn[0] = B - unit.kn[1] - f;
  // Uniform strain: isotropy gives kn3 - kt3, C1212 then kt3, C1122 kappa.
  const double difference = 3.0 / 8 * (unit.kn[0] - unit.kt[0] - C);
  unit.kt[2] = (1 - unit.kt[0] / 2 - unit.kn[1] - unit.kt[1]) / 2 - 2.0 / 3 * difference;
  unit.kn[2] = unit.kt[2] + difference;
  unit.kappa = lambda_over_mu(nu) - C - 4.0 / 3 * difference;
  return unit;
}

Springs bending_exact_least_squares(double nu) {
  const double a = 2 * nu / (3 * (1 - nu));
  const double t = (1 - 3 * nu) / (18 * (1 - nu));
  Springs unit;
  unit.kn[0] = 2.0 / 3 - 5 * t;
  unit.kt[0] = t;
  unit.kn[1] = t + a;
  unit.kt[1] = t;
  unit.kt[2] = 0.5 - 1 / (6 * (1 - nu)) + t / 4;
  unit.kn[2] = 0.75 * (1 - 2.5 * t - a - 2.0 / 3 * unit.kt[2]);
  unit.kappa = lambda_over_mu(nu) - a - 4.0 / 3 * (unit.kn[2] - unit.kt[2]);
  return unit;
}

}  // namespace

void require_elastic_solid(const Elastic& elastic) {
  if (!(elastic.youngs_modulus > 0))
    throw InputError(fmt::format("Young's modulus is {} Pa; it must be positive", elastic.youngs_modulus));
  if (!(elastic.poissons_ratio > -1 && elastic.poissons_ratio < 0.5))
    throw InputError(fmt::format("Poisson's ratio is {}; it must lie between -1 and 0.5", elastic.poissons_ratio));
}

Springs uniform_springs(lattice::CellType cell, const BondStiffness& stiffness) {
  Springs springs;
  for (int family = 0; family < lattice::families_of(cell); ++family) {
    springs.kn[family] = stiffness.kn;
    springs.kt[family] = stiffness.kt;
  }
  return springs;
}

Springs isotropic_springs(lattice::CellType cell, const Elastic& elastic, double d) {
  // Pairwise springs carry lp = min(lambda, 2/3 mu) of lambda, so that kt >= 2/15 mu d; the volumetric spring the rest.
  const double lambda = lambda_over_mu(elastic.poissons_ratio);
  const double lp = std::min(lambda, 2.0 / 3);
  Springs unit;
  switch (cell) {
    case lattice::CellType::cube_i:
      unit = {{2, 0, 0}, {2, 0, 0}, lambda};
      break;
    case lattice::CellType::cube_ii: {
      const double kt = 0.4 * (1 - lp);
      unit = {{kt + lp, kt + lp, 0}, {kt, kt, 0}, lambda - lp};
      break;
    }
    case lattice::CellType::cube_iii: {
      const double kt = 8.0 / 15 * (1 - lp);
      const double kn = kt + 4.0 / 3 * lp;
      unit = {{kn, kn / 2, kn * 3 / 16}, {kt, kt / 2, kt * 3 / 16}, lambda - lp};
      break;
    }
  }
  return scaled(unit, elastic.mu(), d);
}

Springs bending_exact_springs(const Elastic& elastic, double d, Kinematics kinematics) {
  const double nu = elastic.poissons_ratio;
  const Springs unit =
      kinematics == Kinematics::rotational ? bending_exact_rotational(nu) : bending_exact_least_squares(nu);
  return scaled(unit, elastic.mu(), d);
}

Springs beam_exact_springs(const Elastic& elastic, double d, Kinematics kinematics) {
  // The fit needs no floor: its bending-exact springs meet every condition.
  const double nu = elastic.poissons_ratio;
  const Springs unit =
      kinematics == Kinematics::rotational ? beam_exact_rotational(nu) : bending_exact_least_squares(nu);
  return scaled(unit, elastic.mu(), d);
}

Springs springs_for(lattice::CellType cell, Calibration calibration, Kinematics kinematics, const Elastic& elastic,
                    double d) {
  require_elastic_solid(elastic);
  if (calibration == Calibration::isotropic) return isotropic_springs(cell, elastic, d);
  if (calibration == Calibration::paper)
    throw InputError("calibration \"paper\" needs the bonds of a body; without one use \"isotropic\"");
  if (cell != lattice::CellType::cube_iii)
    throw InputError(
        fmt::format("calibration \"{}\" needs the face and body diagonals of cell \"cube-III\", "
                    "not \"{}\"; use calibration \"isotropic\"",
                    calibration == Calibration::beam_exact ? "beam-exact" : "bending-exact", lattice::name(cell)));
  return calibration == Calibration::beam_exact ? beam_exact_springs(elastic, d, kinematics)
                                                : bending_exact_springs(elastic, d, kinematics);
}

}  // namespace koshi::material
