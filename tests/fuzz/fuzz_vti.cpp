// The reader of VTK images against arbitrary files.
#include "fuzz/fuzz_image.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  koshi::test::fuzz_image(koshi::io::read_vti_image, data, size);
  return 0;
}
