// Plane waves in the infinite periodic lattice: its dynamic matrix (Bloch's theorem) and the speeds that follow.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "koshi/springs.h"
#include "koshi/vector3.h"

namespace koshi::mechanics {

/// Mass rho d^3 and rotational inertia J = 2/5 m R^2 of a node, R the radius of a sphere of volume d^3 (N24).
struct NodeInertia {
  double mass;  ///< [kg]
  double J;     ///< [kg m^2]
};
NodeInertia node_inertia(double density, double d);

/// The infinite lattice of one material, one node per unit cell.
class PeriodicLattice {
 public:
  PeriodicLattice(const material::Springs& springs, double d, material::Kinematics kinematics, double density);

  /// Dynamic matrix of waves u_n = q exp(i k.x_n - i omega t) for k = `phase` / d, `phase` in radians per cell and
  /// scaled by the masses: Hermitian, 6 x 6 (rotational) or 3 x 3, eigenvalues omega^2 [1/s^2]. An eigenvector v holds
  /// sqrt(m) u, then sqrt(J) w.
  Eigen::MatrixXcd dynamic_matrix(const Vec3& phase) const;

  double spacing() const { return d_; }

 private:
  double d_;
  Eigen::MatrixXd cell_;          ///< cell matrix
  Eigen::VectorXd inverse_root_;  ///< 1/sqrt of each unknown's inertia
};

/// Phase speeds omega/|k| [m/s] of the three waves that move the nodes most: P along the wave vector, two S across it.
struct PhaseSpeeds {
  double p = 0;
  double s_slow = 0;
  double s_fast = 0;
};

/// Waves of `cells` spacings per wavelength (> 2) along `direction` (any length).
PhaseSpeeds phase_speeds(const PeriodicLattice& lattice, const Vec3& direction, double cells);

struct DispersionRow {
  Vec3 direction{};  ///< [100], [110] or [111]
  double cells = 0;  ///< spacings per wavelength
  PhaseSpeeds speeds;
};

/// Speeds at 40, 20, 10, 8, 6 and 4 cells per wavelength along [100], [110] and [111]: 18 rows.
std::vector<DispersionRow> dispersion_table(const PeriodicLattice& lattice);

/// What a scan of the Brillouin zone finds.
struct ZoneScan {
  double least = 0;         ///< smallest omega^2 at a wave vector other than 0 [1/s^2]; may be negative
  double largest = 0;       ///< largest omega^2 [1/s^2]; 2/sqrt of it is the stable step of the infinite lattice
  Vec3 least_phase{};       ///< wave vector of the smallest, radians per cell
  int vectors = 0;          ///< wave vectors looked at, 0 left out
  int soft_vectors = 0;     ///< of these, those with a zero or negative omega^2
  bool soft_moves = false;  ///< some mode of zero omega^2 displaces nodes: a mechanism, not loose rotations alone
};

/// Wave vectors pi/d (i, j, k)/divisions with divisions >= i >= j >= k >= 0: all others follow by the cube's symmetry.
ZoneScan scan_zone(const PeriodicLattice& lattice, int divisions = 12);

}  // namespace koshi::mechanics
