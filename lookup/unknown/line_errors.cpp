#include "lookup/unknown/line_errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <tuple>

namespace voussoir {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// [m] Standard deviations of a line's shift, and of what its tilt makes of one end.
constexpr std::array kSizes = {0.3e-3, 3e-3};
constexpr std::size_t kFewest = 3;     // points of a line
constexpr double kLineChance = 1e-3;   // beforehand that a line is off as a whole, by one of the sizes
constexpr double kSetupChance = 1e-4;  // and from one of its points on

using Channels = std::vector<std::size_t>;

struct Line {
  Channels channels;
  bool shifts = true, tilts = true;  // as a whole, in ways that nothing states
  auto operator<=>(const Line&) const = default;
};

/// What a point's name begins with: T of T12, of T12 under a load, too.
std::string letters_of(const Comparison& comparison, std::size_t channel) {
  const std::string name = name_without_load(comparison, channel);
  return name.substr(0, name.find_last_not_of("0123456789") + 1);
}

/// All levelled at once, and all whose names begin alike, of one levelling and, unless the datum of each is
/// stated, of all. Not all readings under one load: what moves the bridge's supports moves these, too.
std::set<Line> lines_of(const UnknownBridge& bridge, const Observation& observation,
                        const Comparison& comparison) {
  constexpr int kAny = kNoLevelling;
  std::map<std::string, Channels> of_load;
  std::map<int, Channels> levelled;
  std::map<std::tuple<std::string, int, std::string>, Channels> alike;  // by load and levelling
  for (const auto& [channel, before, after] : bridge.rows) {
    const int levelling = comparison.levelling.empty() ? 0 : comparison.levelling[channel];
    if (levelling == kNoLevelling || after == 0.0) continue;
    const std::string load = load_of(comparison, channel), letters = letters_of(comparison, channel);
    of_load[load].push_back(channel);
    levelled[levelling].push_back(channel);
    alike[{load, levelling, letters}].push_back(channel);
    if (!observation.datum_stated) alike[{load, kAny, letters}].push_back(channel);
  }
  std::map<Channels, Line> lines;
  for (const auto& [key, channels] : alike) lines[channels] = {channels};
  for (const auto& [key, channels] : levelled)
    lines[channels] = {channels, !observation.datum_stated, !observation.tilt_stated};
  for (const auto& [key, channels] : of_load) lines.erase(channels);
  std::set<Line> result;
  for (const auto& [channels, line] : lines)
    if (channels.size() >= kFewest) result.insert(line);
  return result;
}

/// Channels that may be off alike: a shift of them all, and of a line's a tilt about its middle.
struct OffAlike {
  Channels channels;
  std::size_t line = 0;
  bool is_whole = false;
  MatrixXd columns;

  double chance() const { return is_whole ? kLineChance : kSetupChance; }
};

OffAlike whole(const Line& line, std::size_t number, const Comparison& comparison) {
  const auto x = [&](std::size_t channel) { return comparison.library.points[channel].position.x(); };
  const auto [least, most] = std::ranges::minmax(line.channels, {}, x);
  const double middle = 0.5 * (x(least) + x(most)), half = x(most) - middle;
  MatrixXd columns =
      MatrixXd::Zero(static_cast<Index>(comparison.library.points.size()), line.shifts + line.tilts);
  for (const std::size_t channel : line.channels) {
    auto row = columns.row(static_cast<Index>(channel));
    if (line.shifts) row[0] = 1.0;
    if (line.tilts && half > 0.0) row[line.shifts ? 1 : 0] = (x(channel) - middle) / half;
  }
  return {line.channels, number, true, columns};
}

OffAlike part(Channels channels, std::size_t number, const Comparison& comparison) {
  std::ranges::sort(channels);
  MatrixXd column = MatrixXd::Zero(static_cast<Index>(comparison.library.points.size()), 1);
  for (const std::size_t channel : channels) column(static_cast<Index>(channel), 0) = 1.0;
  return {std::move(channels), number, false, column};
}

/// All lines, and what stands before and behind each of their points.
std::vector<OffAlike> all_off_alike(const std::set<Line>& lines, const Comparison& comparison) {
  std::vector<OffAlike> all;
  std::size_t number = 0;
  for (const Line& line : lines) {
    if (line.shifts || line.tilts) all.push_back(whole(line, number, comparison));
    Channels order = line.channels;
    std::ranges::stable_sort(
        order, {}, [&](std::size_t channel) { return comparison.library.points[channel].position.x(); });
    for (std::size_t first = kFewest; first + kFewest <= order.size(); ++first) {
      const auto middle = order.begin() + static_cast<std::ptrdiff_t>(first);
      all.push_back(part(Channels(order.begin(), middle), number, comparison));
      all.push_back(part(Channels(middle, order.end()), number, comparison));
    }
    ++number;
  }
  return all;
}

/// A cause for each size of each.
PossibleCauses causes_of(const std::vector<OffAlike>& all, const Comparison& comparison) {
  PossibleCauses possible;
  Index columns = 0;
  for (const OffAlike& one : all) {
    for (const double size : kSizes) possible.causes.push_back({columns, one.columns.cols(), size});
    columns += one.columns.cols();
  }
  possible.columns.resize(static_cast<Index>(comparison.library.points.size()), columns);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const CauseColumns& to = possible.causes[i * kSizes.size()];
    possible.columns.middleCols(to.first, to.count) = all[i].columns;
  }
  return possible;
}

}  // namespace

std::vector<LineError> line_errors(const UnknownBridge& bridge, const Observation& observation,
                                   const Comparison& comparison, std::span<const IntactGaussian> gaussians,
                                   std::size_t count) {
  const std::vector<OffAlike> all = all_off_alike(lines_of(bridge, observation, comparison), comparison);
  const PossibleCauses possible = causes_of(all, comparison);
  const auto off_alike = [&](const CauseFit& fit) -> const OffAlike& {
    return all[fit.cause / kSizes.size()];
  };
  std::vector<CauseFit> fits = cause_fits(bridge, gaussians, possible);
  std::ranges::stable_sort(fits, std::ranges::greater{},
                           [&](const CauseFit& fit) { return fit.log + std::log(off_alike(fit).chance()); });
  std::vector<LineError> best;
  std::set<std::tuple<std::size_t, bool, bool>> seen;  // of each line the likeliest whole and part
  for (const CauseFit& fit : fits) {
    const OffAlike& one = off_alike(fit);
    if (best.size() == count || !seen.insert({one.line, one.is_whole, fit.first_epoch}).second) continue;
    const VectorXd added = channel_columns(possible, fit.cause) * fit.amounts;
    const double size = std::sqrt(added.squaredNorm() / static_cast<double>(one.channels.size()));
    best.push_back(
        {one.channels, fit.first_epoch, one.chance(), size, unstated_cause(bridge, possible, fit)});
  }
  return best;
}

}  // namespace voussoir
