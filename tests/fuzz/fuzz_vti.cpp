// The reader of VTK images against arbitrary files.
#include "fuzz/fuzz_image.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  koshi::test::fuzz_image([](const auto& file) { return koshi::io::read_vti_image(file, "material"); }, data, size);
  return 0;
}
