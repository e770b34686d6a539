// When a run writes checkpoints, and how it goes on from one.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "driver/simulation.h"

namespace koshi::driver {

/// Checkpoints of one run in its output directory. From its construction to its end SIGINT, SIGTERM, SIGUSR1, SIGUSR2,
/// SIGXCPU and SIGHUP ask the run to stop, after a last checkpoint if it is one in time, instead of ending the process.
class Checkpoints {
 public:
  Checkpoints(const model::Model& model, std::filesystem::path directory);
  ~Checkpoints();
  Checkpoints(const Checkpoints&) = delete;
  Checkpoints& operator=(const Checkpoints&) = delete;

  /// Goes on from a checkpoint of the same case, with its step (collective). Throws InputError also when the run would
  /// end before the checkpoint, or is an equilibrium, which has no checkpoints but its end.
  void restore(const std::filesystem::path& file, model::State& state);
  /// Writes one if it is due, by simulated or wall time, or because a signal came; true: stop the run (collective).
  bool poll(model::State& state);
  /// Whether a signal has asked the run to stop, on any rank (collective).
  bool stop_requested() const;
  void write(model::State& state);
  /// What to do after a failure: "; the last checkpoint is whole: --restart FILE", empty if there is none.
  std::string remedy() const;
  /// Writes the state of a diverged run beside, where it replaces no good checkpoint.
  std::filesystem::path write_diverged(model::State& state);

 private:
  void write_to(const std::filesystem::path& directory, model::State& state) const;

  const model::Model& model_;
  std::filesystem::path directory_;
  std::string case_text_;
  std::vector<std::pair<int, void (*)(int)>> before_;  ///< signals and what they did before
  std::filesystem::path last_;                         ///< that this run has written or started from
  double last_time_ = 0, last_wall_ = 0;               ///< of the last checkpoint [s]
};

/// Takes the displacements of the last checkpoint in an earlier run's output directory as the start: an equilibrium for
/// a dynamic run. The lattices must be alike, loads and boundaries may differ (collective).
void start_from(const std::filesystem::path& directory, const model::Model& model, model::State& state);

}  // namespace koshi::driver
