#include "lookup/report/report_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>
#include <limits>
#include <span>

#include "core/units.h"
#include "database/records/content_digest.h"
#include "lookup/answer/verdict.h"
#include "lookup/report/reading_words.h"
#include "lookup/report/words.h"
#include "lookup/search/eligible_rows.h"

namespace voussoir {

namespace {

constexpr std::size_t kMostSensorsListed = 5;
constexpr std::size_t kMostLossesNamed = 20;
constexpr std::string_view kOneOfMany = "likeliest of many", kByBelief = "likeliest by belief";

/// The likeliest scene's row if it is none of the candidates, which a search by misfit may miss.
std::optional<std::size_t> missed_row(const Answer& answer) {
  if (!answer.posterior || answer.posterior->credible.empty()) return std::nullopt;
  const std::size_t likeliest = answer.posterior->credible.front();
  const bool missed = *answer.candidates.front().posterior < answer.posterior->probability[likeliest];
  return missed ? std::optional(likeliest) : std::nullopt;
}

/// The blocks that are certainly missing.
std::string located_in_words(const Posterior& posterior, const Library& library) {
  const std::vector<BlockId> blocks = likely_blocks(posterior, kCertain);
  std::vector<std::string> names, chances;
  for (const BlockId id : blocks) {
    names.push_back(library.layout[id].label);
    chances.push_back(percent(posterior.block_probability[static_cast<std::size_t>(value(id))]));
  }
  return fmt::format("Block{} {} {} missing ({}).", blocks.size() == 1 ? "" : "s", fmt::join(names, " and "),
                     blocks.size() == 1 ? "is" : "are", fmt::join(chances, " and "));
}

std::string supposed_in_words(Supposed supposed) {
  return supposed == Supposed::damage ? "that blocks are missing was supposed, not found"
                                      : "that no block is missing was supposed, not found";
}

/// What goes with the probability of the intact bridge.
std::string belief_in_words(const Answer& answer) {
  if (!is_intact_by_belief(answer)) return "";
  return fmt::format(", as intact bridges are believed to be likelier; {} if they were not",
                     percent(answer.posterior->intact_if_even));
}

std::string blocks_in_words(std::size_t count) {
  return fmt::format("{} block{}", count, count == 1 ? "" : "s");
}

/// An intact bridge, as far as these sensors would show what is lost.
std::string intact_in_words(double probability, std::size_t open_losses, ReadingKind kind) {
  const std::string sure = percent(probability);
  const std::string_view verb = is_change(kind) ? "has gone" : "is missing";
  const std::string_view when = is_change(kind) ? " between the two times" : "";
  if (open_losses == 0) return fmt::format("No block {}{} ({}).", verb, when, sure);
  return fmt::format(
      "Nothing shows that a block {}{} ({} that none {}), but these readings do not exclude the loss of {}.",
      verb, when, sure, verb.substr(0, verb.find(' ')), blocks_in_words(open_losses));
}

std::string in_words(const Scene& scene, const Library& library) {
  return fmt::format("{} ({})", to_string(scene, library.layout), place_in_words(scene, library.layout));
}

}  // namespace

std::string_view first_candidate_in_words(const Answer& answer) {
  if (!answer.posterior) return "best match";
  if (missed_row(answer)) return "nearest by misfit";
  switch (verdict_of(answer)) {
    case Verdict::unexplained:
      return "closest";
    case Verdict::cannot_tell:
      return is_intact_by_belief(answer) ? kByBelief : kOneOfMany;
    case Verdict::damaged_unlocated:
      return kOneOfMany;
    default:
      return "most likely";
  }
}

std::string headline(const Answer& answer, const Comparison& comparison) {
  if (!answer.posterior) return "";
  const Posterior& posterior = *answer.posterior;
  const double intact = intact_probability(posterior);
  const Supposed supposed = supposed_by(answer.prior);
  switch (verdict_of(answer)) {
    case Verdict::located:
      return located_in_words(posterior, comparison.library) +
             (supposed == Supposed::nothing ? "" : fmt::format(" But {}.", supposed_in_words(supposed)));
    case Verdict::damaged_unlocated:
      return fmt::format("Blocks are missing ({}), but the readings do not say which.",
                         percent(1.0 - intact));
    case Verdict::intact:
      return intact_in_words(intact, posterior.open_losses.size(), comparison.kind);
    case Verdict::cannot_tell:
      if (answer.contested) return "The answer depends on which database's assumptions hold.";
      if (supposed != Supposed::nothing)
        return fmt::format("The readings name no block, and {}.", supposed_in_words(supposed));
      return fmt::format("The readings do not tell whether blocks are missing (none is: {}{}).",
                         percent(intact), belief_in_words(answer));
    default:
      return "The readings are unexplained: neither damage nor its absence is shown.";
  }
}

std::string searched_in_words(const Answer& answer) {
  std::string text = fmt::format("{} scene{}", answer.searched, answer.searched == 1 ? "" : "s");
  if (answer.unresolved > 0)
    text += fmt::format("; {} more have no solution and were left out", answer.unresolved);
  if (answer.fallen > 0)
    text += fmt::format("; {} in which something falls, and of which no field is kept, were left out",
                        answer.fallen);
  return text;
}

std::string open_losses_in_words(const Answer& answer, const Library& library) {
  const std::vector<OpenLoss> open = open_losses(answer);
  if (open.empty()) return "";
  std::string names;
  for (const OpenLoss& loss : std::span(open).first(std::min(open.size(), kMostLossesNamed)))
    names += (names.empty() ? "" : ", ") + to_string(library.table.scene(loss.row), library.layout);
  return fmt::format(
      "With the loss of one of these blocks the readings would be more than a tenth as likely as with none: "
      "{}{}. plan-sensors says which sensors would show it.",
      names, open.size() > kMostLossesNamed ? fmt::format(", .. ({} in all)", open.size()) : "");
}

/// What a probability of one scene is of.
std::string_view just_this_in_words(const Scene& scene) {
  if (scene.removed.empty()) return "that no block is missing";
  return scene.removed.size() == 1 ? "that this block is missing and no other"
                                   : "that these blocks are missing and no other";
}

/// Where the intact bridge comes first but is not certain: which loss it would be, if it were one.
std::string suspect_in_words(const Answer& answer, const Library& library) {
  if (!answer.posterior || verdict_of(answer) != Verdict::cannot_tell ||
      !answer.candidates.front().scene.removed.empty())
    return "";
  const RowValues& probability = answer.posterior->probability;
  std::size_t likeliest = 0;
  double most = 0.0, damage = 0.0;  // summed: the difference from 1 may be nothing but round-off
  for (std::size_t i = 0; i < probability.rows.size(); ++i) {
    if (missing_blocks(library.table, probability.rows[i]) == 0) continue;
    damage += probability.values[i];
    if (probability.values[i] <= most) continue;
    likeliest = probability.rows[i];
    most = probability.values[i];
  }
  if (most == 0.0) return "";
  return fmt::format("Of losses the likeliest is {}, with {} of the probability of damage",
                     in_words(library.table.scene(likeliest), library), percent(most / damage));
}

std::vector<std::string> suspects_in_words(const Answer& answer, const Comparison& comparison) {
  std::vector<std::string> names;
  if (!answer.without) return names;
  for (const std::size_t channel : answer.without->channels)
    names.push_back(comparison.library.points[channel].name);
  return names;
}

std::string without_in_words(const Answer& answer, const Comparison& comparison) {
  if (!answer.without) return "";
  return fmt::format("Without {}: {}", fmt::join(suspects_in_words(answer, comparison), ", "),
                     headline(*answer.without->answer, comparison));
}

std::vector<std::string> conclusions_in_words(const Answer& answer, const Library& library) {
  const Candidate& best = answer.candidates.front();
  const std::optional<std::size_t> missed = missed_row(answer);
  std::vector<std::string> sentences;
  const std::string_view first = first_candidate_in_words(answer);
  if (first == kByBelief)
    sentences.emplace_back("No scene is named: what follows is likeliest by belief, not by the readings.");
  if (first == kOneOfMany)
    sentences.push_back(supposed_by(answer.prior) == Supposed::no_damage
                            ? "No scene is named: that no block is missing was supposed."
                            : "No scene is named: what follows is only the likeliest of many.");
  if (!missed && answer.fit && !answer.fit->explained)
    sentences.push_back(fmt::format("No scene in this database is an answer to these measurements: {}{}",
                                    answer.fit->reason, answer.fit->reason.ends_with('?') ? "" : "."));
  std::string opening(first);
  opening.front() = static_cast<char>(std::toupper(opening.front()));
  sentences.push_back(fmt::format("{}: {}", opening, in_words(best.scene, library)));
  if (best.posterior)
    sentences.push_back(
        fmt::format("Probability:  {} {}{}", percent(*best.posterior), just_this_in_words(best.scene),
                    answer.fit && !answer.fit->explained ? ", if one of the scenes were the truth" : ""));
  if (const std::string suspect = suspect_in_words(answer, library); !suspect.empty())
    sentences.push_back(suspect);
  if (const std::string open = open_losses_in_words(answer, library); !open.empty())
    sentences.push_back(open);
  if (missed)
    sentences.push_back(fmt::format("More likely, {}, but not found by this search: {}",
                                    percent(answer.posterior->probability[*missed]),
                                    in_words(library.table.scene(*missed), library)));
  if (best.standing_share)
    sentences.push_back(
        fmt::format("A bridge just as the file says would not stand without {}; of those drawn at "
                    "random as the file says how well it is known {:.0f} % do.",
                    to_string(best.scene, library.layout), 100.0 * *best.standing_share));
  else if (best.outcome == Outcome::collapsed)
    sentences.push_back("This scene collapses: its displacements are a snapshot, not an equilibrium.");
  return sentences;
}

std::string verdict_in_words(const Answer& answer) {
  const Verdict verdict = verdict_of(answer);
  const Supposed supposed = supposed_by(answer.prior);
  const std::string sure = fmt::format("at least {:.0f} % sure ", 100.0 * kCertain);
  const auto meaning = [&]() -> std::string {
    switch (verdict) {
      case Verdict::located:
        return sure + "that each block named is missing";
      case Verdict::damaged_unlocated:
        return sure + "that blocks are missing, but not of any single one";
      case Verdict::intact:
        return sure + "that no block is missing";
      case Verdict::cannot_tell:
        if (answer.contested) return "the databases whose assumptions may hold come to different answers";
        return supposed == Supposed::nothing ? "the readings do not tell whether blocks are missing"
                                             : supposed_in_words(supposed);
      default:
        return "no scene is an answer; the list below names the closest";
    }
  };
  return fmt::format("{} ({})", to_string(verdict), meaning());
}

std::string in_words(const AskedDatabase& database) {
  return fmt::format("{:>8}  {} (digest {}): {}{}", percent(database.probability), database.file,
                     database.digest.substr(0, kDigestShown), to_string(database.verdict),
                     database.first.empty() ? "" : fmt::format(", first {}", database.first));
}

std::string bridge_in_words(const Answer& answer) {
  if (answer.known_bridge) return "taken as exactly known";
  const bool known_conditions = answer.bridge && answer.bridge->model.conditions == Conditions::known;
  return known_conditions ? "not exactly known: joints and stone are uncertain as the bridge file states; "
                            "temperature and supports are taken as known"
                          : "not exactly known: joints, stone, temperature and supports are uncertain as "
                            "the bridge file states";
}

std::string_view errors_are_shares_of(ReadingKind kind) {
  switch (kind) {
    case ReadingKind::absolute:
      return "displacement";
    case ReadingKind::load:
      return "load's displacement";
    default:
      return "change";
  }
}

/// The standard deviations that the readings state.
std::string stated_in_words(const Measurements& measured) {
  double least = std::numeric_limits<double>::infinity(), most = 0.0;
  for (std::size_t i = 0; i < measured.sigma.size(); ++i) {
    if (std::isnan(measured.displacement[i]) || std::isnan(measured.sigma[i])) continue;
    least = std::min(least, kMillimetres * measured.sigma[i]);
    most = std::max(most, kMillimetres * measured.sigma[i]);
  }
  if (most == 0.0) return "absolute";
  return least == most ? fmt::format("{:.3g} mm", most) : fmt::format("{:.3g} to {:.3g} mm", least, most);
}

std::string noise_in_words(const NoiseEstimate& noise, const Comparison& comparison) {
  const ReadingKind kind = comparison.kind;
  if (!noise.estimated && noise.level <= kSmallestLevel)
    return fmt::format("{} as stated for each reading ({} noise)", stated_in_words(comparison.measured),
                       to_string(noise.shape));
  const std::string floor = noise.floor > 0.0 ? fmt::format("{:.3g} mm", kMillimetres * noise.floor) : "";
  if (noise.estimated && noise.level <= 2.0 * kSmallestLevel)
    return floor.empty() ? "none that could be seen"
                         : floor + " as stated, and none besides that could be seen";
  const std::string_view meaning = noise.shape == NoiseShape::uniform ? "at most" : "a standard deviation of";
  return fmt::format("{} {:.2g} % of the {}{} ({} noise, {})", meaning, 100.0 * noise.level,
                     errors_are_shares_of(kind), floor.empty() ? "" : " and " + floor, to_string(noise.shape),
                     !noise.estimated ? "as stated"
                     : floor.empty()  ? "estimated"
                                      : "the share estimated");
}

std::string behind(const Candidate& candidate, const Candidate& best) {
  if (!best.posterior) return fmt::format("{:+.4f}", candidate.misfit - best.misfit);
  if (*candidate.posterior == 0.0) return "negligible";
  const double odds = *best.posterior / *candidate.posterior;
  if (odds >= 1e6) return "1 : > 10^6";
  if (odds < 100.0) return fmt::format("1 : {:.3g}", odds);
  const double step = std::pow(10.0, std::floor(std::log10(odds)) - 2.0);  // three figures
  return fmt::format("1 : {:.0f}", step * std::round(odds / step));
}

std::string same_in_words(const Candidate& candidate, const Library& library) {
  constexpr std::size_t kMostNamed = 20;
  const std::vector<Scene>& same = candidate.same_readings;
  std::string names;
  for (const Scene& scene : std::span(same).first(std::min(same.size(), kMostNamed)))
    names += (names.empty() ? "" : "; ") + to_string(scene, library.layout);
  return same.size() > kMostNamed ? fmt::format("{}; .. ({} in all)", names, same.size()) : names;
}

std::string missing_in_words(const Answer& answer) {
  std::vector<std::string> numbers;
  for (const int missing : answer.prior.missing)
    numbers.push_back(
        fmt::format("{}: {}", missing,
                    percent(answer.posterior->missing_probability[static_cast<std::size_t>(missing)])));
  return fmt::format("{}", fmt::join(numbers, ", "));
}

std::string_view if_true(const Answer& answer) {
  return has_probabilities(answer) ? "" : ", if one of the scenes were the truth";
}

std::vector<std::string> odd_sensors(const Answer& answer, const Comparison& comparison) {
  const std::vector<double> origin = origin_of(comparison);
  std::vector<SensorResidual> odd = disagreeing(answer.residuals);
  odd.resize(std::min(odd.size(), kMostSensorsListed));
  std::vector<std::string> sentences;
  for (const SensorResidual& sensor : odd)
    sentences.push_back(fmt::format(
        "Sensor {0} disagrees: it reads {1:.3f} {2} where {3:.3f} {2} would be expected",
        comparison.library.points[sensor.point].name, kMillimetres * (sensor.reading - origin[sensor.point]),
        unit_of(quantity_of(comparison, sensor.point)),
        kMillimetres * (sensor.predicted - origin[sensor.point])));
  return sentences;
}

}  // namespace voussoir
