#pragma once
/// @file A made-up library of scenes, quick to make: a wall of blocks in courses, smooth settlements, a dent
/// below each missing block.

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "database/search/index_building.h"
#include "lookup/lookup.h"
#include "lookup/readings/simulate.h"

namespace voussoir::test {

struct SyntheticLibrary {
  std::size_t blocks = 0, most_missing = 2;
  std::vector<double> vertical;
  std::vector<std::int32_t> removed;
  std::vector<std::uint8_t> outcome;
  std::vector<StoredPoint> points;
  BlockLayout layout;
  SceneTable table;
  SearchIndexData index;

  SyntheticLibrary(const SyntheticLibrary&) = delete;  // the table looks into the vectors
  SyntheticLibrary& operator=(const SyntheticLibrary&) = delete;

  /// `courses` courses of `length` unit blocks, two points on each block of the highest course; intact, all
  /// singles, all pairs and so on. Removing a whole column's foot is said to make a scene collapse (large
  /// displacements).
  SyntheticLibrary(int courses, int length, int most = 2)
      : blocks(static_cast<std::size_t>(courses * length)), most_missing(static_cast<std::size_t>(most)) {
    for (int course = 1; course <= courses; ++course)
      for (int position = 1; position <= length; ++position) add_block(course, position, course == courses);
    for (int i = 0; i < 2 * length; ++i)
      points.push_back({"T" + std::to_string(i + 1), Point((i + 1) / 2, courses),
                        BlockId{static_cast<std::int32_t>((courses - 1) * length + i / 2)}});
    for (const Scene& scene : all_scenes(blocks, most)) add_scene(scene);
    table = {outcome.size(), points.size(), most_missing, vertical, removed, outcome};
    make_index();
  }

  /// After a change of `vertical`.
  void make_index() { index = build_search_index(vertical, points.size()); }

  Library library() const { return {table, points, layout, index.view()}; }
  std::span<const double> intact() const { return table.row(0); }
  /// Absolute readings, or changes (added to the intact displacements) if the model has an error.
  Observation observe(const Measurements& measured, const NoiseModel& noise, const Nuisance& nuisance = {},
                      const ModelError& error = {}) const {
    Comparison comparison = absolute_readings(library(), measured);
    if (error != ModelError{}) comparison.kind = ReadingKind::change;
    comparison.model_error = error;
    return voussoir::observe(comparison, noise, nuisance);
  }
  std::size_t row_of(const Scene& scene) const { return table.find(scene).value_or(table.rows); }

  /// Readings of a row with noise of the given level and shape, everywhere that the scene has a point.
  Measurements measure(std::size_t row, double level, NoiseShape shape, Random& random) const {
    NoiseModel noise{shape, level};
    noise.silence = 0.0;
    return simulate_readings(table.row(row), noise, random);
  }

 private:
  void add_block(int course, int position, bool is_on_top) {
    Block block;
    block.top_course = is_on_top;
    block.index = {course, position};
    block.label = to_string(block.index);
    block.kind = BlockKind::plain;
    const double x = position - 1, y = course - 1;
    block.polygon = {Point(x, y), Point(x + 1, y), Point(x + 1, y + 1), Point(x, y + 1)};
    layout.blocks.push_back(block);
  }

  double settlement(const Scene& scene, const Point& at) const {
    double value = 1e-3 * (1.5 + std::sin(0.4 * at.x()));
    for (const BlockId id : scene.removed) {
      const BlockIndex at_block = layout[id].index;
      const double distance = at.x() - (at_block.position - 0.5 + 0.05 * at_block.course);
      const double size = at_block.course == 1 && at_block.position == 2 ? 40.0 : 0.15;
      value += 1e-3 * size * std::exp(-distance * distance / (1.0 + 0.5 * (at.y() - at_block.course)));
    }
    return value;
  }

  void add_scene(const Scene& scene) {
    for (const StoredPoint& point : points)
      vertical.push_back(scene.lacks(point.block) ? std::numeric_limits<double>::quiet_NaN()
                                                  : -settlement(scene, point.position));
    for (const BlockId id : scene.removed) removed.push_back(value(id));
    removed.insert(removed.end(), most_missing - scene.removed.size(), -1);
    outcome.push_back(
        static_cast<std::uint8_t>(scene.lacks(BlockId{1}) ? Outcome::collapsed : Outcome::standing));
  }
};

/// All rows of a table.
inline std::vector<std::size_t> all_rows(const SceneTable& table) {
  std::vector<std::size_t> rows(table.rows);
  for (std::size_t row = 0; row < rows.size(); ++row) rows[row] = row;
  return rows;
}

}  // namespace voussoir::test
