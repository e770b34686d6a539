// The reader takes any bytes: a case, or an InputError.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "koshi/input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const koshi::model::Definition definition = koshi::io::read_case_text(text, "case.toml");
    // What can be read can be written and read again.
    if (!(koshi::io::read_case_text(koshi::io::resolved_toml(definition), "resolved.toml") == definition)) std::abort();
  } catch (const koshi::InputError&) {
  }
  return 0;
}
