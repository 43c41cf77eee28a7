#include "tools/reproduction/subject.h"

#include <cmath>

#include "core/units.h"
#include "database/search/index_building.h"
#include "tools/trials/localisation.h"

namespace voussoir {
namespace {

/// Rows come in the order of all_scenes: those with few missing blocks first.
SceneTable rows_with_at_most_one(const SceneTable& table) {
  SceneTable few = table;
  few.rows = 0;
  while (few.rows < table.rows && missing_blocks(table, few.rows) <= 1) ++few.rows;
  few.vertical = table.vertical.first(few.rows * table.points);
  few.removed = table.removed.first(few.rows * table.most_missing);
  few.outcome = table.outcome.first(few.rows);
  if (!table.collapse.empty()) few.collapse = table.collapse.first(few.rows);
  return few;
}

}  // namespace

Subject::Subject(const Database& of, PaperCases shown, const ReproductionSettings& with)
    : database(of),
      cases(std::move(shown)),
      settings(with),
      few(rows_with_at_most_one(of.table())),
      few_index(build_search_index(few.vertical, few.points)) {
  const Library library = all();
  for (const std::size_t row : eligible_rows(library.table, {0, 1, 2}).rows)
    expect_displacements(library, row);
}

std::size_t Subject::row(const std::string& scene) const {
  return row_of(all(), scene);
}

std::vector<double> Subject::settlements_mm(std::size_t row) const {
  const auto vertical = database.table().row(row);
  std::vector<double> result(vertical.begin(), vertical.end());
  for (double& value : result) value *= kMillimetres;
  return result;
}

double noise_per_cent(double level) {
  return std::round(1e8 * level) / 1e6;
}

std::string as_printed(const std::string& scene) {
  std::string text = "(";
  for (const char c : scene) text += c == '+' ? std::string(") + (") : std::string(1, c);
  return text + ")";
}

}  // namespace voussoir
