/// @file locate-damage: which blocks are missing, from measured displacements.

#include <algorithm>
#include <array>
#include <cstdio>
#include <set>

#include "core/program/command_line.h"
#include "core/program/heap.h"
#include "core/text_file.h"
#include "core/threads.h"
#include "lookup/locate_damage_options.h"
#include "lookup/opened_databases.h"
#include "lookup/report/report.h"
#include "lookup/report/survey_report.h"

using namespace voussoir;

namespace {

/// Beside answers that have no place for them.
void say_notes(const std::vector<std::string>& notes) {
  for (const std::string& note : notes) fmt::print(stderr, "locate-damage: note: {}\n", note);
}

std::string report_one(OpenedDatabases& opened, const LocateDamageOptions& options) {
  const std::string& file = options.measurements.front();
  if (options.page)
    check_output("--report", *options.page, {".html", ".htm", ".svg"},
                 std::array{std::filesystem::path(file)});
  const auto [one, comparison, settings, answer, databases, notes] = ask(opened, read_readings(file));
  const Source source{file,
                      one->database.path().string(),
                      one->database.bridge_name(),
                      one->database.digest(),
                      one->database.stands_by_slip(),
                      databases,
                      notes};
  if (options.format == ReportFormat::csv) say_notes(notes);
  if (const auto& page = options.page)
    write_file(*page, page->extension() == ".svg" ? picture_report(answer, comparison)
                                                  : page_report(answer, settings, comparison, source));
  return report(answer, settings, comparison, source, options.format);
}

/// A file that cannot be answered has a row, too, and does not stop the others.
SurveyRow row_of(OpenedDatabases& opened, const std::string& file, std::vector<std::string>& notes) {
  try {
    const Answered asked = ask(opened, read_readings(file));
    notes = asked.notes;
    return survey_row(file, asked.answer, asked.comparison,
                      asked.databases.empty() ? "" : asked.databases.front().file);
  } catch (const std::exception& error) {
    return {file, error.what()};
  }
}

ProgramOutput report_all(OpenedDatabases& opened, const LocateDamageOptions& options) {
  const std::vector<std::string>& files = options.measurements;
  std::vector<SurveyRow> rows(files.size());
  std::vector<std::vector<std::string>> notes(files.size());
  for_each_index_on_threads(files.size(), hardware_threads(),
                            [&](std::size_t i) { rows[i] = row_of(opened, files[i], notes[i]); });
  std::set<std::string> each;
  for (const std::vector<std::string>& of_file : notes) each.insert(of_file.begin(), of_file.end());
  say_notes({each.begin(), each.end()});
  const auto failed = std::ranges::count_if(rows, [](const auto& row) { return !row.error.empty(); });
  const std::string survey = survey_report(rows, options.format);
  if (failed == 0) return survey;
  return {survey, kFailed, fmt::format("{} of {} files have no answer", failed, rows.size())};
}

ProgramOutput locate(const LocateDamageOptions& options) {
  if (options.measurements.size() == 1) share_heap();
  OpenedDatabases opened = open_databases(question_of(options));
  if (options.measurements.size() == 1) return report_one(opened, options);
  return report_all(opened, options);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Finds the missing blocks of a masonry arch bridge from measured displacements.",
               "locate-damage");
  app.footer(
      "Example: locate-damage readings.csv -d bridge.h5 --sigma 0.02mm --report report.html\n"
      "         locate-damage readings.csv -d bridge.h5 --without F64,N-west\n"
      "         locate-damage survey/*.csv -d bridge.h5 --format csv > survey.csv\n"
      "         locate-damage readings.csv -d ends-slide.h5 -d ends-held.h5\n"
      "         build-database my-bridge.toml -o sampled.h5 --variants 50 --history built,lost\n"
      "         locate-damage readings.csv -d sampled.h5 --sigma 0.02mm --evidence variants");
  app.set_version_flag("--version", version_text("locate-damage"));
  LocateDamageOptions options;
  add_options(app, options);
  return run_program(app, argc, argv, [&] { return locate(options); });
}
