// The reader of this format against arbitrary files.
#include "fuzz/fuzz_image.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  koshi::test::fuzz_image(koshi::io::read_tiff, data, size);
  return 0;
}
