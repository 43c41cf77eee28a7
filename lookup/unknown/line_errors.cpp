#include "lookup/unknown/line_errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <set>

namespace voussoir {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// [m] Standard deviations of a line's shift, and of what its tilt makes of one end.
constexpr std::array kSizes = {0.3e-3, 3e-3};
constexpr std::size_t kFewest = 3;     // points of a line
constexpr double kLineChance = 1e-3;   // beforehand that a line is off as a whole
constexpr double kSetupChance = 1e-4;  // and from one of its points on

using Line = std::vector<std::size_t>;  // channels

/// What a point's name begins with: T of T12.
std::string letters_of(const std::string& name) {
  return name.substr(0, name.find_last_not_of("0123456789") + 1);
}

/// All levelled at once, and of these all whose names begin alike; but neither all readings, which what moves
/// the bridge's supports moves, too, nor levellings whose datum and tilt are stated.
std::set<Line> lines_of(const UnknownBridge& bridge, const Observation& observation,
                        const Comparison& comparison) {
  Line all;
  std::map<int, Line> levelled;
  std::map<std::pair<int, std::string>, Line> alike;
  for (const auto& [channel, before, after] : bridge.rows) {
    const int levelling = comparison.levelling.empty() ? 0 : comparison.levelling[channel];
    if (levelling == kNoLevelling || after == 0.0) continue;
    all.push_back(channel);
    levelled[levelling].push_back(channel);
    alike[{levelling, letters_of(comparison.library.points[channel].name)}].push_back(channel);
  }
  std::set<Line> lines;
  for (const auto& [key, line] : alike) lines.insert(line);
  for (const auto& [key, line] : levelled) {
    if (observation.has_levelling())
      lines.erase(line);
    else
      lines.insert(line);
  }
  lines.erase(all);
  std::erase_if(lines, [](const Line& line) { return line.size() < kFewest; });
  return lines;
}

/// Channels that may be off alike.
struct OffAlike {
  Line channels;
  double chance;
  MatrixXd columns;  // of channels: a shift, and of a whole line a tilt about its middle
};

OffAlike whole(const Line& line, const Comparison& comparison) {
  const auto x = [&](std::size_t channel) { return comparison.library.points[channel].position.x(); };
  const auto [least, most] = std::ranges::minmax(line, {}, x);
  const double middle = 0.5 * (x(least) + x(most)), half = x(most) - middle;
  MatrixXd columns = MatrixXd::Zero(static_cast<Index>(comparison.library.points.size()), 2);
  for (const std::size_t channel : line)
    columns.row(static_cast<Index>(channel)) << 1.0, half > 0.0 ? (x(channel) - middle) / half : 0.0;
  return {line, kLineChance, columns};
}

OffAlike part(const Line& line, const Comparison& comparison) {
  MatrixXd column = MatrixXd::Zero(static_cast<Index>(comparison.library.points.size()), 1);
  for (const std::size_t channel : line) column(static_cast<Index>(channel), 0) = 1.0;
  return {line, kSetupChance, column};
}

/// All lines, and what stands before and behind each of their points.
std::vector<OffAlike> all_off_alike(const std::set<Line>& lines, const Comparison& comparison) {
  std::vector<OffAlike> all;
  for (const Line& line : lines) {
    all.push_back(whole(line, comparison));
    Line order = line;
    std::ranges::stable_sort(
        order, {}, [&](std::size_t channel) { return comparison.library.points[channel].position.x(); });
    for (std::size_t first = kFewest; first + kFewest <= order.size(); ++first) {
      const auto middle = order.begin() + static_cast<std::ptrdiff_t>(first);
      all.push_back(part(Line(order.begin(), middle), comparison));
      all.push_back(part(Line(middle, order.end()), comparison));
    }
  }
  return all;
}

/// A cause for each size of each.
PossibleCauses causes_of(const std::vector<OffAlike>& all, const Comparison& comparison) {
  PossibleCauses possible;
  Index columns = 0;
  for (const OffAlike& one : all)
    for (std::size_t i = 0; i < kSizes.size(); ++i) {
      possible.causes.push_back({columns, one.columns.cols()});
      columns += one.columns.cols();
    }
  possible.columns.resize(static_cast<Index>(comparison.library.points.size()), columns);
  auto to = possible.causes.begin();
  for (const OffAlike& one : all)
    for (const double size : kSizes) {
      possible.columns.middleCols(to->first, to->count) = size * one.columns;
      ++to;
    }
  return possible;
}

}  // namespace

std::vector<LineError> line_errors(UnknownBridge& bridge, const Observation& observation,
                                   const Comparison& comparison, std::span<const UnknownCase> cases,
                                   std::size_t count) {
  const std::vector<OffAlike> all = all_off_alike(lines_of(bridge, observation, comparison), comparison);
  const PossibleCauses possible = causes_of(all, comparison);
  const auto off_alike = [&](const CauseFit& fit) -> const OffAlike& {
    return all[fit.cause / kSizes.size()];
  };
  std::vector<CauseFit> fits = cause_fits(bridge, observation, cases, possible);
  std::ranges::stable_sort(fits, std::ranges::greater{},
                           [&](const CauseFit& fit) { return fit.log + std::log(off_alike(fit).chance); });
  fits.resize(std::min(fits.size(), count));
  std::vector<LineError> best;
  for (const CauseFit& fit : fits) {
    LineError error{off_alike(fit).channels, off_alike(fit).chance, 0.0,
                    unstated_cause(bridge, possible, fit)};
    error.size = std::sqrt(error.cause.expected.squaredNorm() / static_cast<double>(error.channels.size()));
    best.push_back(std::move(error));
  }
  return best;
}

}  // namespace voussoir
