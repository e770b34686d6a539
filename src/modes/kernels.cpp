#include "base/instruction_set.h"
#include "modes/block_rows.h"

namespace koshi::modes {

namespace baseline {
extern const BlockKernels kernels;
}
#if defined(KOSHI_X86_KERNELS)
namespace avx2 {
extern const BlockKernels kernels;
}
namespace avx512 {
extern const BlockKernels kernels;
}
#endif

const BlockKernels& block_kernels() {
#if defined(KOSHI_X86_KERNELS)
  if (instruction_set() == InstructionSet::avx512) return avx512::kernels;
  if (instruction_set() == InstructionSet::avx2) return avx2::kernels;
#endif
  return baseline::kernels;
}

}  // namespace koshi::modes
