// What every reader of images must hold for any bytes: an InputError, or an image all of whose values are there.
#pragma once

#include "io/voxels/formats.h"
#include "koshi/error.h"
#include "support/memory_file.h"

namespace koshi::test {

template <class Read>
void fuzz_image(Read&& read, const std::uint8_t* data, std::size_t size) {
  const MemoryFile file(data, size);
  io::VoxelImage image;
  try {
    image = read(file.path());
  } catch (const InputError&) {
    return;
  }
  const std::int64_t count = image.size[0] * image.size[1] * image.size[2];
  if (count <= 0 || image.bytes.size() != static_cast<std::size_t>(count) * io::size_of(image.type)) std::abort();
  // The corners of the box lie at the ends of the memory.
  double sum = io::value_at(image.bytes, image.type, 0);
  std::int64_t last = 0;
  for (std::size_t a = 0; a < 3; ++a) last += (image.size[a] - 1) * image.stride[a];
  if (last != count - 1) std::abort();
  sum += io::value_at(image.bytes, image.type, static_cast<std::size_t>(last));
  if (sum == 0.12345) std::abort();  // so that the values are read
}

}  // namespace koshi::test
