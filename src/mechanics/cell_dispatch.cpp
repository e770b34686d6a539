#include <type_traits>

#include "base/instruction_set.h"
#include "mechanics/cell_rows.h"
#include "mechanics/relax_rows.h"

namespace koshi::mechanics {

#define KOSHI_DECLARE(isa)                              \
  namespace isa {                                       \
  extern const CellKernels<float> cell_kernels_float;   \
  extern const CellKernels<double> cell_kernels_double; \
  extern const RelaxKernels relax_kernels;              \
  }
KOSHI_DECLARE(baseline)
#if defined(KOSHI_X86_KERNELS)
KOSHI_DECLARE(avx2)
KOSHI_DECLARE(avx512)
#endif

namespace {

struct Kernels {
  const CellKernels<float>& single;
  const CellKernels<double>& twofold;
  const RelaxKernels& relax;
};

const Kernels& kernels() {
  static const Kernels chosen = []() -> Kernels {
#if defined(KOSHI_X86_KERNELS)
    if (instruction_set() == InstructionSet::avx512)
      return {avx512::cell_kernels_float, avx512::cell_kernels_double, avx512::relax_kernels};
    if (instruction_set() == InstructionSet::avx2)
      return {avx2::cell_kernels_float, avx2::cell_kernels_double, avx2::relax_kernels};
#endif
    return {baseline::cell_kernels_float, baseline::cell_kernels_double, baseline::relax_kernels};
  }();
  return chosen;
}

}  // namespace

template <class T>
const CellKernels<T>& cell_kernels() {
  if constexpr (std::is_same_v<T, double>)
    return kernels().twofold;
  else
    return kernels().single;
}

template const CellKernels<double>& cell_kernels<double>();
template const CellKernels<float>& cell_kernels<float>();

const RelaxKernels& relax_kernels() { return kernels().relax; }

}  // namespace koshi::mechanics
