#pragma once
/// @file The factorisation of noise + kappa * bridge = L L^T for all kScatterFactors side by side: four
/// columns of a row at a time, whose sums stay in registers.

#include "core/simd/lanes.h"
#include "lookup/evidence/scatter_density.h"

namespace voussoir {

static_assert(kScatterFactors.size() == kLanes, "one lane for each");

struct ScatterFactorisation {
  std::size_t n;
  const double *difference, *noise, *bridge;
  DoubleLanes kappa;
  DoubleLanes *factor, *inverse;  // lower triangle and the row of the difference; of its diagonal
  double* pivots;                 // n lanes

  VOUSSOIR_INLINE DoubleLanes entry(std::size_t i, std::size_t j) const {
    if (i == n) return DoubleLanes{} + difference[j];
    const std::size_t at = lower_size(i) + j;
    return noise[at] + kappa * bridge[at];
  }
  VOUSSOIR_INLINE DoubleLanes* row(std::size_t i) const { return factor + lower_size(i); }
};

/// Entries j to j + 3 of row i: sums over what stands before them, then what they owe each other.
VOUSSOIR_INLINE void four_columns(const ScatterFactorisation& f, std::size_t i, std::size_t j) {
  DoubleLanes* const to = f.row(i);
  const DoubleLanes *const r0 = f.row(j), *const r1 = f.row(j + 1), *const r2 = f.row(j + 2),
                           *const r3 = f.row(j + 3);
  DoubleLanes s0 = f.entry(i, j), s1 = f.entry(i, j + 1), s2 = f.entry(i, j + 2), s3 = f.entry(i, j + 3);
  for (std::size_t p = 0; p < j; ++p) {
    const DoubleLanes own = to[p];
    s0 -= own * r0[p];
    s1 -= own * r1[p];
    s2 -= own * r2[p];
    s3 -= own * r3[p];
  }
  s0 *= f.inverse[j];
  s1 = (s1 - s0 * r1[j]) * f.inverse[j + 1];
  s2 = (s2 - s0 * r2[j] - s1 * r2[j + 1]) * f.inverse[j + 2];
  s3 = (s3 - s0 * r3[j] - s1 * r3[j + 1] - s2 * r3[j + 2]) * f.inverse[j + 3];
  to[j] = s0;
  to[j + 1] = s1;
  to[j + 2] = s2;
  to[j + 3] = s3;
}

/// Row i left of its diagonal; what it leaves of the diagonal's entry is returned.
VOUSSOIR_INLINE DoubleLanes factorise_row(const ScatterFactorisation& f, std::size_t i) {
  DoubleLanes* const to = f.row(i);
  std::size_t j = 0;
  for (; j + 4 <= i; j += 4) four_columns(f, i, j);
  for (; j < i; ++j) {
    DoubleLanes sum = f.entry(i, j);
    for (std::size_t p = 0; p < j; ++p) sum -= to[p] * f.row(j)[p];
    to[j] = sum * f.inverse[j];
  }
  DoubleLanes squares{}, others{};
  for (std::size_t p = 0; p + 1 < i; p += 2) {
    squares += to[p] * to[p];
    others += to[p + 1] * to[p + 1];
  }
  if (i % 2 == 1) squares += to[i - 1] * to[i - 1];
  return squares + others;
}

/// The sum of squares of L^-1 times the difference.
VOUSSOIR_INLINE DoubleLanes factorise_inline(const ScatterFactorisation& f) {
  for (std::size_t i = 0; i < f.n; ++i) {
    const DoubleLanes pivot = f.entry(i, i) - factorise_row(f, i);
    store_some(pivot, kLanes, f.pivots + kLanes * i);
    f.inverse[i] = 1.0 / square_root(pivot);
    f.row(i)[i] = pivot * f.inverse[i];
  }
  return factorise_row(f, f.n);
}

}  // namespace voussoir
