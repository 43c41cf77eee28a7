#include "lookup/unknown/unstated_loads.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace voussoir {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::array kLengths = {5.0, 10.0};  // [m] of stretches: a lorry, or a long one
constexpr double kHalfMetre = 0.5;
constexpr double kRounding = 1e-6;  // [m] of places
// What the first order and the joints' scatter leave of what a load adds, as a share of it at each point and
// of its root mean square: of lorries on sampled bridges 2 to 7 % (docs/uncertainty.md).
constexpr double kOwnShare = 0.08;
constexpr double kCommonShare = 0.03;

/// [m] between places, gaps in the top apart.
double spacing_of(const std::vector<double>& places) {
  double least = places.back() - places.front();
  for (std::size_t i = 1; i < places.size(); ++i) least = std::min(least, places[i] - places[i - 1]);
  return least;
}

/// From each place on, as long as they fit: shorter ones at the ends would be as blocks that are lost there.
/// None goes over a gap.
std::vector<CauseColumns> stretches_of(const std::vector<double>& places) {
  const double whole = places.back() - places.front(), spacing = spacing_of(places);
  std::vector<CauseColumns> stretches;
  for (const double length : kLengths) {
    const double fits = std::min(length, whole) - kRounding;
    for (auto first = places.begin(); first != places.end(); ++first) {
      const auto last = std::lower_bound(first, places.end(), *first + fits);
      const bool is_over_gap = last != places.end() && *last - *first > fits + 2.0 * spacing + kRounding;
      if (last == places.end() || is_over_gap) continue;
      stretches.push_back({first - places.begin(), last + 1 - first});
    }
    if (length >= whole) break;
  }
  return stretches;
}

/// [N/m] Standard deviation of the force at each place.
double force_at(const std::vector<double>& places) {
  return kUnstatedForce * std::sqrt(spacing_of(places) / kHalfMetre);
}

/// Of channels: a standard deviation at each place.
MatrixXd columns_of_places(const UnknownBridge& bridge) {
  const auto& [places, influence] = bridge.factors->sensitivities->load;
  const double force = force_at(places);
  MatrixXd columns(static_cast<Index>(bridge.factors->channels.size()), influence.cols());
  for (Index k = 0; k < columns.rows(); ++k)
    columns.row(k) =
        force *
        influence.row(static_cast<Index>(bridge.factors->channels[static_cast<std::size_t>(k)].point));
  return columns;
}

/// Errors of what it adds are those of the channels, the same wherever a channel counts. Of changes alone
/// forces of the first levelling count as negative.
UnstatedLoad unstated_load(const UnknownBridge& bridge, const PossibleCauses& possible, const CauseFit& fit) {
  const std::vector<double>& places = bridge.factors->sensitivities->load.places;
  const auto& [first, count, size] = possible.causes[fit.cause];
  const VectorXd added = channel_columns(possible, fit.cause) * fit.amounts;
  const double common = kCommonShare * std::sqrt(added.squaredNorm() / static_cast<double>(added.size()));
  const VectorXd errors = ((kOwnShare * added).array().square() + common * common).sqrt();
  const MatrixXd off = at_epoch(bridge, errors.asDiagonal(), fit.first_epoch);
  UnstatedLoad load;
  load.from = places[static_cast<std::size_t>(first)];
  load.to = places[static_cast<std::size_t>(first + count - 1)];
  load.first_epoch = fit.first_epoch || fit.amounts.sum() < 0.0;
  load.force = force_at(places) * std::abs(fit.amounts.sum());
  load.cause = unstated_cause(bridge, possible, fit);
  load.cause.covariance += off * off.transpose();
  return load;
}

}  // namespace

std::vector<UnstatedLoad> unstated_loads(const UnknownBridge& bridge,
                                         std::span<const IntactGaussian> gaussians, std::size_t count) {
  const std::vector<double>& places = bridge.factors->sensitivities->load.places;
  const bool is_loaded = std::ranges::any_of(
      bridge.factors->channels, [](const Channel& channel) { return channel.loaded.has_value(); });
  if (places.size() < 2 || is_loaded) return {};
  const PossibleCauses possible{columns_of_places(bridge), stretches_of(places)};
  std::vector<CauseFit> fits = cause_fits(bridge, gaussians, possible);
  // Of changes alone a load at the first levelling is one at the second with the other sign.
  const bool any_sign = !bridge.has_first_epoch() && bridge.rows.front().before != 0.0;
  std::erase_if(fits, [&](const CauseFit& fit) { return !(any_sign || fit.amounts.sum() > 0.0); });
  std::ranges::stable_sort(fits, std::ranges::greater{}, &CauseFit::log);
  fits.resize(std::min(fits.size(), count));
  std::vector<UnstatedLoad> best;
  for (const CauseFit& fit : fits) best.push_back(unstated_load(bridge, possible, fit));
  return best;
}

}  // namespace voussoir
