// The reader takes any bytes: a case, or an InputError.
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "koshi/input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    // What can be read can be written, read again and written alike.
    const std::string resolved = koshi::io::resolved_toml(koshi::io::read_case_text(text, "case.toml"));
    if (koshi::io::resolved_toml(koshi::io::read_case_text(resolved, "resolved.toml")) != resolved) std::abort();
  } catch (const koshi::InputError&) {
  }
  return 0;
}
