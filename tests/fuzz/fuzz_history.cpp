// The history of a run against arbitrary files: columns of one length, or an InputError.
#include "io/history_reader.h"

#include <cstdlib>

#include "koshi/error.h"
#include "support/memory_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const koshi::test::MemoryFile file(data, size);
  try {
    const auto columns = koshi::io::read_history(file.path());
    for (const auto& column : columns)
      if (column.values.size() != columns[0].values.size()) std::abort();
  } catch (const koshi::InputError&) {
  }
  return 0;
}
