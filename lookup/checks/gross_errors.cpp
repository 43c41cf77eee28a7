#include "lookup/checks/gross_errors.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "lookup/evidence/largest_places.h"
#include "lookup/readings/sensor.h"

namespace voussoir {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Beforehand that a reading is off by a size that is given to a factor of e. One in a thousand grossly wrong,
// by anything from its own error to ten thousand times that, comes to about as much. Chosen, as the two
// below, not tuned; what they find, leave and cost is measured in docs/uncertainty.md ("Readings that cannot
// be").
constexpr double kGrossChance = 2e-4;
constexpr double kOfOneBlock = 0.1;       // share of these that are of all that is read on a block
constexpr std::size_t kMostSuspects = 2;  // readings, of each scene that is looked at for them

std::vector<std::size_t> channels_of(const std::vector<GrossError>& gross) {
  std::vector<std::size_t> channels;
  for (const GrossError& one : gross) channels.push_back(one.channel);
  return channels;
}

/// By how much these readings are off what all others let expect of a scene.
std::vector<GrossError> errors_of(const UnknownBridge& bridge, const BridgePosterior& believed,
                                  const std::vector<std::size_t>& channels) {
  std::vector<Index> rows;
  for (std::size_t k = 0; k < bridge.rows.size(); ++k)
    if (std::ranges::find(channels, bridge.rows[k].channel) != channels.end())
      rows.push_back(static_cast<Index>(k));
  const auto& covariance = believed.parts.front().covariance;
  const MatrixXd identity = MatrixXd::Identity(covariance.rows(), covariance.rows());
  const MatrixXd inverse = covariance.solve(MatrixXd(identity(Eigen::all, rows)));
  const VectorXd pulled = covariance.solve(bridge.reading - believed.signal);
  const VectorXd beside = inverse(rows, Eigen::all).llt().solve(pulled(rows));
  std::vector<GrossError> errors;
  for (const std::size_t channel : channels) errors.push_back({channel, 0.0});
  for (std::size_t i = 0; i < rows.size(); ++i) {  // a channel that counts in two epochs has two rows
    const std::size_t channel = bridge.rows[static_cast<std::size_t>(rows[i])].channel;
    double& size = std::ranges::find(errors, channel, &GrossError::channel)->size;
    size = std::max(size, std::abs(beside[static_cast<Index>(i)]));
  }
  return errors;
}

/// The readings that are farthest from what all others let expect of a scene, in standard deviations: each
/// alone, and with all that is read on the same block.
std::vector<std::vector<GrossError>> suspects_of(const QuestionContext& asked, std::size_t row) {
  const BridgePosterior believed = asked.question.posterior({{row, 1.0}});
  const UnknownBridge& bridge = asked.question.bridge();
  const std::vector<StoredPoint>& points = asked.comparison.library.points;
  const VectorXd sizes = believed.others.cwiseAbs();
  std::vector<std::size_t> channels;  // a channel that counts in two epochs has two rows
  for (const std::size_t k : largest_places({sizes.data(), bridge.rows.size()}, bridge.rows.size()))
    if (std::ranges::find(channels, bridge.rows[k].channel) == channels.end())
      channels.push_back(bridge.rows[k].channel);
  std::vector<std::vector<GrossError>> suspects;
  for (const std::size_t channel : std::span(channels).first(std::min(channels.size(), kMostSuspects))) {
    suspects.push_back(errors_of(bridge, believed, {channel}));
    std::vector<std::size_t> beside;
    std::ranges::copy_if(channels, std::back_inserter(beside),
                         [&](std::size_t other) { return points[other].is_on(points[channel].block); });
    if (beside.size() > 1) suspects.push_back(errors_of(bridge, believed, beside));
  }
  return suspects;
}

/// "only the reading at T2 says that these blocks are missing; it may be wrong by 0.1 mm".
std::string in_words(const std::vector<GrossError>& gross, bool named, const Library& library) {
  const GrossError& largest = *std::ranges::max_element(gross, {}, &GrossError::size);
  const bool alone = gross.size() == 1;
  return fmt::format("only the reading{} at {} say{} that {} missing; {} may be wrong by {:.2g} {}",
                     alone ? "" : "s", places_in_words(library, channels_of(gross)), alone ? "s" : "",
                     named ? "these blocks are" : "blocks are", alone ? "it" : "they",
                     kMillimetres * largest.size, unit_of(library.points[largest.channel].quantity));
}

}  // namespace

std::optional<Fit> check_gross_errors(const QuestionContext& asked, const Alarm& alarm) {
  for (const std::size_t row : rows_otherwise(asked, alarm.rows, alarm.named))
    for (const std::vector<GrossError>& gross : suspects_of(asked, row)) {
      const double chance = gross.size() > 1 ? kOfOneBlock * kGrossChance : kGrossChance;
      if (explained_by(asked, alarm,
                       {{.gross = gross}, chance, without(asked.observation, channels_of(gross))}))
        return Fit{false,
                   asked.believed.chance,
                   in_words(gross, !alarm.named.empty(), asked.comparison.library),
                   {channels_of(gross)}};
    }
  return std::nullopt;
}

}  // namespace voussoir
