// The directory a run writes into.
#pragma once

#include <filesystem>

#include "koshi/communicator.h"

namespace koshi::io {

/// Makes the output directory and its parents where they are missing and checks that files can be written there
/// (collective). Call it once the input has been accepted, so that bad input leaves nothing behind. Throws InputError
/// on all ranks: a place that cannot be written, with the system's reason; a directory that holds files and no results
/// of Koshi, so that nobody's files are mixed with results. Results of an earlier run are left to be replaced file by
/// file.
void make_output_directory(const Communicator& communicator, const std::filesystem::path& directory);

}  // namespace koshi::io
