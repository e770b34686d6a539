#include "koshi/field.h"

#include <sys/mman.h>

#include <cstdlib>
#include <new>

namespace koshi::lattice {

void* allocate_values(std::size_t bytes) {
  // A kernel walks through dozens of rows at a time, each in another page: small pages would spend a good part of the
  // time on address translation.
  constexpr std::size_t line = 64, huge_page = std::size_t{1} << 21;
  const std::size_t alignment = bytes >= 2 * huge_page ? huge_page : line;
  const std::size_t rounded = (bytes + alignment - 1) / alignment * alignment;
  void* values = std::aligned_alloc(alignment, rounded);
  if (values == nullptr && rounded != 0) throw std::bad_alloc();
#if defined(MADV_HUGEPAGE)
  // A wish: without huge pages the program runs all the same.
  if (alignment == huge_page) madvise(values, rounded, MADV_HUGEPAGE);
#endif
  return values;
}

void free_values(void* values) { std::free(values); }

}  // namespace koshi::lattice
