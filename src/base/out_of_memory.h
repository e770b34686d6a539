// What was being made when memory ran out.
#pragma once

#include <new>
#include <stdexcept>
#include <string>

namespace koshi {

/// Memory has run out; `what()` says while making what. A single rank may throw it, when the others wait for it.
class OutOfMemory : public std::bad_alloc {
 public:
  explicit OutOfMemory(const std::string& making)
      : text_("out of memory while making " + making + "; `koshi check` says how much a run takes") {}
  const char* what() const noexcept override { return text_.c_str(); }

 private:
  std::string text_;
};

/// Calls make() and returns what it does; memory that runs out becomes OutOfMemory.
template <class F>
auto while_making(const std::string& what, F&& make) {
  try {
    return make();
  } catch (const OutOfMemory&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw OutOfMemory(what);
  } catch (const std::length_error&) {  // of a container: more than any memory holds
    throw OutOfMemory(what);
  }
}

}  // namespace koshi
