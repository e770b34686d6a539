// Compiled once per instruction set with KOSHI_ISA set to its name.
#include "mechanics/relax_rows.h"

#include "mechanics/vector.h"

namespace koshi::mechanics::KOSHI_ISA {
namespace {

using V = Vector<float>::type;

// z = B r for a vector of nodes from i on.
template <int components>
KOSHI_INLINE void apply_blocks(const RelaxRow& row, std::int64_t i, const V (&r)[6], V (&z)[6]) {
  const std::int64_t block = row.block[i / block_width];
  if (block < 0) {
    // As below, where the other elements are zero.
    const float* const inverse = row.uniform + 3 * ~block;
    for (int a = 0; a < components; ++a) z[a] = inverse[2] * (inverse[a / 3] * r[a]);
    return;
  }
  const std::int16_t* entry = row.blocks + components * (components + 1) / 2 * block_width * block + i % block_width;
  for (int a = 0; a < components; ++a) {
    z[a] = V{};
    for (int b = 0; b <= a; ++b, entry += block_width) {
      const V e = widened_integers(entry);
      z[a] += e * r[b];
      if (b < a) z[b] += e * r[a];
    }
  }
  const V unit = load(row.units + block_width * block + i % block_width);
  for (int a = 0; a < components; ++a) z[a] *= unit;
}

template <int components>
void relax_components(const RelaxRow& row, float p, float q, float c) {
  for (std::int64_t i = 0; i < row.count; i += width<float>) {
    V r[6], z[6];
    for (int a = 0; a < components; ++a)
      r[a] = load(row.b + a * row.pitch + i) + load(row.force + a * row.force_pitch + i);
    apply_blocks<components>(row, i, r, z);
    for (int a = 0; a < components; ++a) {
      const std::int64_t at = a * row.pitch + i;
      store(row.y + at, p * load(row.x + at) + q * load(row.y + at) + c * z[a]);
    }
  }
}

template <int components>
void relax_zero_components(const RelaxRow& row, float c) {
  for (std::int64_t i = 0; i < row.count; i += width<float>) {
    V r[6], z[6];
    for (int a = 0; a < components; ++a) r[a] = load(row.b + a * row.pitch + i);
    apply_blocks<components>(row, i, r, z);
    for (int a = 0; a < components; ++a) store(row.y + a * row.pitch + i, c * z[a]);
  }
}

void relax(const RelaxRow& row, int components, float p, float q, float c) {
  components == 6 ? relax_components<6>(row, p, q, c) : relax_components<3>(row, p, q, c);
}

void relax_zero(const RelaxRow& row, int components, float c) {
  components == 6 ? relax_zero_components<6>(row, c) : relax_zero_components<3>(row, c);
}

void residual(const RelaxRow& row, int components) {
  for (int a = 0; a < components; ++a)
    for (std::int64_t i = 0; i < row.count; i += width<float>)
      store(row.y + a * row.pitch + i, load(row.b + a * row.pitch + i) + load(row.force + a * row.force_pitch + i));
}

void combine(float* to, const float* const* from, const float* weight, int rows, std::int64_t count) {
  for (std::int64_t i = -1; i < count; i += width<float>) {
    V sum = weight[0] * load(from[0] + i);
    for (int r = 1; r < rows; ++r) sum += weight[r] * load(from[r] + i);
    store(to + i, sum);
  }
}

void prolong(float* fine, const float* coarse, float scale, std::int64_t count) {
  const std::int64_t pairs = count / 2;
#pragma GCC ivdep
  for (std::int64_t I = 0; I < pairs; ++I) {
    fine[2 * I] += scale * coarse[I];
    fine[2 * I + 1] += 0.5f * scale * (coarse[I] + coarse[I + 1]);
  }
  if (count % 2 != 0) fine[count - 1] += scale * coarse[pairs];
}

void restrict_(float* coarse, const float* fine, float scale, std::int64_t count) {
#pragma GCC ivdep
  for (std::int64_t I = 0; I < count; ++I)
    coarse[I] = scale * (fine[2 * I] + 0.5f * (fine[2 * I - 1] + fine[2 * I + 1]));
}

}  // namespace

extern const RelaxKernels relax_kernels{relax, relax_zero, residual, combine, prolong, restrict_};

}  // namespace koshi::mechanics::KOSHI_ISA
