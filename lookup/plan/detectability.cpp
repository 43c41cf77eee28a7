#include "lookup/plan/detectability.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/random.h"
#include "core/threads.h"
#include "lookup/evidence/scene_evidence.h"
#include "lookup/plan/loss_gaussian.h"

namespace voussoir {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kChunk = 256;  // draws that a thread looks at in turn

/// Readings drawn of the losses that leave the same sensors, and what explains them.
struct DrawnReadings {
  std::vector<Index> rows;
  std::vector<BlockId> blocks;
  MatrixXd readings;                     // rows x draws, those of a block side by side
  ArrayXd log_all, log_own, log_intact;  // of each draw: density times prior
  std::vector<double> log_other;         // of each block, the largest mean of another loss's density
  std::vector<std::optional<BlockId>> other;
};

using AllDrawn = std::map<std::vector<Index>, DrawnReadings>;

/// Blocks by the sensors that their losses leave, with room for the draws.
AllDrawn blocks_by_rows(const UnknownBridge& bridge, int draws) {
  AllDrawn all;
  for (const BlockId block : blocks_with_sensitivities(bridge)) {
    const VectorXd& signal = bridge.loss_of(block).signal;
    all[rows_with_reading(signal)].blocks.push_back(block);
  }
  for (auto& [rows, drawn] : all) {
    const auto blocks = static_cast<Index>(drawn.blocks.size());
    drawn.rows = rows;
    drawn.readings.resize(static_cast<Index>(rows.size()), blocks * draws);
    drawn.log_all = drawn.log_own = drawn.log_intact = ArrayXd::Constant(blocks * draws, kImpossible);
    drawn.log_other.assign(drawn.blocks.size(), kImpossible);
    drawn.other.resize(drawn.blocks.size());
  }
  return all;
}

/// The Gaussian is made here and once more to explain the draws: those of all blocks at once would take
/// gigabytes of a long bridge.
void draw(const UnknownBridge& bridge, const CaseNoise& noise, BlockId block, int draws, Random& random,
          AllDrawn& all) {
  const LossGaussian loss = loss_gaussian(bridge, noise, block);
  const std::vector<Index> rows = rows_with_reading(loss.signal);
  if (rows.empty()) return;  // the block takes all sensors with it
  DrawnReadings& drawn = all.at(rows);
  const auto place = static_cast<Index>(std::ranges::find(drawn.blocks, block) - drawn.blocks.begin());
  const auto n = static_cast<Index>(rows.size());
  const MatrixXd standard = MatrixXd::NullaryExpr(n, draws, [&] { return random.gaussian(); });
  const Eigen::LLT<MatrixXd> factor(MatrixXd(loss.covariance(rows, rows)));
  drawn.readings.middleCols(place * draws, draws) =
      (factor.matrixL() * standard).colwise() + loss.signal(rows);
}

AllDrawn drawn_readings(const UnknownBridge& bridge, const CaseNoise& noise, const SightSettings& settings) {
  Random random(settings.seed);
  AllDrawn all = blocks_by_rows(bridge, settings.draws);
  for (const BlockId block : blocks_with_sensitivities(bridge))
    draw(bridge, noise, block, settings.draws, random, all);
  return all;
}

/// Of each draw, but for a constant, and of the sensors that are silent in it. Nothing if the loss would take
/// another sensor with it.
std::optional<ArrayXd> log_densities(const DrawnReadings& drawn, const LossGaussian& loss,
                                     double log_silence) {
  const VectorXd mean = loss.signal(drawn.rows);
  if (mean.hasNaN()) return std::nullopt;
  const double silent =
      static_cast<double>(rows_with_reading(loss.signal).size() - drawn.rows.size()) * log_silence;
  ArrayXd logs = ArrayXd::Constant(drawn.readings.cols(), silent);
  if (drawn.rows.empty()) return logs;
  const Eigen::LLT<MatrixXd> factor(MatrixXd(loss.covariance(drawn.rows, drawn.rows)));
  const double log_root = MatrixXd(factor.matrixLLT()).diagonal().array().log().sum();
  const auto chunks = static_cast<std::size_t>((logs.size() + kChunk - 1) / kChunk);
  for_each_index_on_threads(chunks, hardware_threads(), [&](std::size_t chunk) {
    const Index first = static_cast<Index>(chunk) * kChunk, count = std::min(kChunk, logs.size() - first);
    MatrixXd white = drawn.readings.middleCols(first, count).colwise() - mean;
    factor.matrixL().solveInPlace(white);
    logs.segment(first, count) -= log_root + 0.5 * white.colwise().squaredNorm().transpose().array();
  });
  return logs;
}

/// Adds what one loss, or none, says of all draws.
void explain(std::optional<BlockId> lost, const LossGaussian& loss, double log_prior,
             const SightSettings& settings, DrawnReadings& drawn) {
  const std::optional<ArrayXd> densities = log_densities(drawn, loss, settings.log_silence);
  if (!densities) return;
  const ArrayXd logs = *densities + log_prior;
  for (Index i = 0; i < logs.size(); ++i) drawn.log_all[i] = log_sum(drawn.log_all[i], logs[i]);
  if (!lost) drawn.log_intact = logs;
  for (std::size_t b = 0; lost && b < drawn.blocks.size(); ++b) {
    const Index first = static_cast<Index>(b) * settings.draws;
    const double mean = logs.segment(first, settings.draws).mean();
    if (drawn.blocks[b] == *lost) {
      drawn.log_own.segment(first, settings.draws) = logs.segment(first, settings.draws);
    } else if (mean > drawn.log_other[b]) {
      drawn.log_other[b] = mean;
      drawn.other[b] = lost;
    }
  }
}

Sight sight_of(const UnknownBridge& bridge, const DrawnReadings& drawn, std::size_t place,
               const SightSettings& settings) {
  Sight sight{.block = drawn.blocks[place], .alike = drawn.other[place]};
  const VectorXd& signal = bridge.loss_of(sight.block).signal;
  sight.silent = static_cast<std::size_t>(signal.size()) - drawn.rows.size();
  for (const Index row : drawn.rows)
    if (std::abs(signal[row]) > std::abs(sight.largest)) {
      sight.largest = signal[row];
      sight.largest_at = row;
    }
  const auto share = [&](const ArrayXd& logs) {
    const Index first = static_cast<Index>(place) * settings.draws;
    return (logs - drawn.log_all).segment(first, settings.draws).exp().eval();
  };
  sight.seen = (share(drawn.log_intact) <= 1.0 - settings.certain).cast<double>().mean();
  sight.named = (share(drawn.log_own) >= settings.certain).cast<double>().mean();
  return sight;
}

}  // namespace

std::vector<Sight> sights_of(const UnknownBridge& bridge, const CaseNoise& noise,
                             const SightSettings& settings) {
  AllDrawn all = drawn_readings(bridge, noise, settings);
  std::vector<std::optional<BlockId>> losses = {std::nullopt};
  for (const BlockId block : blocks_with_sensitivities(bridge)) losses.emplace_back(block);
  for (const std::optional<BlockId> lost : losses) {
    const LossGaussian loss = loss_gaussian(bridge, noise, lost);
    const double log_prior =
        lost ? settings.log_prior_loss + bridge.loss_of(*lost).log_weight : settings.log_prior_intact;
    for (auto& [rows, drawn] : all) explain(lost, loss, log_prior, settings, drawn);
  }
  std::vector<Sight> sights;
  for (const auto& [rows, drawn] : all)
    for (std::size_t b = 0; b < drawn.blocks.size(); ++b)
      sights.push_back(sight_of(bridge, drawn, b, settings));
  std::ranges::sort(sights, {}, &Sight::block);
  return sights;
}

}  // namespace voussoir
