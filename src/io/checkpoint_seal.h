// The seal of a checkpoint: the first bytes of the file, which tell a whole checkpoint from anything else before a
// library looks at the rest.
#pragma once

#include <filesystem>
#include <string>

#include "io/checkpoint_index.h"
#include "koshi/communicator.h"

namespace koshi::io {

/// Size of the seal: HDF5's user block.
inline constexpr std::size_t seal_size = 512;

/// Version of the format; docs/formats/checkpoint.md.
inline constexpr int checkpoint_format = 2;

/// What the seal says of a file.
struct Seal {
  std::string koshi_version;    ///< of the program that wrote the file
  std::uint64_t file_size = 0;  ///< [bytes]
  Bytes index;                  ///< where the file's index is, a part of the file
};

/// Writes the seal of a file that is complete but for it, with the place of its index, and flushes the file to the disk
/// (collective: the ranks share the work of the checksum). Throws RunError.
void seal_checkpoint(const std::filesystem::path& file, const Bytes& index, const Communicator& communicator);

/// Returns only if the file is a whole checkpoint (collective). Throws InputError on all ranks.
Seal check_seal(const std::filesystem::path& file, const Communicator& communicator);

}  // namespace koshi::io
