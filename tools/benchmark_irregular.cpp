#include "tools/benchmark_irregular.h"

#include <fmt/format.h>

#include <cstdio>

#include "core/error.h"
#include "lookup/report/text_file.h"
#include "tools/trials/study_report.h"

namespace voussoir {
namespace {

constexpr double kMetres = 1e-3;  // in a millimetre

StudySettings settings_of(const IrregularOptions& options) {
  StudySettings settings{.sigmas = {}, .every = options.every};
  for (const double sigma : options.sigmas_mm) settings.sigmas.push_back(kMetres * sigma);
  return settings;
}

void print(const std::string& text) {
  fmt::print("{}", text);
  std::fflush(stdout);
}

void append(std::vector<StudyRow>&& more, std::vector<StudyRow>& rows) {
  rows.insert(rows.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

}  // namespace

std::string benchmark_irregular(const std::filesystem::path& path, const IrregularOptions& options) {
  const Database database = Database::open(path);
  StudySource source{path.string(), database.digest(), database.bridge_name(), {}, settings_of(options)};
  const auto show = [](const StudyRow& row) { print(to_text(row)); };
  std::vector<StudyRow> rows;
  print(heading_text());
  for (const std::string& truth : options.truths) {
    const Database bridges = Database::open(truth);
    source.truths.push_back(fmt::format("{} (digest {})", truth, bridges.digest()));
    append(study_damaged(database, {std::filesystem::path(truth).stem().string(), read_true_bridges(bridges)},
                         source.settings, show),
           rows);
  }
  if (!options.json.empty()) write_file(options.json, to_json(source, rows));
  if (!options.page.empty()) write_file(options.page, to_page(source, rows));
  return reliability_text(rows);
}

}  // namespace voussoir
