#include "base/instruction_set.h"
#include "mechanics/row_kernels.h"

namespace koshi::mechanics {

namespace baseline {
extern const RowKernels<double> kernels_double;
extern const RowKernels<float> kernels_float;
}  // namespace baseline
#if defined(KOSHI_X86_KERNELS)
namespace avx2 {
extern const RowKernels<double> kernels_double;
extern const RowKernels<float> kernels_float;
}  // namespace avx2
namespace avx512 {
extern const RowKernels<double> kernels_double;
extern const RowKernels<float> kernels_float;
}  // namespace avx512
#endif

namespace {

template <class T>
const RowKernels<T>& choose(const RowKernels<double>& d, const RowKernels<float>& f) {
  if constexpr (sizeof(T) == sizeof(double))
    return d;
  else
    return f;
}

}  // namespace

template <class T>
const RowKernels<T>& row_kernels() {
#if defined(KOSHI_X86_KERNELS)
  if (instruction_set() == InstructionSet::avx512) return choose<T>(avx512::kernels_double, avx512::kernels_float);
  if (instruction_set() == InstructionSet::avx2) return choose<T>(avx2::kernels_double, avx2::kernels_float);
#endif
  return choose<T>(baseline::kernels_double, baseline::kernels_float);
}

template const RowKernels<double>& row_kernels<double>();
template const RowKernels<float>& row_kernels<float>();

}  // namespace koshi::mechanics
