/// @file validate: holds the solvers against known answers and hard cases.

#include <CLI/CLI.hpp>
#include <iostream>

#include "core/program/command_line.h"
#include "core/text_file.h"
#include "core/threads.h"
#include "tools/validation/report.h"

using namespace voussoir;

namespace {

struct Options {
  std::vector<std::string> studies;
  bool quick = false;
  bool list = false;
  int threads = hardware_threads();
  std::string format = "text";
  std::string page;
};

CLI::App& add_options(CLI::App& app, Options& options) {
  app.footer("Example: validate arch table --page arch.html");
  app.add_option("studies", options.studies, "only studies whose name contains one of these words");
  app.add_flag("--quick", options.quick, "only the studies that are part of every test run");
  app.add_flag("--list", options.list, "name the studies and end");
  app.add_option("--threads", options.threads, "default: one a core")->check(CLI::Range(1, 256));
  app.add_option("--format", options.format)
      ->check(CLI::IsMember({"text", "json", "markdown"}))
      ->capture_default_str();
  app.add_option("--page", options.page, "also write an HTML page with tables and plots to this file");
  return app;
}

std::string in_format(const std::string& format, const std::vector<validation::StudyResult>& results) {
  if (format == "json") return to_json(results);
  return format == "markdown" ? to_markdown(results) : to_text(results);
}

ProgramOutput run(const Options& options) {
  using namespace validation;
  const std::vector<Study> studies = chosen_studies(options.studies, options.quick);
  if (options.list) {
    std::string names;
    for (const Study& study : studies) names += fmt::format("{:<20} {}\n", study.name, study.title);
    return names;
  }
  const std::vector<StudyResult> results =
      run_studies(studies, options.threads, [](const StudyResult& result) {
        std::cerr << fmt::format("{} ({:.1f} s)\n", result.title, result.seconds);
      });
  if (!options.page.empty()) write_file(options.page, to_page(results));
  const Tally found = tally(results);
  const std::string report = in_format(options.format, results);
  if (found.all_good()) return report;
  return {report, kFailed, to_sentence(found)};
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Holds the solvers against known answers and hard cases.", "validate");
  Options options;
  add_options(app, options);
  return run_program(app, argc, argv, [&] { return run(options); });
}
