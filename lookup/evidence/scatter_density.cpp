#include "lookup/evidence/scatter_density.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/simd/lane_math.h"

namespace voussoir {
namespace {

static_assert(kScatterFactors.size() == kLanes, "one lane for each");

constexpr std::size_t kTogether = 4;  // columns whose sums are in registers at a time

struct Factorisation {
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
VOUSSOIR_INLINE void four_columns(const Factorisation& f, std::size_t i, std::size_t j) {
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
VOUSSOIR_INLINE DoubleLanes factorise_row(const Factorisation& f, std::size_t i) {
  DoubleLanes* const to = f.row(i);
  std::size_t j = 0;
  for (; j + kTogether <= i; j += kTogether) four_columns(f, i, j);
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
VOUSSOIR_FOR_EVERY_PROCESSOR
void factorise(const Factorisation& f, double* squares) {
  for (std::size_t i = 0; i < f.n; ++i) {
    const DoubleLanes pivot = f.entry(i, i) - factorise_row(f, i);
    store_some(pivot, kLanes, f.pivots + kLanes * i);
    f.inverse[i] = 1.0 / square_root(pivot);
    f.row(i)[i] = pivot * f.inverse[i];
  }
  store_some(factorise_row(f, f.n), kLanes, squares);
}

/// The lower triangle of A B^T.
VOUSSOIR_FOR_EVERY_PROCESSOR
void add_lower(const double* a, const double* b, std::size_t rows, std::size_t width, double* sum) {
  for (std::size_t i = 0; i < rows; ++i) {
    const double* const own = a + i * width;
    double* const to = sum + lower_size(i);
    for (std::size_t j = 0; j <= i; j += kTogether) {
      const std::size_t last = i;  // rows beyond the diagonal are worked out once more and dropped
      DoubleLanes sums[kTogether] = {};
      const double* const others[kTogether] = {b + j * width, b + smaller(j + 1, last) * width,
                                               b + smaller(j + 2, last) * width,
                                               b + smaller(j + 3, last) * width};
      for (std::size_t p = 0; p < width; p += kLanes) {
        const DoubleLanes some = load<DoubleLanes>(own + p);
        for (std::size_t k = 0; k < kTogether; ++k) sums[k] += some * load<DoubleLanes>(others[k] + p);
      }
      for (std::size_t k = 0; k < kTogether && j + k <= i; ++k) to[j + k] += sum_of(sums[k]);
    }
  }
}

}  // namespace

void add_outer_product(const std::vector<double>& a, std::size_t rows, LowerTriangle& sum) {
  if (rows > 0) add_lower(a.data(), a.data(), rows, a.size() / rows, sum.data());
}

void add_symmetric_product(const std::vector<double>& a, const std::vector<double>& b, std::size_t rows,
                           LowerTriangle& sum) {
  if (rows == 0) return;
  add_lower(a.data(), b.data(), rows, a.size() / rows, sum.data());
  add_lower(b.data(), a.data(), rows, a.size() / rows, sum.data());
}

ScatterLogs ScatterDensity::operator()(const std::vector<double>& difference, const LowerTriangle& noise,
                                       const LowerTriangle& bridge) {
  const std::size_t n = difference.size();
  factor_.resize(lower_size(n) + n);
  inverse_.resize(n);
  pivots_.resize(n * kLanes);
  std::array<double, kLanes> squares{};
  factorise({n, difference.data(), noise.data(), bridge.data(), load<DoubleLanes>(kScatterFactors.data()),
             registers_of(factor_), registers_of(inverse_), pivots_.data()},
            squares.data());
  make_logarithms(pivots_);
  ScatterLogs logs{};
  for (std::size_t k = 0; k < logs.size(); ++k) {
    double sum = static_cast<double>(n) * std::log(2.0 * std::numbers::pi);
    for (std::size_t i = 0; i < n; ++i) sum += pivots_[i * kLanes + k];
    logs[k] = -0.5 * (sum + squares[k]);
  }
  return logs;
}

double over_scatter(const ScatterLogs& logs) {
  const double largest = *std::max_element(logs.begin(), logs.end());
  if (!std::isfinite(largest)) return largest;  // impossible under all
  double sum = 0.0;
  for (std::size_t k = 0; k < logs.size(); ++k) sum += kScatterPrior[k] * std::exp(logs[k] - largest);
  return largest + std::log(sum);
}

}  // namespace voussoir
