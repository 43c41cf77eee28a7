#include "lookup/evidence/evidence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "lookup/evidence/likelihood.h"
#include "lookup/evidence/row_statistics.h"
#include "lookup/evidence/table_evidence.h"

namespace voussoir {
namespace {

constexpr double kImpossible = -std::numeric_limits<double>::infinity();
constexpr std::array<NoiseShape, 3> kAutomaticShapes = {NoiseShape::uniform, NoiseShape::gaussian,
                                                        NoiseShape::laplace};
constexpr std::size_t kBlockRows = 1024;
constexpr int kLevelsPerOctave = 8;  // of the grid, where the marginal over levels has no closed form

std::span<const NoiseShape> shapes_of(const NoiseModel& noise) {
  if (noise.shape == NoiseShape::automatic) return kAutomaticShapes;
  return {&noise.shape, 1};
}

/// True if an unknown level multiplies all scales, so that the statistics for one level serve all.
bool is_proportional(const NoiseModel& noise, const Measurements& measurements) {
  const bool own = std::any_of(measurements.sigma.begin(), measurements.sigma.end(),
                               [](double sigma) { return !std::isnan(sigma); });
  return noise.floor == 0.0 && noise.model_error == 0.0 && !own && noise.shape != NoiseShape::student;
}

/// Some rows of a table.
SceneTable part_of(const SceneTable& table, std::size_t first, std::size_t count) {
  SceneTable part = table;
  part.rows = count;
  part.vertical = table.vertical.subspan(first * table.points, count * table.points);
  return part;
}

/// Student's t has no short statistics: one pass over the row.
double log_student_likelihood(const Observation& observation, std::span<const double> prediction, double nu,
                              double sum_log_scale) {
  double sum = -sum_log_scale;
  for (const double z : standard_errors(observation, prediction))
    if (!std::isnan(z)) sum += log_density(NoiseShape::student, z, nu);
  return sum;
}

/// What stays the same for all noise levels.
struct Problem {
  const Measurements& measurements;
  const SceneTable& table;
  std::span<const std::size_t> rows;  // those that count, in ascending order; all others get -infinity
  std::span<const double> intact;
  const NoiseModel& noise;
  std::vector<double> log_silence;  // of each row: that the silent sensors are silent
};

/// A function of blocks of rows, applied to all of them: intermediate results stay in the cache. The function
/// gets a part of the table and the positions in it of the rows that count, and gives a logarithm for each
/// row of the part. Rows that do not count get -infinity, the others what their silent sensors say on top.
template <typename Function>
std::vector<double> block_by_block(const Problem& problem, Function function) {
  std::vector<double> result(problem.table.rows, kImpossible);
  std::vector<std::size_t> positions;
  auto next = problem.rows.begin();
  for (std::size_t first = 0; first < problem.table.rows; first += kBlockRows) {
    const std::size_t count = std::min(kBlockRows, problem.table.rows - first);
    positions.clear();
    for (; next != problem.rows.end() && *next < first + count; ++next) positions.push_back(*next - first);
    if (positions.empty()) continue;
    const std::vector<double> logs = function(part_of(problem.table, first, count), positions);
    for (const std::size_t row : positions)
      result[first + row] = logs[row] + problem.log_silence[first + row];
  }
  return result;
}

std::vector<double> student_likelihoods(const Problem& problem, const SceneTable& part,
                                        std::span<const std::size_t> rows, const Observation& observation,
                                        const TableStatistics& statistics) {
  std::vector<double> result(part.rows, kImpossible);
  for (const std::size_t row : rows)
    if (!std::isnan(statistics.sum_absolute[row]))
      result[row] = log_student_likelihood(observation, part.row(row), problem.noise.degrees_of_freedom,
                                           statistics.sum_log_scale[row]);
  return result;
}

std::vector<double> at_level(const Problem& problem, double level) {
  const Observation observation = observe(problem.measurements, problem.intact, problem.noise, level);
  return block_by_block(problem, [&](const SceneTable& part, std::span<const std::size_t> rows) {
    const TableStatistics statistics = table_statistics(observation, part);
    std::vector<std::vector<double>> logs;
    for (const NoiseShape shape : shapes_of(problem.noise))
      logs.push_back(shape == NoiseShape::student
                         ? student_likelihoods(problem, part, rows, observation, statistics)
                         : log_likelihoods(shape, statistics, observation.count));
    return log_mean(std::move(logs));
  });
}

std::vector<double> over_levels_in_closed_form(const Problem& problem) {
  const Observation observation = observe(problem.measurements, problem.intact, problem.noise, 1.0);
  std::vector<LevelIntegral> integrals;
  for (const NoiseShape shape : shapes_of(problem.noise))
    integrals.push_back(level_integral(shape, observation.count));
  double best = kImpossible;
  return block_by_block(problem, [&](const SceneTable& part, std::span<const std::size_t> rows) {
    return log_mean_evidences(integrals, table_statistics(observation, part), rows, observation.count, best);
  });
}

/// Levels from the smallest to the largest, evenly spaced in their logarithm.
std::vector<double> level_grid() {
  const double octaves = std::log2(kLargestLevel / kSmallestLevel);
  const int steps = static_cast<int>(std::ceil(octaves * kLevelsPerOctave));
  std::vector<double> levels(static_cast<std::size_t>(steps) + 1);
  for (std::size_t i = 0; i < levels.size(); ++i)
    levels[i] = kSmallestLevel * std::exp2(octaves * static_cast<double>(i) / steps);
  return levels;
}

std::vector<double> over_level_grid(const Problem& problem) {
  std::vector<double> result(problem.table.rows, kImpossible);
  const std::vector<double> levels = level_grid();
  for (const double level : levels) {
    const std::vector<double> logs = at_level(problem, level);
    for (const std::size_t row : problem.rows) result[row] = log_sum(result[row], logs[row]);
  }
  for (double& value : result) value -= std::log(static_cast<double>(levels.size()));
  return result;
}

std::vector<double> log_evidence(const Problem& problem) {
  if (problem.noise.relative) return at_level(problem, std::max(*problem.noise.relative, kSmallestLevel));
  if (is_proportional(problem.noise, problem.measurements)) return over_levels_in_closed_form(problem);
  return over_level_grid(problem);
}

SceneTable table_of_one_row(std::span<const double> prediction) {
  SceneTable table;
  table.rows = 1;
  table.points = prediction.size();
  table.vertical = prediction;
  return table;
}

NoiseShape likeliest_shape(const Problem& problem) {
  NoiseShape best = shapes_of(problem.noise).front();
  double best_log = kImpossible;
  for (const NoiseShape shape : shapes_of(problem.noise)) {
    NoiseModel single = problem.noise;
    single.shape = shape;
    const Problem one_shape{problem.measurements, problem.table, problem.rows,
                            problem.intact,       single,        problem.log_silence};
    const double value = log_evidence(one_shape).front();
    if (value > best_log) best = shape;
    best_log = std::max(best_log, value);
  }
  return best;
}

double likeliest_grid_level(const Problem& problem) {
  double best = kSmallestLevel;
  double best_log = kImpossible;
  for (const double level : level_grid()) {
    const double value = at_level(problem, level).front();
    if (value > best_log) best = level;
    best_log = std::max(best_log, value);
  }
  return best;
}

}  // namespace

std::vector<double> log_chance_of_silence(const Measurements& measurements, const SceneTable& table,
                                          std::span<const std::size_t> rows, double silence) {
  std::vector<double> result(table.rows, 0.0);
  for (std::size_t point = 0; point < table.points; ++point) {
    if (!measurements.silent[point]) continue;
    for (const std::size_t row : rows)
      if (!std::isnan(table.row(row)[point])) result[row] += std::log(silence);
  }
  return result;
}

std::vector<double> log_evidence_of_rows(const Measurements& measurements, const SceneTable& table,
                                         std::span<const std::size_t> rows, std::span<const double> intact,
                                         const NoiseModel& noise) {
  if (observe(measurements, intact, noise, 1.0).count == 0)
    throw InputError("no reading at a control point that can move, expected at least one");
  return log_evidence({measurements, table, rows, intact, noise,
                       log_chance_of_silence(measurements, table, rows, noise.silence)});
}

NoiseEstimate estimate_noise(const Measurements& measurements, std::span<const double> prediction,
                             std::span<const double> intact, const NoiseModel& noise) {
  const SceneTable table = table_of_one_row(prediction);
  const std::array<std::size_t, 1> rows = {0};
  NoiseModel single = noise;
  const std::vector<double> no_matter = {0.0};  // silence says nothing of the noise
  single.shape = likeliest_shape({measurements, table, rows, intact, noise, no_matter});
  if (noise.relative) return {single.shape, *noise.relative, false};
  if (!is_proportional(single, measurements))
    return {single.shape, likeliest_grid_level({measurements, table, rows, intact, single, no_matter}), true};
  const Observation observation = observe(measurements, intact, single, 1.0);
  const RowStatistics statistics = table_statistics(observation, table).row(0);
  return {single.shape, likeliest_level(single.shape, statistics, observation.count), true};
}

}  // namespace voussoir
