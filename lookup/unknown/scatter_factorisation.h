#pragma once
/// @file Cholesky's factorisation L L^T of several symmetric matrices side by side, one in each lane, four
/// columns at a time: they stay in the cache while all rows below them are worked out, whose sums stay in
/// registers.

#include "core/simd/lanes.h"
#include "lookup/unknown/scatter_density.h"

namespace voussoir {

template <class Lanes>
struct ScatterFactorisation {
  static constexpr std::size_t kTogether = 4;
  std::size_t n;   // a multiple of kTogether
  Lanes* lower;    // the matrix, then L
  Lanes* inverse;  // of the diagonal of L
  Lanes* pivots;   // its squares

  VOUSSOIR_INLINE Lanes* row(std::size_t i) const { return lower + lower_size(i); }

  VOUSSOIR_INLINE static Lanes root(const Lanes& a) {
    Lanes result;
    for (std::size_t i = 0; i < sizeof(Lanes) / sizeof(DoubleLanes); ++i)
      store_part(square_root(load<DoubleLanes>(reinterpret_cast<const double*>(&a) + i * kLanes)), i, result);
    return result;
  }
  VOUSSOIR_INLINE static void store_part(const DoubleLanes& part, std::size_t i, Lanes& to) {
    store_some(part, kLanes, reinterpret_cast<double*>(&to) + i * kLanes);
  }

  /// Columns j to j + 3 of the rows j to j + 3.
  VOUSSOIR_INLINE void factorise_block(std::size_t first) const {
    Lanes sums[kTogether][kTogether];
    for (std::size_t i = 0; i < kTogether; ++i)
      for (std::size_t j = 0; j <= i; ++j) sums[i][j] = row(first + i)[first + j];
    for (std::size_t p = 0; p < first; ++p)
      for (std::size_t i = 0; i < kTogether; ++i)
        for (std::size_t j = 0; j <= i; ++j) sums[i][j] -= row(first + i)[p] * row(first + j)[p];
    for (std::size_t j = 0; j < kTogether; ++j) {
      pivots[first + j] = sums[j][j];
      inverse[first + j] = 1.0 / root(sums[j][j]);
      for (std::size_t i = j; i < kTogether; ++i) sums[i][j] *= inverse[first + j];
      for (std::size_t i = j + 1; i < kTogether; ++i)
        for (std::size_t k = j + 1; k <= i; ++k) sums[i][k] -= sums[i][j] * sums[k][j];
    }
    for (std::size_t i = 0; i < kTogether; ++i)
      for (std::size_t j = 0; j <= i; ++j) row(first + i)[first + j] = sums[i][j];
  }

  /// What the columns owe each other, in one row.
  VOUSSOIR_INLINE void finish(Lanes* to, std::size_t j, Lanes s0, Lanes s1, Lanes s2, Lanes s3) const {
    const Lanes *const r1 = row(j + 1) + j, *const r2 = row(j + 2) + j, *const r3 = row(j + 3) + j;
    s0 *= inverse[j];
    s1 = (s1 - s0 * r1[0]) * inverse[j + 1];
    s2 = (s2 - s0 * r2[0] - s1 * r2[1]) * inverse[j + 2];
    s3 = (s3 - s0 * r3[0] - s1 * r3[1] - s2 * r3[2]) * inverse[j + 3];
    to[j] = s0;
    to[j + 1] = s1;
    to[j + 2] = s2;
    to[j + 3] = s3;
  }

  /// Columns j to j + 3 of rows i and i + 1.
  VOUSSOIR_INLINE void factorise_two_rows(std::size_t i, std::size_t j) const {
    Lanes *const one = row(i), *const two = row(i + 1);
    const Lanes *const r0 = row(j), *const r1 = row(j + 1), *const r2 = row(j + 2), *const r3 = row(j + 3);
    Lanes s0 = one[j], s1 = one[j + 1], s2 = one[j + 2], s3 = one[j + 3];
    Lanes t0 = two[j], t1 = two[j + 1], t2 = two[j + 2], t3 = two[j + 3];
    for (std::size_t p = 0; p < j; ++p) {
      const Lanes a = one[p], b = two[p];
      s0 -= a * r0[p];
      s1 -= a * r1[p];
      s2 -= a * r2[p];
      s3 -= a * r3[p];
      t0 -= b * r0[p];
      t1 -= b * r1[p];
      t2 -= b * r2[p];
      t3 -= b * r3[p];
    }
    finish(one, j, s0, s1, s2, s3);
    finish(two, j, t0, t1, t2, t3);
  }

  VOUSSOIR_INLINE void factorise() const {
    for (std::size_t j = 0; j < n; j += kTogether) {
      factorise_block(j);
      for (std::size_t i = j + kTogether; i < n; i += 2) factorise_two_rows(i, j);
    }
  }
};

}  // namespace voussoir
