#include "lookup/unknown/unstated_loads.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "lookup/evidence/chi_square.h"
#include "lookup/unknown/intact_gaussian.h"

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

/// Neighbouring places.
struct Stretch {
  Index first = 0, count = 0;
};

/// [m] between places, gaps in the top apart.
double spacing_of(const std::vector<double>& places) {
  double least = places.back() - places.front();
  for (std::size_t i = 1; i < places.size(); ++i) least = std::min(least, places[i] - places[i - 1]);
  return least;
}

/// From each place on, as long as they fit: shorter ones at the ends would be as blocks that are lost there.
/// None goes over a gap.
std::vector<Stretch> stretches_of(const std::vector<double>& places) {
  const double whole = places.back() - places.front(), spacing = spacing_of(places);
  std::vector<Stretch> stretches;
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

/// Loads at one levelling, seen by the intact bridge in one case.
struct SeenLoads {
  MatrixXd seen;    // L^T C^-1 L of all places
  VectorXd pulled;  // L^T C^-1 y
  double log = 0.0;
};

/// Of a stretch: w ~ N(0, 1) at each of its places.
struct StretchFit {
  VectorXd forces;   // most likely w
  UnknownCase best;  // in which the readings are likeliest
  double log = -std::numeric_limits<double>::infinity();
};

StretchFit fit_of(const SeenLoads& loads, const Stretch& stretch, const UnknownCase& one) {
  const VectorXd pulled = loads.pulled.segment(stretch.first, stretch.count);
  MatrixXd precision = loads.seen.block(stretch.first, stretch.first, stretch.count, stretch.count);
  precision.diagonal().array() += 1.0;
  const Eigen::LLT<MatrixXd> root(precision);
  StretchFit fit{root.solve(pulled), one};
  fit.log = loads.log + 0.5 * pulled.dot(fit.forces) - root.matrixLLT().diagonal().array().log().sum();
  return fit;
}

/// What loads add at one of the levellings.
struct EpochLoads {
  bool first_epoch = false;
  MatrixXd columns;  // in rows of y: a standard deviation at each place
};

/// In rows of y, what is added to channels at one of the levellings.
MatrixXd at_levelling(const UnknownBridge& bridge, const MatrixXd& channels, bool first_epoch) {
  const MatrixXd none = MatrixXd::Zero(channels.rows(), channels.cols());
  return first_epoch ? in_rows(bridge.rows, channels, none) : in_rows(bridge.rows, none, channels);
}

/// [N/m] Standard deviation of the force at each place.
double force_at(const std::vector<double>& places) {
  return kUnstatedForce * std::sqrt(spacing_of(places) / kHalfMetre);
}

/// Of channels: a standard deviation at each place.
MatrixXd channel_columns(const UnknownBridge& bridge) {
  const auto& [places, influence] = bridge.factors->sensitivities->load;
  const double force = force_at(places);
  MatrixXd columns(static_cast<Index>(bridge.factors->channels.size()), influence.cols());
  for (Index k = 0; k < columns.rows(); ++k)
    columns.row(k) =
        force *
        influence.row(static_cast<Index>(bridge.factors->channels[static_cast<std::size_t>(k)].point));
  return columns;
}

/// A fit, of which stretch and at which levelling.
struct Found {
  const EpochLoads* loads;
  Stretch stretch;
  StretchFit fit;

  /// Sum of the forces, downwards: of changes alone those of the first levelling count as negative.
  double force() const { return fit.forces.sum(); }
};

/// Errors of what it adds are those of the channels, the same wherever a channel counts.
UnstatedLoad load_of(const UnknownBridge& bridge, const MatrixXd& channels, const Found& found) {
  const std::vector<double>& places = bridge.factors->sensitivities->load.places;
  const auto& [first, count] = found.stretch;
  const MatrixXd own = found.loads->columns.middleCols(first, count);
  const VectorXd added = channels.middleCols(first, count) * found.fit.forces;
  const double common = kCommonShare * std::sqrt(added.squaredNorm() / static_cast<double>(added.size()));
  const VectorXd errors = ((kOwnShare * added).array().square() + common * common).sqrt();
  const MatrixXd off = at_levelling(bridge, errors.asDiagonal(), found.loads->first_epoch);
  UnstatedLoad load;
  load.from = places[static_cast<std::size_t>(first)];
  load.to = places[static_cast<std::size_t>(first + count - 1)];
  load.first_epoch = found.loads->first_epoch || found.force() < 0.0;
  load.force = force_at(places) * std::abs(found.force());
  load.expected = own * found.fit.forces;
  load.covariance = own * own.transpose() + off * off.transpose();
  load.best = found.fit.best;
  load.log = found.fit.log;
  return load;
}

/// At the second levelling, or the only one; and at the first, where that counts by itself.
std::vector<EpochLoads> loads_of(const UnknownBridge& bridge, const MatrixXd& channels) {
  std::vector<EpochLoads> loads = {{false, at_levelling(bridge, channels, false)}};
  if (bridge.has_first_epoch()) loads.push_back({true, at_levelling(bridge, channels, true)});
  return loads;
}

/// Of all stretches at each levelling in the case in which each is likeliest.
std::vector<Found> fits_of(UnknownBridge& bridge, const Observation& observation,
                           std::span<const UnknownCase> cases, const std::vector<EpochLoads>& loads) {
  std::vector<Found> best;
  for (const EpochLoads& one : loads)
    for (const Stretch& stretch : stretches_of(bridge.factors->sensitivities->load.places))
      best.push_back({&one, stretch, {}});
  for (const UnknownCase& one : cases) {
    set_case(observation, one, bridge);
    const IntactGaussian intact = intact_gaussian(bridge);
    for (const EpochLoads& at : loads) {
      const SeenLoads seen{at.columns.transpose() * intact.precision * at.columns,
                           at.columns.transpose() * intact.pulled, intact.log};
      for (Found& found : best)
        if (found.loads == &at)
          if (StretchFit fit = fit_of(seen, found.stretch, one); fit.log > found.fit.log)
            found.fit = std::move(fit);
    }
  }
  return best;
}

}  // namespace

std::vector<UnstatedLoad> unstated_loads(UnknownBridge& bridge, const Observation& observation,
                                         std::span<const UnknownCase> cases, std::size_t count) {
  const std::vector<double>& places = bridge.factors->sensitivities->load.places;
  const bool is_loaded = std::ranges::any_of(
      bridge.factors->channels, [](const Channel& channel) { return channel.loaded.has_value(); });
  if (places.size() < 2 || is_loaded) return {};
  const MatrixXd channels = channel_columns(bridge);
  const std::vector<EpochLoads> loads = loads_of(bridge, channels);
  // Of changes alone a load at the first levelling is one at the second with the other sign.
  const bool any_sign = !bridge.has_first_epoch() && bridge.rows.front().before != 0.0;
  std::vector<Found> all = fits_of(bridge, observation, cases, loads);
  std::erase_if(all, [&](const Found& found) {
    return !std::isfinite(found.fit.log) || !(any_sign || found.force() > 0.0);
  });
  std::ranges::stable_sort(all, std::ranges::greater{}, [](const Found& found) { return found.fit.log; });
  std::vector<UnstatedLoad> best;
  for (const Found& found : std::span(all).first(std::min(all.size(), count)))
    best.push_back(load_of(bridge, channels, found));
  return best;
}

LoadChances load_chances(UnknownBridge& bridge, const Observation& observation, const UnstatedLoad& load) {
  set_case(observation, load.best, bridge);
  const MatrixXd without = intact_covariance(bridge);
  const auto chance = [&](const MatrixXd& covariance) {
    return chi_square_chance(bridge.reading.dot(covariance.llt().solve(bridge.reading)),
                             static_cast<double>(bridge.reading.size()));
  };
  return {chance(without + load.covariance), chance(without)};
}

}  // namespace voussoir
