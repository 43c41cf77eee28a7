#include "lookup/unknown/unstated_loads.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <functional>

#include "lookup/unknown/intact_gaussian.h"

namespace voussoir {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::array kLengths = {5.0, 10.0};  // [m] of stretches: a lorry, or a long one
constexpr double kRounding = 1e-6;            // [m] of places
// What the first order and the joints' scatter leave of what a load adds, as a share of it at each point and
// of its root mean square: of lorries on sampled bridges 2 to 7 % (docs/uncertainty.md).
constexpr double kOwnShare = 0.08;
constexpr double kCommonShare = 0.03;

/// Neighbouring places.
struct Stretch {
  Index first = 0, count = 0;
};

/// From each place on, as long as they fit: shorter ones at the ends would be as blocks that are lost there.
std::vector<Stretch> stretches_of(const std::vector<double>& places) {
  std::vector<Stretch> stretches;
  const auto count = static_cast<Index>(places.size());
  for (const double length : kLengths) {
    const double fits = std::min(length, places.back() - places.front()) - kRounding;
    for (Index first = 0; first < count; ++first) {
      const auto end = std::ranges::lower_bound(places, places[static_cast<std::size_t>(first)] + fits);
      if (end != places.end()) stretches.push_back({first, end + 1 - places.begin() - first});
    }
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

/// In rows of y, what a standard deviation at each place adds: at the second levelling, or at the only one;
/// and at the first, where that counts by itself.
std::vector<MatrixXd> columns_of(const UnknownBridge& bridge) {
  const MatrixXd& influence = bridge.factors->sensitivities->load.readings;
  MatrixXd of_channels(static_cast<Index>(bridge.factors->channels.size()), influence.cols());
  for (Index k = 0; k < of_channels.rows(); ++k)
    of_channels.row(k) =
        kUnstatedForce *
        influence.row(static_cast<Index>(bridge.factors->channels[static_cast<std::size_t>(k)].point));
  const MatrixXd none = MatrixXd::Zero(of_channels.rows(), of_channels.cols());
  std::vector<MatrixXd> columns = {in_rows(bridge.rows, none, of_channels)};
  if (bridge.has_first_epoch()) columns.push_back(in_rows(bridge.rows, of_channels, none));
  return columns;
}

UnstatedLoad load_of(const std::vector<double>& places, const Stretch& stretch, const MatrixXd& columns,
                     const StretchFit& fit) {
  const MatrixXd own = columns.middleCols(stretch.first, stretch.count);
  UnstatedLoad load;
  load.from = places[static_cast<std::size_t>(stretch.first)];
  load.to = places[static_cast<std::size_t>(stretch.first + stretch.count - 1)];
  load.force = kUnstatedForce * fit.forces.sum();
  load.expected = own * fit.forces;
  load.covariance = own * own.transpose();
  const double mean_square = load.expected.squaredNorm() / static_cast<double>(load.expected.size());
  load.covariance.diagonal() += kOwnShare * kOwnShare * load.expected.cwiseAbs2();
  load.covariance.diagonal().array() += kCommonShare * kCommonShare * mean_square;
  load.best = fit.best;
  load.log = fit.log;
  return load;
}

/// Of a square as large as that of the readings, or larger.
double chance_of(const VectorXd& reading, const MatrixXd& covariance) {
  return boost::math::gamma_q(0.5 * static_cast<double>(reading.size()),
                              0.5 * reading.dot(covariance.llt().solve(reading)));
}

/// All that scatters as the bridge file states.
void add_chances(UnknownBridge& bridge, const Observation& observation, UnstatedLoad& load) {
  set_case(observation, load.best, bridge);
  const MatrixXd covariance = intact_covariance(bridge);
  load.without = chance_of(bridge.reading, covariance);
  load.chance = chance_of(bridge.reading, covariance + load.covariance);
}

}  // namespace

std::vector<UnstatedLoad> unstated_loads(UnknownBridge& bridge, const Observation& observation,
                                         std::span<const UnknownCase> cases, std::size_t count) {
  const std::vector<double>& places = bridge.factors->sensitivities->load.places;
  if (places.empty()) return {};
  const std::vector<Stretch> stretches = stretches_of(places);
  std::vector<UnstatedLoad> loads;
  for (const MatrixXd& columns : columns_of(bridge)) {
    std::vector<StretchFit> best(stretches.size());
    for (const UnknownCase& one : cases) {
      set_case(observation, one, bridge);
      const IntactGaussian intact = intact_gaussian(bridge);
      const SeenLoads seen{columns.transpose() * intact.precision * columns,
                           columns.transpose() * intact.pulled, intact.log};
      for (std::size_t i = 0; i < stretches.size(); ++i)
        if (StretchFit fit = fit_of(seen, stretches[i], one); fit.log > best[i].log) best[i] = std::move(fit);
    }
    for (std::size_t i = 0; i < stretches.size(); ++i)
      loads.push_back(load_of(places, stretches[i], columns, best[i]));
  }
  std::ranges::stable_sort(loads, std::ranges::greater{}, &UnstatedLoad::log);
  loads.resize(std::min(loads.size(), count));
  for (UnstatedLoad& load : loads) add_chances(bridge, observation, load);
  return loads;
}

}  // namespace voussoir
