#include "lookup/evidence/evidence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "lookup/evidence/level_curve.h"
#include "lookup/evidence/level_evidence.h"
#include "lookup/evidence/row_blocks.h"
#include "lookup/evidence/scene_evidence.h"
#include "lookup/evidence/table_evidence.h"

namespace voussoir {
namespace {

constexpr double kOtherShape = 36.0;  // logarithm of how far behind another shape's best row one is left out

using Rows = std::span<const std::size_t>;
using Logs = std::vector<std::vector<double>>;  // for each shape, of each row

void append(Logs&& more, Logs& logs) {
  std::ranges::move(more, std::back_inserter(logs));
}

std::vector<double> at_level(const Observation& observation, double level, const SceneTable& table,
                             Rows rows) {
  return block_by_block(rows, [&](Rows block) {
    Logs logs;
    for (const auto& shapes : groups_of(observation.noise))
      append(log_likelihoods_at(observation, shapes, level, table, block), logs);
    return log_mean(std::move(logs));
  });
}

std::vector<double> over_levels_in_closed_form(const Observation& observation, const SceneTable& table,
                                               Rows rows) {
  const ErrorScales scales = scales_at(observation, 1.0);
  std::vector<LevelIntegral> integrals;
  for (const NoiseShape shape : shapes_of(observation.noise))
    integrals.push_back(level_integral(shape, observation.count));
  double best = kImpossible;
  return block_by_block(rows, [&](Rows block) {
    return log_mean_evidences(integrals, table_statistics(observation, scales, table, block),
                              observation.count, best);
  });
}

/// The evidence of shapes over all levels; rows that are hopeless beside the best get -infinity, and those
/// that are beside what is known to be likely under another shape.
Logs over_levels(const Observation& observation, Shapes shapes, const SceneTable& table, Rows rows,
                 double known) {
  const double level = likeliest_level_of_all(observation, shapes, table, rows);
  const std::vector<double> estimates = estimated_peaks(observation, shapes, level, table, rows);
  const double least = std::max(*std::max_element(estimates.begin(), estimates.end()) - kHopeless,
                                known - log_width(shapes.front(), observation.count) - kOtherShape);
  std::vector<std::size_t> places, kept;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (estimates[i] > kImpossible && estimates[i] >= least) {
      places.push_back(i);
      kept.push_back(rows[i]);
    }
  const Logs values = evidence_over_levels(observation, shapes, level, table, kept);
  Logs result(shapes.size(), std::vector<double>(rows.size(), kImpossible));
  for (std::size_t shape = 0; shape < shapes.size(); ++shape)
    for (std::size_t i = 0; i < places.size(); ++i) result[shape][places[i]] = values[shape][i];
  return result;
}

std::vector<double> log_evidence(const Observation& observation, const SceneTable& table, Rows rows) {
  if (rows.empty()) return {};
  if (!observation.unknown_level) return at_level(observation, stated_level(observation), table, rows);
  if (has_closed_form(observation)) return over_levels_in_closed_form(observation, table, rows);
  Logs logs;
  double known = kImpossible;
  for (const auto& shapes : groups_of(observation.noise)) {
    append(over_levels(observation, shapes, table, rows, known), logs);
    for (const std::vector<double>& of_shape : logs)
      known = std::max(known, *std::max_element(of_shape.begin(), of_shape.end()));
  }
  return log_mean(std::move(logs));
}

}  // namespace

std::vector<NoiseShape> shapes_of(const NoiseModel& noise) {
  if (noise.shape != NoiseShape::automatic) return {noise.shape};
  return {NoiseShape::uniform, NoiseShape::gaussian, NoiseShape::laplace};
}

std::vector<std::vector<NoiseShape>> groups_of(const NoiseModel& noise) {
  if (noise.shape != NoiseShape::automatic) return {{noise.shape}};
  return {{NoiseShape::gaussian, NoiseShape::laplace}, {NoiseShape::uniform}};
}

double stated_level(const Observation& observation) {
  return std::max(observation.noise.relative.value_or(0.0), kSmallestLevel);
}

bool has_closed_form(const Observation& observation) {
  return observation.is_proportional() && observation.noise.shape != NoiseShape::student;
}

std::vector<double> log_chance_of_silence(const Observation& observation, const SceneTable& table,
                                          std::span<const std::size_t> rows) {
  std::vector<double> result(rows.size(), 0.0);
  for (std::size_t point = 0; point < table.points; ++point) {
    // Of a point that is held a reading says no more than that its block is there.
    const bool is_held =
        !std::isnan(observation.displacement[point]) && std::isnan(observation.reading[point]);
    if (!observation.silent[point] && !is_held) continue;
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (std::isnan(table.row(rows[i])[point]) == is_held)
        result[i] += is_held ? kImpossible : std::log(observation.noise.silence);
  }
  return result;
}

std::vector<double> log_evidence_of_each(const Observation& observation, const SceneTable& table,
                                         std::span<const std::size_t> rows) {
  require_readings(observation);
  std::vector<double> logs = log_evidence(observation, table, rows);
  const std::vector<double> log_silence = log_chance_of_silence(observation, table, rows);
  for (std::size_t i = 0; i < rows.size(); ++i) logs[i] += log_silence[i];
  return logs;
}

RowValues log_evidence_of_rows(const Observation& observation, const SceneTable& table,
                               std::vector<std::size_t> rows) {
  std::vector<double> logs = log_evidence_of_each(observation, table, rows);
  return {kImpossible, std::move(rows), std::move(logs)};
}

NoiseEstimate estimate_noise(const Observation& observation, std::span<const double> prediction) {
  const SceneTable table = table_of_one_row(prediction);
  constexpr std::array<std::size_t, 1> kRow = {0};
  NoiseEstimate estimate{shapes_of(observation.noise).front(), observation.noise.relative.value_or(0.0),
                         observation.unknown_level, observation.noise.floor};
  double best = kImpossible;
  for (const NoiseShape shape : shapes_of(observation.noise)) {
    Observation one = observation;
    one.noise.shape = shape;
    const double log = log_evidence(one, table, kRow).front();
    if (log <= best) continue;
    best = log;
    estimate.shape = shape;
    if (!observation.unknown_level) continue;
    estimate.level =
        has_closed_form(observation)
            ? likeliest_level(shape, table_statistics(one, scales_at(one, 1.0), table, kRow).row(0),
                              one.count)
            : likeliest_level(one, std::array{shape}, table, kRow);
  }
  return estimate;
}

}  // namespace voussoir
