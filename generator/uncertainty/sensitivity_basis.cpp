#include "generator/uncertainty/sensitivity_basis.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>

#include "core/simd/column_products.h"
#include "generator/running/parallel.h"

namespace voussoir {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr std::size_t kSignalsAtOnce = 32;  // whose copies are in memory
constexpr std::size_t kRowsAtOnce = 32;     // of their sum, by one thread

/// Derivatives by the independent parameters.
MatrixXd by_independent(const MatrixXd& derivatives, const MatrixXd& factor) {
  return derivatives.leftCols(factor.rows()) * factor.triangularView<Eigen::Lower>();
}

/// What the intact bridge's displacements depend on; none where they are not known.
MatrixXd directions_of_intact(const Derivatives& derivatives, const MatrixXd& factor) {
  const Index of_bridge = factor.rows();
  MatrixXd all(0, of_bridge);
  for (const auto& state : derivatives) {
    if (state.front().size() == 0) continue;
    all.conservativeResize(all.rows() + state.front().rows(), Eigen::NoChange);
    all.bottomRows(state.front().rows()) = by_independent(state.front(), factor);
  }
  if (all.size() == 0) return MatrixXd(of_bridge, 0);
  const Eigen::BDCSVD<MatrixXd> svd(all, Eigen::ComputeThinV);
  return svd.matrixV().leftCols((svd.singularValues().array() >= kLeastDeviation).count());
}

/// Orthonormal directions at right angles to these.
MatrixXd complement(const MatrixXd& directions) {
  if (directions.cols() == 0) return MatrixXd::Identity(directions.rows(), directions.rows());
  const MatrixXd all = Eigen::HouseholderQR<MatrixXd>(directions).householderQ();
  return all.rightCols(directions.rows() - directions.cols());
}

/// Signals' derivatives, each of norm 1: parameters x points.
std::vector<MatrixXd> signals_of(const Derivatives& derivatives, const MatrixXd& factor, Crew& crew,
                                 std::size_t first) {
  const std::size_t scenes = derivatives.front().size();
  const std::size_t end = std::min(first + kSignalsAtOnce, derivatives.size() * scenes);
  std::vector<MatrixXd> signals(end - first);
  crew.for_each_index(signals.size(), [&](std::size_t i) {
    const auto& state = derivatives[(first + i) / scenes];
    const MatrixXd& scene = state[(first + i) % scenes];
    if (scene.size() == 0 || state.front().size() == 0) return;
    const MatrixXd signal = by_independent(scene - state.front(), factor).transpose();
    if (signal.squaredNorm() > 0.0) signals[i] = filled_up(signal / signal.norm());
  });
  return signals;
}

/// Of the sum over all signals of S^T S, each of norm 1; and how many they are.
struct Gram {
  LowerTriangle lower;
  double signals = 0.0;
};

Gram gram_of_signals(const Derivatives& derivatives, const MatrixXd& factor, int threads) {
  const auto size = static_cast<std::size_t>(factor.rows());
  Crew crew(threads);
  Gram gram{LowerTriangle(lower_size(size), 0.0)};
  for (std::size_t first = 0; first < derivatives.size() * derivatives.front().size();
       first += kSignalsAtOnce) {
    const std::vector<MatrixXd> signals = signals_of(derivatives, factor, crew, first);
    crew.for_each_index((size + kRowsAtOnce - 1) / kRowsAtOnce, [&](std::size_t part) {
      const LowerRows rows{part * kRowsAtOnce, std::min(size, (part + 1) * kRowsAtOnce)};
      for (const MatrixXd& signal : signals)
        if (signal.size() > 0)
          add_lower_product(signal.data(), signal.data(), static_cast<std::size_t>(signal.rows()),
                            static_cast<std::size_t>(signal.cols()), rows, 1.0, gram.lower.data());
    });
    gram.signals += static_cast<double>(
        std::ranges::count_if(signals, [](const MatrixXd& signal) { return signal.size() > 0; }));
  }
  return gram;
}

/// The directions of largest eigenvalues, largest first, until no more than this is left in the sum of the
/// others.
MatrixXd leading_directions(const MatrixXd& gram, double allowed) {
  if (gram.size() == 0) return gram;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> directions(gram);
  const Index size = gram.rows();
  double left = directions.eigenvalues().cwiseMax(0.0).sum();
  Index count = 0;
  for (; count < size && left > allowed; ++count)
    left -= std::max(0.0, directions.eigenvalues()[size - 1 - count]);
  return directions.eigenvectors().rightCols(count).rowwise().reverse();
}

}  // namespace

MatrixXd sensitivity_basis(const Derivatives& derivatives, const MatrixXd& correlation_factor, int threads) {
  const MatrixXd of_intact = directions_of_intact(derivatives, correlation_factor);
  const Gram gram = gram_of_signals(derivatives, correlation_factor, threads);
  const MatrixXd others = complement(of_intact);
  const MatrixXd of_others =
      others.transpose() *
      (matrix_of(gram.lower, correlation_factor.rows()).selfadjointView<Eigen::Lower>() * others);
  const MatrixXd of_signals = others * leading_directions(of_others, kLeftOfSignals * gram.signals);
  MatrixXd directions(correlation_factor.rows(), of_intact.cols() + of_signals.cols());
  directions << of_intact, of_signals;
  return correlation_factor.triangularView<Eigen::Lower>() * directions;
}

}  // namespace voussoir
