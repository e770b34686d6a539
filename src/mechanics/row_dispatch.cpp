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
struct Choice {
  const RowKernels<T>& of(const RowKernels<double>& d, const RowKernels<float>& f) const {
    if constexpr (sizeof(T) == sizeof(double))
      return d;
    else
      return f;
  }
};

}  // namespace

template <class T>
const RowKernels<T>& row_kernels() {
  const Choice<T> choice;
#if defined(KOSHI_X86_KERNELS)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
    return choice.of(avx512::kernels_double, avx512::kernels_float);
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    return choice.of(avx2::kernels_double, avx2::kernels_float);
#endif
  return choice.of(baseline::kernels_double, baseline::kernels_float);
}

template const RowKernels<double>& row_kernels<double>();
template const RowKernels<float>& row_kernels<float>();

}  // namespace koshi::mechanics
