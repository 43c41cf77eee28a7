#include "lookup/evidence/scatter_density.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/simd/lane_math.h"
#include "lookup/evidence/scatter_factorisation.h"

namespace voussoir {
namespace {

constexpr std::size_t kTogether = 4;  // columns whose sums are in registers at a time

/// The sum of squares of L^-1 times the difference.
VOUSSOIR_FOR_EVERY_PROCESSOR
void factorise(const ScatterFactorisation& f, double* squares) {
  store_some(factorise_inline(f), kLanes, squares);
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

LowerTriangle lower_of(const Eigen::MatrixXd& matrix) {
  LowerTriangle lower;
  lower.reserve(lower_size(static_cast<std::size_t>(matrix.rows())));
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    for (Eigen::Index j = 0; j <= i; ++j) lower.push_back(matrix(i, j));
  return lower;
}

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
