#include "base/instruction_set.h"
#include "failure/strain_rows.h"

namespace koshi::failure {

namespace baseline {
extern const StrainRows function;
}
#if defined(KOSHI_X86_KERNELS)
namespace avx2 {
extern const StrainRows function;
}
namespace avx512 {
extern const StrainRows function;
}
#endif

StrainRows strain_rows() {
#if defined(KOSHI_X86_KERNELS)
  if (instruction_set() == InstructionSet::avx512) return avx512::function;
  if (instruction_set() == InstructionSet::avx2) return avx2::function;
#endif
  return baseline::function;
}

}  // namespace koshi::failure
