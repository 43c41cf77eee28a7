#include "lookup/evidence/evidence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "lookup/evidence/row_statistics.h"
#include "lookup/evidence/scene_evidence.h"
#include "lookup/evidence/table_evidence.h"

namespace voussoir {
namespace {

constexpr double kImpossible = -std::numeric_limits<double>::infinity();
constexpr std::array<NoiseShape, 3> kAutomaticShapes = {NoiseShape::uniform, NoiseShape::gaussian,
                                                        NoiseShape::laplace};
constexpr std::size_t kBlockRows = 1024;
constexpr int kLevelsPerOctave = 8;  // of the grid, where the marginal over levels has no closed form

/// The shapes that are possible, equally likely beforehand.
std::span<const NoiseShape> shapes_of(const NoiseModel& noise) {
  if (noise.shape == NoiseShape::automatic) return kAutomaticShapes;
  return {&noise.shape, 1};
}

/// Some rows of a table.
SceneTable part_of(const SceneTable& table, std::size_t first, std::size_t count) {
  SceneTable part = table;
  part.rows = count;
  part.vertical = table.vertical.subspan(first * table.points, count * table.points);
  return part;
}

/// Student's t has no short statistics: one pass over the row.
double log_student_likelihood(const Observation& observation, const ErrorScales& scales,
                              std::span<const double> prediction, double sum_log_scale) {
  double sum = -sum_log_scale;
  for (const double z : standard_errors(observation, scales, prediction))
    if (!std::isnan(z)) sum += log_density(NoiseShape::student, z, observation.noise.degrees_of_freedom);
  return sum;
}

/// What stays the same for all noise levels.
struct Problem {
  const Observation& observation;
  const SceneTable& table;
  std::span<const std::size_t> rows;  // those that count, in ascending order; all others get -infinity
  std::span<const NoiseShape> shapes;
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

std::vector<double> student_likelihoods(const Observation& observation, const ErrorScales& scales,
                                        const SceneTable& part, std::span<const std::size_t> rows,
                                        const TableStatistics& statistics) {
  std::vector<double> result(part.rows, kImpossible);
  for (const std::size_t row : rows)
    if (!std::isnan(statistics.sum_absolute[row]))
      result[row] = log_student_likelihood(observation, scales, part.row(row), statistics.sum_log_scale[row]);
  return result;
}

std::vector<double> at_level(const Problem& problem, double level) {
  const Observation& observation = problem.observation;
  const ErrorScales scales = scales_at(observation, level);
  return block_by_block(problem, [&](const SceneTable& part, std::span<const std::size_t> rows) {
    const TableStatistics statistics = table_statistics(observation, scales, part);
    std::vector<std::vector<double>> logs;
    for (const NoiseShape shape : problem.shapes)
      logs.push_back(shape == NoiseShape::student
                         ? student_likelihoods(observation, scales, part, rows, statistics)
                         : log_likelihoods(shape, statistics, observation.count));
    return log_mean(std::move(logs));
  });
}

std::vector<double> over_levels_in_closed_form(const Problem& problem) {
  const Observation& observation = problem.observation;
  const ErrorScales scales = scales_at(observation, 1.0);
  std::vector<LevelIntegral> integrals;
  for (const NoiseShape shape : problem.shapes) integrals.push_back(level_integral(shape, observation.count));
  double best = kImpossible;
  return block_by_block(problem, [&](const SceneTable& part, std::span<const std::size_t> rows) {
    return log_mean_evidences(integrals, table_statistics(observation, scales, part), rows, observation.count,
                              best);
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

/// True if an unknown level multiplies all scales, so that the statistics for one level serve all.
bool is_proportional(const Observation& observation) {
  return !observation.has_absolute_errors() && observation.noise.shape != NoiseShape::student;
}

std::vector<double> log_evidence(const Problem& problem) {
  const std::optional<double> level = problem.observation.noise.relative;
  if (level) return at_level(problem, std::max(*level, kSmallestLevel));
  return is_proportional(problem.observation) ? over_levels_in_closed_form(problem)
                                              : over_level_grid(problem);
}

SceneTable table_of_one_row(std::span<const double> prediction) {
  SceneTable table;
  table.rows = 1;
  table.points = prediction.size();
  table.vertical = prediction;
  return table;
}

/// The shape under which the readings are likeliest if the scene of a table with one row is the truth.
std::span<const NoiseShape> likeliest_shape(const Problem& problem) {
  std::size_t best = 0;
  double best_log = kImpossible;
  for (std::size_t i = 0; i < problem.shapes.size(); ++i) {
    Problem single = problem;
    single.shapes = problem.shapes.subspan(i, 1);
    const double value = log_evidence(single).front();
    if (value > best_log) best = i;
    best_log = std::max(best_log, value);
  }
  return problem.shapes.subspan(best, 1);
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

std::vector<double> log_chance_of_silence(const Observation& observation, const SceneTable& table,
                                          std::span<const std::size_t> rows) {
  std::vector<double> result(table.rows, 0.0);
  for (std::size_t point = 0; point < table.points; ++point) {
    if (!observation.silent[point]) continue;
    for (const std::size_t row : rows)
      if (!std::isnan(table.row(row)[point])) result[row] += std::log(observation.noise.silence);
  }
  return result;
}

std::vector<double> log_evidence_of_rows(const Observation& observation, const SceneTable& table,
                                         std::span<const std::size_t> rows) {
  require_readings(observation);
  return log_evidence({observation, table, rows, shapes_of(observation.noise),
                       log_chance_of_silence(observation, table, rows)});
}

NoiseEstimate estimate_noise(const Observation& observation, std::span<const double> prediction) {
  const SceneTable table = table_of_one_row(prediction);
  const std::array<std::size_t, 1> rows = {0};
  const std::vector<double> no_matter = {0.0};  // silence says nothing of the noise
  Problem problem{observation, table, rows, shapes_of(observation.noise), no_matter};
  problem.shapes = likeliest_shape(problem);
  const NoiseShape shape = problem.shapes.front();
  if (observation.noise.relative) return {shape, *observation.noise.relative, false};
  if (!is_proportional(observation)) return {shape, likeliest_grid_level(problem), true};
  const RowStatistics statistics = table_statistics(observation, scales_at(observation, 1.0), table).row(0);
  return {shape, likeliest_level(shape, statistics, observation.count), true};
}

}  // namespace voussoir
