#include "lookup/checks/question_context.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/not_a_number.h"
#include "core/text.h"
#include "lookup/evidence/scene_evidence.h"

namespace voussoir {

std::string places_in_words(const Library& library, const std::vector<std::size_t>& channels) {
  std::vector<std::string> names;
  for (const std::size_t channel : channels) names.push_back(library.points[channel].name);
  return names_in_words(names);
}

double log_sum_of(const std::vector<double>& logs) {
  return std::accumulate(logs.begin(), logs.end(), kImpossible, log_sum);
}

bool is_likely_beside(double log_other, double log) {
  return log > log_other + std::log((1.0 - kCertain) / kCertain);
}
bool is_likely_beside(const QuestionContext& asked, double log) {
  return is_likely_beside(asked.posterior.log_evidence, log);
}

std::vector<std::size_t> distinct(std::vector<std::size_t> rows) {
  std::ranges::sort(rows);
  rows.erase(std::ranges::unique(rows).begin(), rows.end());
  return rows;
}

std::vector<std::size_t> rows_near(const QuestionContext& asked, const Observation& observation,
                                   std::size_t count) {
  std::vector<std::size_t> rows;
  for (const ScoredRow& near : asked.preparation.smallest_misfits(observation, count))
    rows.push_back(near.row);
  return rows;
}

Observation without(Observation observation, std::span<const std::size_t> channels) {
  for (const std::size_t channel : channels)
    observation.displacement[channel] = observation.reading[channel] = kNan;
  return observation;
}

std::vector<std::size_t> rows_otherwise(const QuestionContext& asked, std::vector<std::size_t> rows,
                                        const std::vector<BlockId>& named) {
  const SceneTable& table = asked.comparison.library.table;
  rows = distinct(std::move(rows));
  std::erase_if(rows, [&](std::size_t row) {
    const Scene scene = table.scene(row);
    const bool has_all = std::ranges::all_of(named, [&](BlockId block) { return scene.lacks(block); });
    return (has_all && !scene.removed.empty()) ||
           !scene_loss(asked.question.bridge(), asked.observation, table, row);
  });
  return rows;
}

Alarm alarm_of(const QuestionContext& asked) {
  std::vector<std::size_t> rows = rows_near(asked, asked.observation, kMostNear);
  rows.push_back(asked.posterior.credible.front());
  const Eligible& eligible = asked.preparation.eligible();
  if (eligible.missing.front() == 0) rows.push_back(eligible.rows.front());
  return {likely_blocks(asked.posterior, kCertain), distinct(std::move(rows))};
}

std::optional<Scene> explained_by(const QuestionContext& asked, const Alarm& alarm,
                                  const Alternative& alternative) {
  std::vector<std::size_t> rows = rows_near(asked, alternative.others, kMostNear);
  rows.insert(rows.end(), alarm.rows.begin(), alarm.rows.end());
  rows = rows_otherwise(asked, std::move(rows), alarm.named);
  if (rows.empty()) return std::nullopt;
  const std::vector<double> logs = asked.question.log_parts_of(
      rows, asked.preparation.eligible(), asked.preparation.prior(), alternative.supposed);
  if (!is_likely_beside(asked, std::log(alternative.chance) + log_sum_of(logs))) return std::nullopt;
  return asked.comparison.library.table.scene(
      rows[static_cast<std::size_t>(std::ranges::max_element(logs) - logs.begin())]);
}

std::string scene_in_words(const QuestionContext& asked, const Scene& scene) {
  return scene.removed.empty() ? "an intact bridge" : to_string(scene, asked.comparison.library.layout);
}

}  // namespace voussoir
