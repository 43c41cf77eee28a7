#include "lookup/plan/sensor_plan.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/text.h"
#include "lookup/evidence/posterior.h"
#include "lookup/plan/sensor_choice.h"
#include "lookup/readings/comparison.h"

namespace voussoir {
namespace {

/// Changes of nothing at the points: what they are is no matter, only that they are read.
ReadingsFile blank_readings(const SensorList& list, const PlanSettings& settings) {
  ReadingsFile file{"the plan", ReadingKind::change, false, {}};
  const std::vector<std::string>& points = settings.points;
  for (std::size_t s = 0; s < list.sensors.size(); ++s) {
    const Sensor& sensor = list.sensors[s];
    if (!points.empty() && std::ranges::find(points, sensor.name) == points.end()) continue;
    const auto own = settings.sigma_of.find(sensor.quantity);
    file.readings.push_back(
        {.sensor = s, .value = 0.0, .sigma = own == settings.sigma_of.end() ? settings.sigma : own->second});
  }
  return file;
}

void require_points(const SensorList& list, const std::vector<std::string>& points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (std::ranges::find(list.sensors, points[i], &Sensor::name) == list.sensors.end())
      throw InputError(fmt::format("--points: unknown point {}, expected {}", points[i],
                                   names_in_words(names_of(list.sensors))));
    if (std::ranges::count(points, points[i]) > 1)
      throw InputError(fmt::format("--points: {} comes twice, expected each once", points[i]));
  }
}

/// Sensors as they would be asked about, with nothing read yet.
struct BlankQuestion {
  Comparison comparison;
  Observation observation;
  UnknownBridge bridge;
  CaseNoise noise;

  BlankQuestion(const Database& database, const SensorList& list, const PlanSettings& settings)
      : comparison(compare(blank_readings(list, settings), list, database, {.history = settings.history})),
        observation(observe(comparison, {.shape = NoiseShape::gaussian, .relative = 0.0},
                            {.datum = settings.datum})) {
    const SceneTable& table = comparison.library.table;
    const auto intact = table.find(Scene{});
    if (!intact || static_cast<Outcome>(table.outcome[*intact]) != Outcome::standing)
      throw Failure(
          fmt::format("{}: the intact bridge does not stand, so nothing is known of what is uncertain of it",
                      database.path().string()));
    if (const auto& part = database.shard())
      throw Failure(fmt::format("{}: is part {} of a database, expected the whole (merge-databases)",
                                database.path().string(), to_string(part->shard)));
    if (!comparison.factors)
      throw Failure(
          fmt::format("{}: knows nothing of what is uncertain of the bridge, expected a database that was "
                      "built without --known-bridge",
                      database.path().string()));
    require_readings(observation);
    bridge = unknown_bridge(comparison, observation, {.conditions = settings.conditions});
    noise = case_noise(bridge, observation, {0.0, settings.conditions == Conditions::known ? 0.0 : 1.0});
  }

  std::vector<std::string> points() const {
    std::vector<std::string> names;
    for (const ReadingRow& row : bridge.rows) names.push_back(comparison.library.points[row.channel].name);
    return names;
  }
};

SightSettings sight_settings(const BlankQuestion& question, const Database& database) {
  const SceneTable& table = question.comparison.library.table;
  const Prior prior = stated_prior({}, table, false);
  const Eligible eligible = eligible_rows(table, prior.missing);
  if (eligible.scenes.size() < 2 || eligible.scenes[1] == 0)
    throw Failure(fmt::format("{}: has no loss of one block that leaves the bridge standing",
                              database.path().string()));
  const std::vector<double> beforehand = log_prior_by_missing(table, eligible, prior);
  return {.log_prior_intact = beforehand[0],
          .log_prior_loss = beforehand[1],
          .log_silence = std::log(question.observation.noise.silence),
          .certain = kCertain};
}

/// Sorts the blocks without a sight, and those of which it is not sure that there is one.
void add_others(const BlankQuestion& question, SensorPlan& plan) {
  const SceneTable& table = question.comparison.library.table;
  for (std::size_t b = 0; b < question.bridge.blocks; ++b) {
    const BlockId block{static_cast<std::int32_t>(b)};
    const auto row = table.find({{block}});
    if (std::ranges::find(plan.sights, block, &Sight::block) != plan.sights.end()) {
      if (row && table.is_uncertain_fall(*row)) plan.may_fall.push_back(block);
      continue;
    }
    const bool falls = row && static_cast<Outcome>(table.outcome[*row]) == Outcome::collapsed;
    (falls ? plan.falls : plan.unknown).push_back(block);
  }
}

std::vector<std::string> points_that_help(const BlankQuestion& question, const Database& database,
                                          std::size_t count) {
  const std::vector<std::string> all = question.points();
  if (count > all.size())
    throw InputError(fmt::format("{} points are to be chosen, expected at most the {} that can be read",
                                 count, all.size()));
  std::vector<std::string> chosen;
  for (const Eigen::Index row :
       rows_that_help(question.bridge, question.noise, sight_settings(question, database), count))
    chosen.push_back(all[static_cast<std::size_t>(row)]);
  return chosen;
}

}  // namespace

SensorPlan plan_sensors(const Database& database, const PlanSettings& settings) {
  const SensorList list = control_point_sensors(database.control_points());
  require_points(list, settings.points);
  PlanSettings acting = settings;
  std::vector<std::string> chosen;
  if (settings.choose)
    acting.points = chosen =
        points_that_help(BlankQuestion(database, list, settings), database, *settings.choose);
  const BlankQuestion question(database, list, acting);
  SensorPlan plan{question.comparison.history, question.points(), std::move(chosen),
                  sights_of(question.bridge, question.noise, sight_settings(question, database))};
  add_others(question, plan);
  return plan;
}

}  // namespace voussoir
