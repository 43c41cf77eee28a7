/// @file plan-sensors: which losses of single blocks sensors would show, before anything is read.

#include "core/error.h"
#include "core/structure/sensor_description.h"
#include "core/text.h"
#include "core/text_file.h"
#include "lookup/command_line.h"
#include "lookup/readings/stated_sigmas.h"
#include "lookup/report/plan_report.h"

using namespace voussoir;

namespace {

struct Options {
  PlanSettings settings;
  std::optional<std::string> database;
  std::optional<std::string> picture;
  ReportFormat format = ReportFormat::text;
};

std::string plan(const Options& options) {
  const auto database = Database::open(find_database(options.database));
  if (options.picture) check_output("--report", *options.picture, {".svg"});
  const SensorPlan plan = plan_sensors(database, options.settings);
  if (options.picture) write_file(*options.picture, plan_picture(plan, {database, options.settings}));
  return plan_report(plan, {database, options.settings}, options.format);
}

/// "tilt=0.01mm"
std::pair<Quantity, double> sigma_of(const std::string& text) {
  const std::size_t sign = text.find('=');
  const auto quantity = parse_quantity(std::string_view(text).substr(0, sign));
  if (!quantity || sign == std::string::npos)
    throw InputError(fmt::format("{} given, expected {}, an equals sign and millimetres, such as tilt=0.01mm",
                                 in_quotes(text), kQuantities));
  return {*quantity, parse_sigma(std::string_view(text).substr(sign + 1))};
}

void add_errors(CLI::App& app, PlanSettings& settings) {
  add_parsed(app, "--sigma", settings.sigma, parse_sigma, "MM",
             "standard deviation of the change between two times at each sensor, such as 0.02mm")
      ->required();
  app.add_option_function<std::vector<std::string>>(
         "--sigma-of",
         [&](const std::vector<std::string>& texts) {
           for (const std::string& text : texts)
             settings.sigma_of.insert_or_assign(sigma_of(text).first, sigma_of(text).second);
         },
         "the same of sensors of one quantity, such as tilt=0.01 (mm per m),distance=0.005mm")
      ->delimiter(',')
      ->check(checked_by(sigma_of, "QUANTITY=MM"))
      ->option_text("QUANTITY=MM");
}

void add_reading_options(CLI::App& app, Options& options) {
  PlanSettings& settings = options.settings;
  add_database_option(app, options.database);
  add_errors(app, settings);
  app.add_option(
         "--points", settings.points,
         "control points, and sensors of the bridge file, that can be read, such as T1,T8,A3; default: all")
      ->delimiter(',')
      ->option_text("LIST");
  app.add_option("--choose", settings.choose,
                 "take only so many of them, with which the most losses are seen")
      ->check(CLI::Range(std::size_t{1}, std::size_t{100000}))
      ->option_text("N");
  add_history_option(app, settings.history,
                     "whether the blocks were never there (built) or went later (lost); default: lost if the "
                     "database has it");
  add_choice<Conditions>(
      app, "--conditions", settings.conditions,
      {{"uncertain", Conditions::uncertain}, {"known", Conditions::known}},
      "temperature, movements of the supports and what all joints soften by alike between two times: "
      "uncertain (default) as the bridge file states, or known: readings will be corrected for them");
  add_millimetres(app, "--unknown-datum", settings.datum,
                  "how far all readings of a levelling may be shifted, such as 0.3mm");
}

void add_options(CLI::App& app, Options& options) {
  add_reading_options(app, options);
  add_choice<ReportFormat>(
      app, "--format", options.format,
      {{"text", ReportFormat::text}, {"json", ReportFormat::json}, {"csv", ReportFormat::csv}},
      "text (default), json or csv");
  app.add_option("--report", options.picture, "also write a picture of the bridge (SVG)")
      ->option_text("FILE.svg");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Says which losses of single blocks sensors would show, and which of the blocks would be named, before "
      "anything is read.",
      "plan-sensors");
  app.footer(
      "Example: plan-sensors -d bridge.h5 --sigma 0.02mm --choose 12 --report plan.svg\n"
      "         plan-sensors -d bridge.h5 --sigma 0.1mm --points T1,T8,T16,A3 --conditions known");
  app.set_version_flag("--version", version_text("plan-sensors"));
  Options options;
  add_options(app, options);
  return run_program(app, argc, argv, [&] { return plan(options); });
}
