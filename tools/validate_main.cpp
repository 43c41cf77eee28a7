/// @file validate: holds the solvers against known answers and hard cases.

#include <CLI/CLI.hpp>
#include <iostream>

#include "core/error.h"
#include "core/text_file.h"
#include "core/threads.h"
#include "lookup/command_line.h"
#include "tools/validation/report.h"

namespace {

struct Options {
  std::vector<std::string> studies;
  bool quick = false;
  bool list = false;
  int threads = voussoir::hardware_threads();
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

std::string in_format(const std::string& format,
                      const std::vector<voussoir::validation::StudyResult>& results) {
  if (format == "json") return to_json(results);
  return format == "markdown" ? to_markdown(results) : to_text(results);
}

int run(const Options& options) {
  using namespace voussoir::validation;
  const std::vector<Study> studies = chosen_studies(options.studies, options.quick);
  if (options.list) {
    for (const Study& study : studies) std::cout << fmt::format("{:<20} {}\n", study.name, study.title);
    return 0;
  }
  const std::vector<StudyResult> results =
      run_studies(studies, options.threads, [](const StudyResult& result) {
        std::cerr << fmt::format("{} ({:.1f} s)\n", result.title, result.seconds);
      });
  std::cout << in_format(options.format, results);
  if (!options.page.empty()) voussoir::write_file(options.page, to_page(results));
  return tally(results).all_good() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Holds the solvers against known answers and hard cases.", "validate");
  Options options;
  add_options(app, options);
  CLI11_PARSE(app, argc, argv);
  try {
    return run(options);
  } catch (const voussoir::InputError& error) {
    std::cerr << "validate: " << error.what() << '\n';
    return 2;
  } catch (const std::exception& error) {
    std::cerr << "validate: " << error.what() << '\n';
    return 1;
  }
}
