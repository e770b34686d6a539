// Natural frequencies and the shapes in which a body swings.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "koshi/model.h"

namespace koshi::modes {

/// How modes are sought; count, near, tolerance and allow_floating are those of the model's [analysis].
struct ModesOptions {
  int max_iterations = 300;  ///< RunError beyond
  /// Called on all ranks after each iteration with the modes found so far and the largest residual of the others; false
  /// stops the search. Empty: not called.
  std::function<bool(int iteration, int found, double residual)> progress;
};

/// One way to swing. Components are x, y, z, and turns about the same axes through the centre of mass.
struct Mode {
  int number = 0;        ///< 1: the lowest vibration
  double frequency = 0;  ///< [Hz]
  double residual = 0;   ///< |K x - omega^2 M x| over |omega^2 M x|, both measured by M^-1
  /// [kg], x.M x of the shape whose largest displacement is 1 (largest rotation [1/m] where nothing is displaced).
  double modal_mass = 0;
  /// x.M r / x.M x with r the motion of the body as a whole by 1 or about its centre by 1 [1], [m]
  std::array<double, 6> participation{};
  /// (x.M r)^2 / x.M x [kg], [kg m^2]
  std::array<double, 6> effective_mass{};
  /// The shape on this rank's owned nodes, x fastest, component by component; its largest displacement over all ranks
  /// is 1, rotations in 1/m.
  std::vector<double> shape;
};

/// What was found, and how it went.
struct ModesReport {
  std::vector<Mode> modes;                       ///< by frequency
  std::array<double, 6> total_effective_mass{};  ///< sum over all modes there are [kg], [kg m^2]
  std::array<double, 6> rigid_effective_mass{};  ///< part of it that belongs to the free motions
  Vec3 centre_of_mass{};                         ///< [m]
  std::int64_t unknowns = 0;                     ///< free components of all nodes
  int levels = 0;                                ///< of the multigrid hierarchy
  int iterations = 0;                            ///< of the search
  int searched = 0;                              ///< modes found from the lowest on, `modes` among them
  bool stopped = false;                          ///< progress asked to stop; modes are empty
  double setup_seconds = 0;                      ///< wall time before the iterations [s]
  double solve_seconds = 0;                      ///< wall time of the iterations [s]
  int projected_motions = 0;                     ///< rigid motions that nothing holds, taken out
  std::string free_motions;                      ///< the same in words, part by part; empty when all is held
};

/// The rigid motions that nothing holds, in words; empty when all parts are held (collective). Errors: InputError for
/// parts that float beside others (unless `analysis` allows it) and when the body has fewer modes than asked for.
std::string free_motions(const model::Model& model, const model::AnalysisDefinition& analysis);

/// Modes of free vibration about the unloaded body (collective); loads do not count. Residuals reach the square
/// root of the tolerance, and squared frequencies its own size. Errors: InputError as free_motions(); RunError when the
/// search does not converge, when motions cost no energy, or when more than 200 modes lie below those near a frequency.
ModesReport find_modes(const model::Model& model, const ModesOptions& options = {});

/// Puts a mode's shape into a field of the model's layout and components; ghosts are filled (collective).
void fill(const model::Model& model, const Mode& mode, lattice::Field<double>& displacement);

}  // namespace koshi::modes
