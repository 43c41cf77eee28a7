#include "lookup/unknown/unstated_cause.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>
#include <utility>

#include "lookup/evidence/chi_square.h"

namespace voussoir {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// All causes at one time, seen by the intact bridge in one case.
struct SeenCauses {
  MatrixXd own;        // L, in rows of y
  MatrixXd precision;  // C^-1 L
  VectorXd pulled;     // L^T C^-1 y
  double log = 0.0;
};

/// The density of readings beside which one cause acts, and its most likely amounts.
std::pair<double, VectorXd> log_and_amounts(const SeenCauses& all, const CauseColumns& columns) {
  const auto& [first, count, size] = columns;
  const VectorXd pulled = size * all.pulled.segment(first, count);
  MatrixXd precision =
      size * size * all.own.middleCols(first, count).transpose() * all.precision.middleCols(first, count);
  precision.diagonal().array() += 1.0;
  const Eigen::LLT<MatrixXd> root(precision);
  VectorXd amounts = root.solve(pulled);
  const double log = all.log + 0.5 * pulled.dot(amounts) - root.matrixLLT().diagonal().array().log().sum();
  return {log, std::move(amounts)};
}

/// At the second time, or the only one, and at the first, where that counts by itself.
std::vector<bool> epochs_of(const UnknownBridge& bridge) {
  return bridge.has_first_epoch() ? std::vector{false, true} : std::vector{false};
}

}  // namespace

MatrixXd at_epoch(const UnknownBridge& bridge, const MatrixXd& channels, bool first_epoch) {
  const MatrixXd none = MatrixXd::Zero(channels.rows(), channels.cols());
  return first_epoch ? in_rows(bridge.rows, channels, none) : in_rows(bridge.rows, none, channels);
}

std::vector<CauseFit> cause_fits(const UnknownBridge& bridge, std::span<const IntactGaussian> gaussians,
                                 const PossibleCauses& possible) {
  std::vector<CauseFit> fits;
  std::vector<MatrixXd> columns;  // at each time
  for (const bool first_epoch : epochs_of(bridge)) {
    columns.push_back(at_epoch(bridge, possible.columns, first_epoch));
    for (std::size_t i = 0; i < possible.causes.size(); ++i)
      fits.push_back({i, first_epoch, {}, {}, -std::numeric_limits<double>::infinity()});
  }
  for (const IntactGaussian& intact : gaussians) {
    auto fit = fits.begin();
    for (const MatrixXd& own : columns) {
      const SeenCauses all{own, intact.precision * own, own.transpose() * intact.pulled, intact.log};
      for (const CauseColumns& cause : possible.causes) {
        auto [log, amounts] = log_and_amounts(all, cause);
        if (log > fit->log) fit->amounts = std::move(amounts), fit->best = intact.in_case, fit->log = log;
        ++fit;
      }
    }
  }
  std::erase_if(fits, [](const CauseFit& fit) { return !std::isfinite(fit.log); });
  return fits;
}

MatrixXd channel_columns(const PossibleCauses& possible, std::size_t cause) {
  const auto& [first, count, size] = possible.causes[cause];
  return size * possible.columns.middleCols(first, count);
}

UnstatedCause unstated_cause(const UnknownBridge& bridge, const PossibleCauses& possible,
                             const CauseFit& fit) {
  const MatrixXd own = at_epoch(bridge, channel_columns(possible, fit.cause), fit.first_epoch);
  return {own * fit.amounts, own * own.transpose(), fit.best, fit.log};
}

CauseChances cause_chances(const UnknownBridge& bridge, const Observation& observation,
                           const UnstatedCause& cause) {
  const MatrixXd without = intact_covariance(bridge, case_noise(bridge, observation, cause.best));
  const auto chance = [&](const MatrixXd& covariance) {
    return chi_square_chance(bridge.reading.dot(covariance.llt().solve(bridge.reading)),
                             static_cast<double>(bridge.reading.size()));
  };
  return {chance(without + cause.covariance), chance(without)};
}

}  // namespace voussoir
