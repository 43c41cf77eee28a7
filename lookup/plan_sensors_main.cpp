/// @file plan-sensors: which losses of single blocks sensors would show, before anything is read.

#include "core/error.h"
#include "core/structure/sensor_description.h"
#include "core/text.h"
#include "core/text_file.h"
#include "lookup/command_line.h"
#include "lookup/readings/stated_sigmas.h"
#include "lookup/report/plan_report.h"

namespace {

struct Options {
  voussoir::PlanSettings settings;
  std::optional<std::string> database;
  std::optional<std::string> picture;
  voussoir::ReportFormat format = voussoir::ReportFormat::text;
};

std::string plan(const Options& options) {
  const auto database = voussoir::Database::open(voussoir::find_database(options.database));
  if (options.picture) voussoir::check_output("--report", *options.picture, {".svg"});
  const voussoir::SensorPlan plan = voussoir::plan_sensors(database, options.settings);
  if (options.picture)
    voussoir::write_file(*options.picture, voussoir::plan_picture(plan, {database, options.settings}));
  return voussoir::plan_report(plan, {database, options.settings}, options.format);
}

/// "tilt=0.01mm"
std::pair<voussoir::Quantity, double> sigma_of(const std::string& text) {
  const std::size_t sign = text.find('=');
  const auto quantity = voussoir::parse_quantity(std::string_view(text).substr(0, sign));
  if (!quantity || sign == std::string::npos)
    throw voussoir::InputError(
        fmt::format("{} given, expected {}, an equals sign and millimetres, such as tilt=0.01mm",
                    voussoir::in_quotes(text), voussoir::kQuantities));
  return {*quantity, voussoir::parse_sigma(std::string_view(text).substr(sign + 1))};
}

void add_errors(CLI::App& app, voussoir::PlanSettings& settings) {
  app.add_option_function<std::string>(
         "--sigma", [&](const std::string& text) { settings.sigma = voussoir::parse_sigma(text); },
         "standard deviation of the change between two times at each sensor, such as 0.02mm")
      ->required()
      ->check(voussoir::checked_by(voussoir::parse_sigma, "MM"))
      ->option_text("MM");
  app.add_option_function<std::vector<std::string>>(
         "--sigma-of",
         [&](const std::vector<std::string>& texts) {
           for (const std::string& text : texts)
             settings.sigma_of.insert_or_assign(sigma_of(text).first, sigma_of(text).second);
         },
         "the same of sensors of one quantity, such as tilt=0.01 (mm per m),distance=0.005mm")
      ->delimiter(',')
      ->check(voussoir::checked_by(sigma_of, "QUANTITY=MM"))
      ->option_text("QUANTITY=MM");
}

void add_reading_options(CLI::App& app, Options& options) {
  voussoir::PlanSettings& settings = options.settings;
  app.add_option("-d,--database", options.database, "default: $VOUSSOIR_DATABASE, else ./bridge.h5")
      ->option_text("FILE");
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
  app.add_option("--history", settings.history,
                 "whether the blocks were never there (built) or went later (lost); default: lost if the "
                 "database has it")
      ->check(CLI::IsMember({voussoir::kBuiltState, voussoir::kLostState}))
      ->option_text("NAME");
  voussoir::add_choice<voussoir::Conditions>(
      app, "--conditions", settings.conditions,
      {{"uncertain", voussoir::Conditions::uncertain}, {"known", voussoir::Conditions::known}},
      "temperature, movements of the supports and what all joints soften by alike between two times: "
      "uncertain (default) as the bridge file states, or known: readings will be corrected for them");
  voussoir::add_millimetres(app, "--unknown-datum", settings.datum,
                            "how far all readings of a levelling may be shifted, such as 0.3mm");
}

void add_options(CLI::App& app, Options& options) {
  add_reading_options(app, options);
  voussoir::add_choice<voussoir::ReportFormat>(app, "--format", options.format,
                                               {{"text", voussoir::ReportFormat::text},
                                                {"json", voussoir::ReportFormat::json},
                                                {"csv", voussoir::ReportFormat::csv}},
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
  app.set_version_flag("--version", voussoir::version_text("plan-sensors"));
  Options options;
  add_options(app, options);
  return voussoir::run_program(app, argc, argv, [&] { return plan(options); });
}
