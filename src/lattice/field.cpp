#include "koshi/field.h"

#include <sys/mman.h>

#include <cstdint>
#include <new>

namespace koshi::lattice {
namespace {

constexpr std::size_t line = 64, huge_page = std::size_t{1} << 21;

/// Stands one cache line before the values.
struct Origin {
  void* memory;
  std::size_t mapped;  ///< bytes of a mapping of its own; 0: from the heap
};

Origin& origin_of(void* values) { return *reinterpret_cast<Origin*>(static_cast<char*>(values) - line); }

}  // namespace

// Large fields are mapped by themselves: the heap may keep what was freed, and the peak of a run would hold the fields
// of every phase. A kernel walks through dozens of rows at a time, each in another page: with small pages a good part
// of the time would go into address translation.
void* allocate_values(std::size_t bytes) {
  const bool mapped = bytes >= 2 * huge_page;
  std::size_t size = line + (bytes + line - 1) / line * line;
  void* memory = nullptr;
  std::uintptr_t start = 0;
  if (mapped) {
    size = (size + huge_page - 1) / huge_page * huge_page + huge_page;
    memory = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    start = (reinterpret_cast<std::uintptr_t>(memory) + huge_page - 1) / huge_page * huge_page;
    // A wish: without huge pages the program runs all the same.
    madvise(reinterpret_cast<void*>(start), size - huge_page, MADV_HUGEPAGE);
  } else {
    memory = ::operator new (size, std::align_val_t{line});
    start = reinterpret_cast<std::uintptr_t>(memory);
  }
  void* values = reinterpret_cast<void*>(start + line);
  origin_of(values) = {memory, mapped ? size : 0};
  return values;
}

void free_values(void* values) {
  if (values == nullptr) return;
  const Origin origin = origin_of(values);
  if (origin.mapped != 0)
    munmap(origin.memory, origin.mapped);
  else
    ::operator delete (origin.memory, std::align_val_t{line});
}

}  // namespace koshi::lattice
