#include "base/instruction_set.h"
#include "failure/strain_rows.h"

namespace koshi::failure {

namespace baseline {
extern const StrainRows functions;
}
#if defined(KOSHI_X86_KERNELS)
namespace avx2 {
extern const StrainRows functions;
}
namespace avx512 {
extern const StrainRows functions;
}
#endif

const StrainRows& strain_rows() {
#if defined(KOSHI_X86_KERNELS)
  if (instruction_set() == InstructionSet::avx512) return avx512::functions;
  if (instruction_set() == InstructionSet::avx2) return avx2::functions;
#endif
  return baseline::functions;
}

}  // namespace koshi::failure
