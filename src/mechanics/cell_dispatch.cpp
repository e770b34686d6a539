#include <type_traits>

#include "base/instruction_set.h"
#include "mechanics/cell_strip.h"
#include "mechanics/cut_block.h"
#include "mechanics/plain_rows.h"
#include "mechanics/relax_rows.h"

namespace koshi::mechanics {

#define KOSHI_DECLARE(isa)                                \
  namespace isa {                                         \
  extern const StripKernels<float> strip_kernels_float;   \
  extern const StripKernels<double> strip_kernels_double; \
  extern const CutKernels cut_kernels;                    \
  extern const RelaxKernels relax_kernels;                \
  extern const PlainKernels plain_kernels;                \
  }
KOSHI_DECLARE(baseline)
#if defined(KOSHI_X86_KERNELS)
KOSHI_DECLARE(avx2)
KOSHI_DECLARE(avx512)
#endif

namespace {

struct Kernels {
  const StripKernels<float>& single;
  const StripKernels<double>& twofold;
  const CutKernels& cut;
  const RelaxKernels& relax;
  const PlainKernels& plain;
};

const Kernels& kernels() {
  static const Kernels chosen = []() -> Kernels {
#if defined(KOSHI_X86_KERNELS)
    if (instruction_set() == InstructionSet::avx512)
      return {avx512::strip_kernels_float, avx512::strip_kernels_double, avx512::cut_kernels, avx512::relax_kernels,
              avx512::plain_kernels};
    if (instruction_set() == InstructionSet::avx2)
      return {avx2::strip_kernels_float, avx2::strip_kernels_double, avx2::cut_kernels, avx2::relax_kernels,
              avx2::plain_kernels};
#endif
    return {baseline::strip_kernels_float, baseline::strip_kernels_double, baseline::cut_kernels,
            baseline::relax_kernels, baseline::plain_kernels};
  }();
  return chosen;
}

}  // namespace

template <class T>
const StripKernels<T>& strip_kernels() {
  if constexpr (std::is_same_v<T, double>)
    return kernels().twofold;
  else
    return kernels().single;
}

template const StripKernels<float>& strip_kernels<float>();
template const StripKernels<double>& strip_kernels<double>();

const CutKernels& cut_kernels() { return kernels().cut; }

const RelaxKernels& relax_kernels() { return kernels().relax; }

const PlainKernels& plain_kernels() { return kernels().plain; }

}  // namespace koshi::mechanics
