#include "base/instruction_set.h"
#include "failure/bond_rows.h"

namespace koshi::failure {

namespace baseline {
extern const BondRows bonds;
}
#if defined(KOSHI_X86_KERNELS)
namespace avx2 {
extern const BondRows bonds;
}
namespace avx512 {
extern const BondRows bonds;
}
#endif

BondRows bond_rows() {
#if defined(KOSHI_X86_KERNELS)
  if (instruction_set() == InstructionSet::avx512) return avx512::bonds;
  if (instruction_set() == InstructionSet::avx2) return avx2::bonds;
#endif
  return baseline::bonds;
}

}  // namespace koshi::failure
