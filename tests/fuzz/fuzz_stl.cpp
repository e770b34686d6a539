// Surfaces against arbitrary files: cells of a small grid, or an InputError.
#include <algorithm>

#include "base/log.h"
#include "io/surface.h"
#include "koshi/error.h"
#include "support/memory_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  koshi::set_log_level({false, false});
  const koshi::test::MemoryFile file(data, size);
  koshi::lattice::Grid grid;
  grid.d = 1;
  grid.cells = {6, 5, 4};
  try {
    const auto inside = koshi::io::cells_inside(file.path(), 1, grid);
    if (inside.size() != 120 || std::count(inside.begin(), inside.end(), 1) == 0) std::abort();
  } catch (const koshi::InputError&) {
  }
  return 0;
}
