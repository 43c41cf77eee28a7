#include "lookup/checks/lines_and_loads.h"

#include <cmath>

#include "core/text.h"
#include "core/units.h"
#include "lookup/unknown/line_errors.h"
#include "lookup/unknown/unstated_loads.h"

namespace voussoir {
namespace {

constexpr std::size_t kMostLines = 4;  // of levelling that may be off alike
constexpr std::size_t kMostLoads = 3;  // stretches of the top that a load may stand on
constexpr double kMostForce = 500e3;   // [N/m] of any load: a crane on two supports, 300 t on six metres
constexpr double kLeastForce = 10e3;   // [N/m] of a load that is spoken of where nothing explains readings
constexpr double kLoadChance = 1e-3;   // beforehand that one stood there and is not stated

std::vector<LineError> lines_of(const QuestionContext& asked) {
  return line_errors(asked.question.bridge(), asked.observation, asked.comparison, asked.gaussians,
                     kMostLines);
}
std::vector<UnstatedLoad> loads_of(const QuestionContext& asked, std::size_t count) {
  std::vector<UnstatedLoad> loads = unstated_loads(asked.question.bridge(), asked.gaussians, count);
  std::erase_if(loads, [](const UnstatedLoad& load) { return load.force > kMostForce; });
  return loads;
}

/// The readings without what a cause most likely adds to them with no block missing.
Observation without(const UnknownBridge& bridge, Observation observation, const UnstatedCause& cause) {
  for (std::size_t k = 0; k < bridge.rows.size(); ++k) {
    const auto& [channel, before, after] = bridge.rows[k];
    if (after == 0.0) continue;
    observation.displacement[channel] -= cause.expected[static_cast<Eigen::Index>(k)];
    observation.reading[channel] -= cause.expected[static_cast<Eigen::Index>(k)];
  }
  return observation;
}

/// To one digit: forces are known to a factor of two.
double to_one_digit(double value) {
  if (value == 0.0) return 0.0;
  const double unit = std::pow(10.0, std::floor(std::log10(value)));
  return unit * std::round(value / unit);
}

std::string_view at_time(ReadingKind kind, bool first_epoch) {
  if (!is_change(kind)) return "";
  return first_epoch ? " at the first of the two times" : " at the second of the two times";
}

/// "a load of about 50 kN for each metre of the bridge's width between x = 8 and 16 m at the second of the
/// two times"
std::string in_words(const UnstatedLoad& load, ReadingKind kind) {
  return fmt::format(
      "a load of about {:g} kN for each metre of the bridge's width between x = {:.3g} and {:.3g} m{}",
      to_one_digit(kKilonewtons * load.force), load.from, load.to, at_time(kind, load.first_epoch));
}

/// "an error of about 0.3 mm that all readings at A1 to A38 share (a datum, tilt or set-up of their own, ..)"
std::string in_words(const LineError& line, const QuestionContext& asked) {
  const Comparison& comparison = asked.comparison;
  std::vector<std::string> names;
  for (const std::size_t channel : line.channels) names.push_back(name_without_load(comparison, channel));
  const bool both_count = asked.question.bridge().has_first_epoch();
  return fmt::format(
      "an error of about {:g} mm that all readings at {}{}{} share (a datum, tilt or set-up of their own, "
      "which a column levelling with --unknown-datum and --unknown-tilt would state)",
      to_one_digit(kMillimetres * line.size), names_in_words(names),
      under_load(load_of(comparison, line.channels.front())),
      both_count ? at_time(comparison.kind, line.first_epoch) : "");
}

/// If something acted that nobody stated, would others be likely?
std::optional<Fit> check_cause(const QuestionContext& asked, const Alarm& alarm, const UnstatedCause& cause,
                               double chance, const std::string& in_words) {
  const auto scene = explained_by(
      asked, alarm,
      {{.beside = cause.covariance}, chance, without(asked.question.bridge(), asked.observation, cause)});
  if (!scene) return std::nullopt;
  const std::string named =
      alarm.named.empty() ? "some block" : to_string(Scene{alarm.named}, asked.comparison.library.layout);
  return Fit{false, asked.believed.chance,
             fmt::format("{} may be behind them: with it {} would be likely, without it {} is missing",
                         in_words, scene_in_words(asked, *scene), named)};
}

}  // namespace

std::optional<Fit> check_lines_and_loads(const QuestionContext& asked, const Alarm& alarm) {
  for (const LineError& line : lines_of(asked))
    if (const auto fit = check_cause(asked, alarm, line.cause, line.chance, in_words(line, asked)))
      return fit;
  for (const UnstatedLoad& load : loads_of(asked, kMostLoads))
    if (const auto fit =
            check_cause(asked, alarm, load.cause, kLoadChance, in_words(load, asked.comparison.kind)))
      return fit;
  return std::nullopt;
}

/// The line, if one alone may be off, else the load, if it is not a small one.
std::optional<std::string> line_or_load_that_explains(const QuestionContext& asked) {
  const auto explains = [&](const UnstatedCause& cause) {
    const CauseChances chances = cause_chances(asked.question.bridge(), asked.observation, cause);
    return chances.without < kSmallestChance && chances.with >= kSmallestChance;
  };
  const auto on_intact = [](const std::string& cause) {
    return cause + " on an intact bridge would explain them";
  };
  for (const LineError& line : lines_of(asked))
    if (explains(line.cause)) return on_intact(in_words(line, asked));
  for (const UnstatedLoad& load : loads_of(asked, 1))
    if (load.force >= kLeastForce && explains(load.cause))
      return on_intact(in_words(load, asked.comparison.kind));
  return std::nullopt;
}

}  // namespace voussoir
