#pragma once
/// @file A question about a bridge that is not exactly known, what it was answered with, and what that
/// competes with.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lookup/checks/asked_readings.h"
#include "lookup/unknown/unknown_question.h"

namespace voussoir {

/// The question, and what it was answered with.
struct QuestionContext : AskedReadings {
  const UnknownBridgeQuestion& question;
  const UnknownSettings& settings;
  std::vector<IntactGaussian> gaussians;  ///< at the level of UnknownEvidence::likeliest
  const BridgePosterior& believed;        ///< of the likeliest scenes
};

/// "T1, T2"
std::string places_in_words(const Library& library, const std::vector<std::size_t>& channels);

/// Of logarithms.
double log_sum_of(const std::vector<double>& logs);

/// More than a tenth beside something else: logarithms.
bool is_likely_beside(double log_other, double log);
/// The same beside what the answer is about.
bool is_likely_beside(const QuestionContext& asked, double log);

/// Each once, in ascending order.
std::vector<std::size_t> distinct(std::vector<std::size_t> rows);

/// Scenes near the readings that something else is asked about.
inline constexpr std::size_t kMostNear = 3;

/// So many scenes near the readings.
std::vector<std::size_t> rows_near(const QuestionContext& asked, const Observation& observation,
                                   std::size_t count);

/// The same readings without those of some channels.
Observation without(Observation observation, std::span<const std::size_t> channels);

/// Of these rows those that readings leave possible and that lack not all of the named blocks; of none named
/// those that lack none.
std::vector<std::size_t> rows_otherwise(const QuestionContext& asked, std::vector<std::size_t> rows,
                                        const std::vector<BlockId>& named);

/// What an answer is asked about: the blocks that it says are missing with certainty, and rows that may be
/// the truth instead.
struct Alarm {
  std::vector<BlockId> named;
  std::vector<std::size_t> rows;
};
Alarm alarm_of(const QuestionContext& asked);

/// Something that nobody stated.
struct Alternative {
  Supposition supposed;
  double chance = 0.0;  ///< [-] beforehand
  Observation others;   ///< the readings without what it does to them
};

/// A scene that lacks not all of the named blocks and would be likely, too, if this were so: the likeliest of
/// the alarm's and those near the other readings. Null unless all of them together would be likely.
std::optional<Scene> explained_by(const QuestionContext& asked, const Alarm& alarm,
                                  const Alternative& alternative);

/// "an intact bridge", or the blocks that are missing.
std::string scene_in_words(const QuestionContext& asked, const Scene& scene);

}  // namespace voussoir
