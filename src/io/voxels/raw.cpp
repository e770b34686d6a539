// Raw files: values one after the other, of which the input says everything.
#include <fmt/format.h>

#include "io/voxels/formats.h"
#include "koshi/error.h"

namespace koshi::io {

VoxelImage read_raw(const std::filesystem::path& path, const VoxelHeader& header, std::uint64_t offset) {
  const InputFile file(path);
  if (offset > file.size())
    throw InputError(fmt::format("has {} bytes, but its values are said to begin behind {}", file.size(), offset));
  ByteSource source(file, offset, file.size(), Compression::none);
  return read_values(header, source);
}

}  // namespace koshi::io
