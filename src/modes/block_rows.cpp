#include "modes/block_rows.h"

namespace koshi::modes::KOSHI_ISA {
namespace {

typedef double Vector __attribute__((vector_size(64)));
static_assert(sizeof(Vector) == row_width * sizeof(double));

// Rows that are worked on together: the columns' pieces stay in the cache while all pairs meet.
constexpr std::int64_t chunk_rows = 256;

inline __attribute__((always_inline)) Vector load(const double* p) {
  Vector v;
  __builtin_memcpy(&v, p, sizeof v);
  return v;
}

// Adds the products of m columns of a and n columns of b over one chunk.
template <int m, int n>
void tile(const double* const* a, const double* const* b, std::int64_t from, std::int64_t to, double* out,
          std::int64_t pitch) {
  Vector sum[m][n] = {};
  for (std::int64_t r = from; r < to; r += row_width) {
    Vector left[m];
    for (int i = 0; i < m; ++i) left[i] = load(a[i] + r);
    for (int j = 0; j < n; ++j) {
      const Vector right = load(b[j] + r);
      for (int i = 0; i < m; ++i) sum[i][j] += left[i] * right;
    }
  }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < m; ++i) {
      double total = 0;
      for (int lane = 0; lane < row_width; ++lane) total += sum[i][j][lane];
      out[i + pitch * j] += total;
    }
}

void products(const double* const* a, int a_count, const double* const* b, int b_count, std::int64_t rows,
              double* out) {
  for (int i = 0; i < a_count * b_count; ++i) out[i] = 0;
  for (std::int64_t from = 0; from < rows; from += chunk_rows) {
    const std::int64_t to = from + chunk_rows < rows ? from + chunk_rows : rows;
    int j = 0;
    for (; j + 4 <= b_count; j += 4) {
      int i = 0;
      for (; i + 4 <= a_count; i += 4) tile<4, 4>(a + i, b + j, from, to, out + i + a_count * j, a_count);
      for (; i < a_count; ++i) tile<1, 4>(a + i, b + j, from, to, out + i + a_count * j, a_count);
    }
    for (; j < b_count; ++j) {
      int i = 0;
      for (; i + 4 <= a_count; i += 4) tile<4, 1>(a + i, b + j, from, to, out + i + a_count * j, a_count);
      for (; i < a_count; ++i) tile<1, 1>(a + i, b + j, from, to, out + i + a_count * j, a_count);
    }
  }
}

// One chunk of n combined columns into a buffer.
template <int n>
void combine_tile(const double* const* in, int in_count, const double* coefficient, std::int64_t from, std::int64_t to,
                  double* buffer) {
  for (std::int64_t r = from; r < to; r += row_width) {
    Vector sum[n] = {};
    for (int i = 0; i < in_count; ++i) {
      const Vector x = load(in[i] + r);
      for (int j = 0; j < n; ++j) sum[j] += x * coefficient[i + in_count * j];
    }
    for (int j = 0; j < n; ++j) __builtin_memcpy(buffer + chunk_rows * j + (r - from), &sum[j], sizeof sum[j]);
  }
}

void combine(const double* const* in, int in_count, const double* coefficient, double* const* out, int out_count,
             std::int64_t rows) {
  // Outputs may be inputs: a chunk is written back once all of it is known.
  double* const buffer = new double[static_cast<std::size_t>(chunk_rows * out_count)];
  for (std::int64_t from = 0; from < rows; from += chunk_rows) {
    const std::int64_t to = from + chunk_rows < rows ? from + chunk_rows : rows;
    int j = 0;
    for (; j + 4 <= out_count; j += 4)
      combine_tile<4>(in, in_count, coefficient + in_count * j, from, to, buffer + chunk_rows * j);
    for (; j < out_count; ++j)
      combine_tile<1>(in, in_count, coefficient + in_count * j, from, to, buffer + chunk_rows * j);
    for (j = 0; j < out_count; ++j)
      __builtin_memcpy(out[j] + from, buffer + chunk_rows * j, static_cast<std::size_t>(to - from) * sizeof(double));
  }
  delete[] buffer;
}

}  // namespace

extern const BlockKernels kernels;
const BlockKernels kernels{products, combine};

}  // namespace koshi::modes::KOSHI_ISA
