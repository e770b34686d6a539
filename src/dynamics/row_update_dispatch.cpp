#include "base/instruction_set.h"
#include "dynamics/row_update.h"

namespace koshi::dynamics {

namespace baseline {
extern const RowUpdate functions;
}
#if defined(KOSHI_X86_KERNELS)
namespace avx2 {
extern const RowUpdate functions;
}
namespace avx512 {
extern const RowUpdate functions;
}
#endif

const RowUpdate& row_update() {
#if defined(KOSHI_X86_KERNELS)
  if (instruction_set() == InstructionSet::avx512) return avx512::functions;
  if (instruction_set() == InstructionSet::avx2) return avx2::functions;
#endif
  return baseline::functions;
}

}  // namespace koshi::dynamics
