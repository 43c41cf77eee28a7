#pragma once
/// @file The factorisation of a few rows and columns of several scenes' covariances side by side.

#include <limits>
#include <numbers>
#include <type_traits>

#include "core/simd/lane_math.h"
#include "lookup/unknown/scatter_density.h"

namespace voussoir {

/// The logarithm of a product of up to a hundred positive numbers, whose exponents are summed up, so that it
/// does not overflow. Pivots come as products of four of them: they are of the order of one, and 1e9 at most.
template <class Lanes>
class ProductLogarithm {
 public:
  VOUSSOIR_INLINE void multiply(const Lanes& number) {
    const Bits bits = reinterpret_cast<Bits>(number);
    exponent_ += __builtin_convertvector((bits >> kMantissaBits) - kBias, Lanes);
    mantissa_ *= reinterpret_cast<Lanes>((bits & kMantissa) | kOne);
  }
  VOUSSOIR_INLINE Lanes operator()() const {
    Lanes result = mantissa_;
    make_logarithm(result);
    return result + std::numbers::ln2_v<ElementOf<Lanes>> * exponent_;
  }

 private:
  using Word = std::conditional_t<std::is_same_v<ElementOf<Lanes>, float>, std::int32_t, std::int64_t>;
  using Bits = typename LanesOf<Word, sizeof(Lanes) / sizeof(Word)>::Type;
  static constexpr int kMantissaBits = std::numeric_limits<ElementOf<Lanes>>::digits - 1;
  static constexpr Word kBias = std::numeric_limits<ElementOf<Lanes>>::max_exponent - 1;
  static constexpr Word kMantissa = (Word{1} << kMantissaBits) - 1, kOne = kBias << kMantissaBits;

  Lanes exponent_{}, mantissa_ = Lanes{} + ElementOf<Lanes>(1);
};

/// noise + kappa bridge = L D L^T with a unit diagonal in L, four rows of L D at a time.
template <class Lanes, std::size_t N>
struct Factorisation {
  static constexpr std::size_t kTogether = 4;  // rows and columns whose sums are in registers
  static constexpr std::size_t kSolved = 2;    // rows that are solved for side by side
  const Lanes *noise, *bridge;
  ElementOf<Lanes> kappa;
  Lanes factor[lower_size(N)];  // L left of its diagonal
  Lanes inverse[N];             // of D
  Lanes rows[kTogether][N];     // of L D
  ProductLogarithm<Lanes> determinant;
  Lanes smallest_pivot;

  VOUSSOIR_INLINE Lanes entry(std::size_t i, std::size_t j) const {
    return noise[lower_size(i) + j] + kappa * bridge[lower_size(i) + j];
  }

  /// Columns j to j + 3 of kRows rows of L D from `row` on, which begin with their entries.
  template <std::size_t kRows>
  VOUSSOIR_INLINE void solve_columns(std::size_t row, std::size_t j) {
    Lanes sums[kRows][kTogether];
    for (std::size_t i = 0; i < kRows; ++i)
      for (std::size_t c = 0; c < kTogether; ++c) sums[i][c] = rows[row + i][j + c];
    for (std::size_t p = 0; p < j; ++p)
      for (std::size_t c = 0; c < kTogether; ++c) {
        const Lanes of_column = factor[lower_size(j + c) + p];
        for (std::size_t i = 0; i < kRows; ++i) sums[i][c] -= rows[row + i][p] * of_column;
      }
    for (std::size_t c = 0; c < kTogether; ++c)
      for (std::size_t i = 0; i < kRows; ++i) {
        for (std::size_t before = 0; before < c; ++before)
          sums[i][c] -= sums[i][before] * factor[lower_size(j + c) + j + before];
        rows[row + i][j + c] = sums[i][c];
      }
  }

  /// The block on the diagonal, where rows left of it are known.
  VOUSSOIR_INLINE void factorise_block(std::size_t first) {
    Lanes sums[kTogether][kTogether];
    for (std::size_t i = 0; i < kTogether; ++i)
      for (std::size_t j = 0; j <= i; ++j) sums[i][j] = entry(first + i, first + j);
    for (std::size_t p = 0; p < first; ++p)
      for (std::size_t j = 0; j < kTogether; ++j) {
        const Lanes own = factor[lower_size(first + j) + p];
        for (std::size_t i = j; i < kTogether; ++i) sums[i][j] -= rows[i][p] * own;
      }
    Lanes product = Lanes{} + ElementOf<Lanes>(1);
    for (std::size_t j = 0; j < kTogether; ++j) {
      const Lanes pivot = sums[j][j];
      inverse[first + j] = ElementOf<Lanes>(1) / pivot;
      smallest_pivot = smaller(smallest_pivot, pivot);
      product *= pivot;
      for (std::size_t i = j + 1; i < kTogether; ++i) {
        const Lanes own = sums[i][j] * inverse[first + j];
        factor[lower_size(first + i) + first + j] = own;
        for (std::size_t k = j + 1; k <= i; ++k) sums[i][k] -= own * sums[k][j];
      }
    }
    determinant.multiply(product);
  }

  VOUSSOIR_INLINE void factorise() {
    determinant = {};
    smallest_pivot = Lanes{} + ElementOf<Lanes>(1);
    for (std::size_t first = 0; first < N; first += kTogether) {
      for (std::size_t i = 0; i < kTogether; ++i)
        for (std::size_t j = 0; j < first; ++j) rows[i][j] = entry(first + i, j);
      for (std::size_t i = 0; i < kTogether; i += kSolved)
        for (std::size_t j = 0; j < first; j += kTogether) solve_columns<kSolved>(i, j);
      for (std::size_t i = 0; i < kTogether; ++i)
        for (std::size_t j = 0; j < first; ++j) factor[lower_size(first + i) + j] = rows[i][j] * inverse[j];
      factorise_block(first);
    }
  }

  /// NaN if the sum is not positive definite.
  VOUSSOIR_INLINE Lanes log_determinant() const {
    return smallest_pivot > ElementOf<Lanes>(0)
               ? determinant()
               : Lanes{} + std::numeric_limits<ElementOf<Lanes>>::quiet_NaN();
  }

  /// What a difference is in the inverse's quadratic form.
  VOUSSOIR_INLINE Lanes square_of(const Lanes* difference) {
    Lanes* const row = rows[0];
    for (std::size_t j = 0; j < N; ++j) row[j] = difference[j];
    for (std::size_t j = 0; j < N; j += kTogether) solve_columns<1>(0, j);
    Lanes square{};
    for (std::size_t j = 0; j < N; ++j) square += row[j] * (row[j] * inverse[j]);
    return square;
  }
};

}  // namespace voussoir
