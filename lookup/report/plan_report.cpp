#include "lookup/report/plan_report.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "core/json_text.h"
#include "core/not_a_number.h"
#include "core/units.h"
#include "database/records/content_digest.h"
#include "lookup/report/drawing/table.h"
#include "lookup/report/plan_words.h"
#include "lookup/report/reading_words.h"
#include "lookup/report/words.h"

namespace voussoir {
namespace {

constexpr double kHardly = 0.1;  // a loss that is seen less often shows hardly
constexpr std::size_t kLeastSeenListed = 15;

std::string label(BlockId block, const Database& database) {
  return database.layout()[block].label;
}

std::string labels(const std::vector<BlockId>& blocks, const Database& database) {
  std::vector<std::string> names;
  for (const BlockId block : blocks) names.push_back(label(block, database));
  return fmt::format("{}", fmt::join(names, "  "));
}

template <typename Predicate>
std::vector<BlockId> blocks_where(const SensorPlan& plan, Predicate holds) {
  std::vector<BlockId> blocks;
  for (const Sight& sight : plan.sights)
    if (holds(sight)) blocks.push_back(sight.block);
  return blocks;
}

std::vector<BlockId> seen(const SensorPlan& plan) {
  return blocks_where(plan, [](const Sight& sight) { return sight.seen >= kSure; });
}
std::vector<BlockId> named(const SensorPlan& plan) {
  return blocks_where(plan, [](const Sight& sight) { return sight.named >= kSure; });
}
std::vector<BlockId> hardly_seen(const SensorPlan& plan) {
  return blocks_where(plan, [](const Sight& sight) { return sight.seen < kHardly; });
}

/// Over all blocks without which the bridge stands; 0 if there are none.
double mean_of(const SensorPlan& plan, double Sight::*share) {
  double sum = 0.0;
  for (const Sight& sight : plan.sights) sum += sight.*share;
  return plan.sights.empty() ? 0.0 : sum / static_cast<double>(plan.sights.size());
}

Table block_table(const SensorPlan& plan, const Database& database) {
  Table table{{"block", "falls", "seen", "named", "largest_change_m", "at", "silent_sensors", "alike"}, {}};
  for (const Sight& sight : plan.sights)
    table.rows.push_back({label(sight.block, database),
                          std::ranges::count(plan.may_fall, sight.block) > 0 ? "may" : "no", sight.seen,
                          sight.named, sight.largest, plan.point_of(sight), static_cast<double>(sight.silent),
                          sight.alike ? label(*sight.alike, database) : ""});
  for (const auto& [blocks, falls] : {std::pair{&plan.falls, "yes"}, std::pair{&plan.unknown, "unknown"}})
    for (const BlockId block : *blocks)
      table.rows.push_back({label(block, database), falls, kNan, kNan, kNan, "", kNan, ""});
  return table;
}

nlohmann::ordered_json sigmas_json(const PlanSettings& settings) {
  nlohmann::ordered_json result = nlohmann::ordered_json::object();
  for (const auto& [quantity, sigma] : settings.sigma_of) result[std::string(to_string(quantity))] = sigma;
  return result;
}

std::string plan_json(const SensorPlan& plan, const PlannedBridge& bridge) {
  nlohmann::ordered_json result = {{"database", bridge.database.path().string()},
                                   {"digest", bridge.database.digest()},
                                   {"history", plan.history},
                                   {"sigma_m", bridge.settings.sigma},
                                   {"sigma_of", sigmas_json(bridge.settings)},
                                   {"datum_m", bridge.settings.datum},
                                   {"conditions", to_string(bridge.settings.conditions)},
                                   {"points", plan.points},
                                   {"seen", seen(plan).size()},
                                   {"named", named(plan).size()},
                                   {"mean_seen", mean_of(plan, &Sight::seen)},
                                   {"mean_named", mean_of(plan, &Sight::named)},
                                   {"standing", plan.sights.size()},
                                   {"may_fall", plan.may_fall.size()},
                                   {"falls", plan.falls.size()}};
  result["chosen"] = plan.chosen;
  result["blocks"] = nlohmann::ordered_json::parse(to_json(block_table(plan, bridge.database)));
  return json_text(result, 1);
}

using Text = std::back_insert_iterator<std::string>;

bool reads_tilts(const SensorPlan& plan, const Database& database) {
  return std::ranges::any_of(database.control_points(), [&](const StoredPoint& point) {
    return point.quantity == Quantity::tilt && is_read(plan, point);
  });
}

void write_heading(Text to, const SensorPlan& plan, const PlannedBridge& bridge) {
  fmt::format_to(to, "Plan:         {}\n", planned_in_words(plan, bridge));
  fmt::format_to(to, "Database:     {} (bridge '{}', digest {})\n", bridge.database.path().string(),
                 bridge.database.bridge_name(), bridge.database.digest().substr(0, kDigestShown));
  fmt::format_to(to, "History:      {}\n", history_in_words(plan.history));
  fmt::format_to(to, "Bridge:       {}\n\n", conditions_in_words(bridge));
}

/// "none of 193 losses", "12 of 193 losses"
std::string some_of(std::size_t some, std::size_t all, std::string_view things) {
  return fmt::format("{} of {} {}", some == 0 ? "none" : fmt::format("{}", some), all, things);
}

/// "24 %"; below 1 % as `percent` has it.
std::string about(double share) {
  return share < 0.01 ? percent(share) : fmt::format("{:.0f} %", 100.0 * share);
}

void write_counts(Text to, const SensorPlan& plan, const PlannedBridge& bridge) {
  const std::size_t count = plan.sights.size();
  fmt::format_to(
      to, "Seen:         {} would be seen with a chance of {:.0f} % or more; the average chance is {}\n",
      some_of(seen(plan).size(), count, "losses"), 100.0 * kSure, about(mean_of(plan, &Sight::seen)));
  fmt::format_to(
      to, "Named:        {} would be named with a chance of {:.0f} % or more; the average chance is {}\n",
      some_of(named(plan).size(), count, "blocks"), 100.0 * kSure, about(mean_of(plan, &Sight::named)));
  if (bridge.settings.conditions != Conditions::known)
    fmt::format_to(
        to,
        "In trials:    of the reference bridge half to three quarters as many were seen, with twelve "
        "sensors fewer still (docs/plan.md)\n");
  const std::vector<BlockId> hardly = hardly_seen(plan);
  fmt::format_to(to, "Hardly seen:  {} would be seen with a chance of less than {:.0f} %{}\n",
                 some_of(hardly.size(), count, "losses"), 100.0 * kHardly,
                 hardly.empty() ? "" : ": " + labels(hardly, bridge.database));
  if (!plan.may_fall.empty())
    fmt::format_to(
        to, "May fall:     a bridge just as its file says would without one of {} of these blocks: {}\n",
        plan.may_fall.size(), labels(plan.may_fall, bridge.database));
  if (!plan.falls.empty())
    fmt::format_to(to, "Falls:        without one of {} more blocks something falls: {}\n", plan.falls.size(),
                   labels(plan.falls, bridge.database));
  if (!plan.unknown.empty())
    fmt::format_to(to, "Not known:    what these blocks' losses show: {}\n",
                   labels(plan.unknown, bridge.database));
}

void write_chosen(Text to, const SensorPlan& plan) {
  if (!plan.chosen.empty())
    fmt::format_to(to, "\nChosen, those that help most first: {}\n", fmt::join(plan.chosen, " "));
}

/// What the readings after the loss would be taken for.
std::string looks_like(const Sight& sight, const Database& database) {
  if (sight.seen < kHardly) return "no loss";
  return sight.alike ? label(*sight.alike, database) : "";
}

/// Those that are hardest to see first.
void write_blocks(Text to, const SensorPlan& plan, const Database& database) {
  std::vector<Sight> sights = plan.sights;
  std::ranges::stable_sort(sights, {}, &Sight::seen);
  const std::size_t shown = std::min(sights.size(), kLeastSeenListed);
  fmt::format_to(to, "\nBlocks whose loss is seen least ({} of {}; --format csv lists all):\n", shown,
                 sights.size());
  fmt::format_to(to, "  {:<8} {:>9} {:>9} {:>12}  {:<6} {}\n", "block", "seen", "named", "change [mm]", "at",
                 "looks most like");
  for (const Sight& sight : std::span(sights).first(shown))
    fmt::format_to(to, "  {:<8} {:>9} {:>9} {:>12.3f}  {:<6} {}\n", label(sight.block, database),
                   percent(sight.seen), percent(sight.named), kMillimetres * sight.largest,
                   plan.point_of(sight), looks_like(sight, database));
}

}  // namespace

bool is_read(const SensorPlan& plan, const StoredPoint& point) {
  return std::ranges::find(plan.points, point.name) != plan.points.end();
}

std::string planned_in_words(const SensorPlan& plan, const PlannedBridge& bridge) {
  std::string text = fmt::format("changes between two times at {} points; standard deviations of {:g} mm{}",
                                 plan.points.size(), kMillimetres * bridge.settings.sigma,
                                 reads_tilts(plan, bridge.database) ? " (tilts: mm per m)" : "");
  for (const auto& [quantity, sigma] : bridge.settings.sigma_of)
    text += fmt::format(", of {} {:g} {}", to_string(quantity), kMillimetres * sigma, unit_of(quantity));
  if (bridge.settings.datum > 0.0)
    text += fmt::format(", all heights of a levelling off by {:g} mm alike",
                        kMillimetres * bridge.settings.datum);
  return text;
}

std::string conditions_in_words(const PlannedBridge& bridge) {
  return bridge.settings.conditions == Conditions::known
             ? "uncertain as its file states; temperature and supports are taken as known"
             : "uncertain as its file states, as are temperature and supports";
}

std::string plan_report(const SensorPlan& plan, const PlannedBridge& bridge, ReportFormat format) {
  if (format == ReportFormat::csv) return to_csv(block_table(plan, bridge.database));
  if (format == ReportFormat::json) return plan_json(plan, bridge);
  std::string text;
  const Text to(text);
  write_heading(to, plan, bridge);
  write_counts(to, plan, bridge);
  write_chosen(to, plan);
  write_blocks(to, plan, bridge.database);
  return text;
}

}  // namespace voussoir
