// Checkpoints: the state of a run in one file, to go on from on any number of ranks (docs/formats/checkpoint.md).
#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>

#include "koshi/model.h"

namespace koshi::io {

/// Everything in a checkpoint but the fields.
struct CheckpointInfo {
  double time = 0;                        ///< [s], of the state
  std::int64_t step = 0;                  ///< of the state
  std::string case_text;                  ///< the resolved input but what may differ in a restart; must be equal then
  std::map<std::string, double> scalars;  ///< what else the run needs to go on: accumulated energies and the like
  std::string blob;                       ///< further bytes of the writer's own
  std::string koshi_version;              ///< filled when read
};

/// A field beside displacement and velocity, e.g. the orientation.
struct CheckpointField {
  std::string name;
  lattice::Field<double>* values = nullptr;  ///< only read by write_checkpoint
};

/// Writes `checkpoint.h5` into the directory and keeps the one before as `checkpoint.previous.h5` (collective). Time
/// and step are the state's. At every moment, whatever happens to the process or the machine, `checkpoint.h5` is whole
/// once there has been one. Throws RunError with the system's reason on all ranks; both earlier files then stay.
void write_checkpoint(const std::filesystem::path& directory, const model::Model& model, const model::State& state,
                      const CheckpointInfo& info, std::span<const CheckpointField> fields = {});

/// Reads a checkpoint into the state (collective); `file` may be the output directory. Owned nodes get, bit for bit,
/// what was written on whatever number of ranks; ghosts are left alone. Throws InputError on all ranks: no such file,
/// no checkpoint, another format version, cut short, corrupted, of another case than `case_text` (says what differs),
/// of another lattice, without one of `fields`.
CheckpointInfo read_checkpoint(const std::filesystem::path& file, const model::Model& model,
                               const std::string& case_text, model::State& state,
                               std::span<const CheckpointField> fields = {});

/// What read_checkpoint() would return, for any case (collective). Throws InputError when the file is not whole.
CheckpointInfo read_checkpoint_header(const std::filesystem::path& file, const Communicator& communicator);

}  // namespace koshi::io
