#include "tools/benchmarks/assumptions.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "core/bridge_file/bridge_file.h"
#include "core/error.h"
#include "core/geometry/polygon.h"
#include "core/structure/model.h"
#include "lookup/answer/verdict.h"
#include "lookup/opened_databases.h"
#include "lookup/readings/readings_csv.h"
#include "tools/trials/sampled_truth.h"
#include "tools/trials/taken_readings.h"

namespace voussoir {
namespace {

/// A point of the bridge is the databases' if it is at most so far away [m]: shapes may differ by that.
constexpr double kSamePlace = 0.1;

/// What may happen to a bridge between two levellings and is no damage.
struct Happening {
  const char* name;
  Between between;
};

const std::vector<Happening>& happenings() {
  static const std::vector<Happening> all = {
      {"20 K warmer", {.warmer = 20.0}},
      {"8 K warmer", {.warmer = 8.0}},
      {"20 K cooler", {.warmer = -20.0}},
      {"8 K cooler", {.warmer = -8.0}},
      {"left half 4 K warmer", {.warmer = 4.0, .warmer_part = 0.5}},
      {"left foot 1 mm lower", {.settlement = 1e-3}},
      {"joints a tenth softer", {.joint_stiffness = 0.9}},
      {"left half a tenth softer", {.joint_stiffness = 0.9, .softened_part = 0.5}},
      {"8 K warmer, foot 0.5 mm lower, joints 5 % softer",
       {.warmer = 8.0, .settlement = 5e-4, .joint_stiffness = 0.95}}};
  return all;
}

/// Control points of the bridge and the first database's ones at the same places, by their numbers.
struct SharedPoints {
  std::vector<std::size_t> of_bridge, of_database;
};

bool has_sensor(const OpenedDatabase& one, const std::string& name) {
  return std::ranges::find(one.sensors.sensors, name, &Sensor::name) != one.sensors.sensors.end();
}

/// The bridge's control point at a place, of the block whose middle is nearest to the given one: neighbours
/// share places.
std::optional<std::size_t> point_there(const Model& bridge, const Point& place, const Point& middle) {
  std::optional<std::size_t> found;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t p = 0; p < bridge.control_points.size(); ++p) {
    const ControlPoint& point = bridge.control_points[p];
    if (point.quantity != Quantity::uy) continue;
    const double away = (centroid(bridge.layout[point.block].polygon) - middle).norm();
    if ((point.position - place).norm() > kSamePlace || away >= least) continue;
    least = away;
    found = p;
  }
  return found;
}

SharedPoints shared_points(const std::string& file, const Model& bridge, const OpenedDatabases& opened,
                           double shift) {
  const Database& first = opened.front().database;
  SharedPoints shared;
  for (std::size_t s = 0; s < first.control_points().size(); ++s) {
    const StoredPoint& point = first.control_points()[s];
    if (point.quantity != Quantity::uy) continue;
    if (!std::ranges::all_of(opened, [&](const OpenedDatabase& one) { return has_sensor(one, point.name); }))
      continue;
    const Point moved(shift, 0.0);
    const auto there =
        point_there(bridge, point.position + moved, centroid(first.layout()[point.block].polygon) + moved);
    if (!there) continue;
    shared.of_bridge.push_back(*there);
    shared.of_database.push_back(s);
  }
  if (shared.of_bridge.empty())
    throw InputError(
        fmt::format("{}: no control point is where one of {} is, expected points within {} m "
                    "(--shift says how much further right the bridge lies)",
                    file, first.path().string(), kSamePlace));
  return shared;
}

std::vector<double> chosen(const std::vector<double>& values, const std::vector<std::size_t>& places) {
  std::vector<double> result;
  for (const std::size_t place : places) result.push_back(values[place]);
  return result;
}

/// A file of readings of the shared points.
ReadingsText readings_of(const IntactBridge& bridge, const SharedPoints& points, ReadingsTaken taken,
                         const AssumptionOptions& options, std::uint64_t question,
                         const OpenedDatabase& one) {
  Random random(series_seed(options.seed, question));
  const std::vector<double> before = chosen(bridge.before, points.of_bridge);
  const std::vector<double> after = chosen(bridge.after, points.of_bridge);
  ReadingsFile file = take_readings({before, after}, taken, options.sigma, random);
  for (Reading& reading : file.readings) reading.sensor = points.of_database[reading.sensor];
  return {to_csv(file, one.sensors), "readings"};
}

void count(Verdict verdict, AssumptionCounts& counts) {
  ++counts.asked;
  counts.damaged += is_alarm(verdict) ? 1 : 0;
  counts.named += verdict == Verdict::located ? 1 : 0;
  counts.cannot_tell += verdict == Verdict::cannot_tell ? 1 : 0;
  counts.unexplained += verdict == Verdict::unexplained ? 1 : 0;
}

/// What each database says, in the order in which they were given, and what they say together.
std::vector<Verdict> verdicts_of(OpenedDatabases& opened, const ReadingsText& readings) {
  const Answered answered = ask(opened, readings);
  const Verdict together = verdict_of(answered.answer);
  if (opened.size() == 1) return {together};
  std::vector<Verdict> verdicts;
  for (const OpenedDatabase& one : opened)
    verdicts.push_back(
        std::ranges::find(answered.databases, one.database.path().string(), &AskedDatabase::file)->verdict);
  verdicts.push_back(together);
  return verdicts;
}

/// One bridge's rows: one for each database and, of several, one for all together.
class BridgeRows {
 public:
  BridgeRows(const std::string& file, OpenedDatabases& all, const AssumptionOptions& told)
      : description(read_bridge_file(file).description),
        bridge(make_model(description)),
        points(shared_points(file, bridge, all, told.shift)),
        opened(all),
        options(told) {
    for (const OpenedDatabase& one : opened) rows.push_back(row_for(one.database.path().string(), file));
    if (opened.size() > 1) rows.push_back(row_for("together", file));
  }

  std::vector<AssumptionRow> measure() {
    ask_all("at rest", solved("at rest", {}), ReadingsTaken::absolute);
    for (const Happening& happening : happenings())
      ask_all(happening.name, solved(happening.name, happening.between), ReadingsTaken::change);
    return std::move(rows);
  }

 private:
  AssumptionRow row_for(const std::string& database, const std::string& file) const {
    return {.bridge = file, .database = database, .points = points.of_bridge.size()};
  }

  IntactBridge solved(const std::string& name, const Between& between) const {
    const SampledTruth as_written{fmt::format("{}, {}", rows.front().bridge, name), scattered_joints(0.0), 1};
    return solve_intact(description, as_written, between).bridges.front();
  }

  void ask_all(const std::string& name, const IntactBridge& shown, ReadingsTaken taken) {
    for (int i = 0; i < options.questions; ++i) {
      const std::vector<Verdict> verdicts =
          verdicts_of(opened, readings_of(shown, points, taken, options, asked++, opened.front()));
      for (std::size_t r = 0; r < rows.size(); ++r) {
        count(verdicts[r], taken == ReadingsTaken::change ? rows[r].changes : rows[r].absolute);
        if (taken != ReadingsTaken::change || !is_alarm(verdicts[r])) continue;
        std::vector<std::string>& alarms = rows[r].alarms;
        if (alarms.empty() || alarms.back() != name) alarms.push_back(name);
      }
    }
  }

  BridgeDescription description;
  Model bridge;
  SharedPoints points;
  OpenedDatabases& opened;
  const AssumptionOptions& options;
  std::vector<AssumptionRow> rows{};
  std::uint64_t asked = 0;
};

std::string counts_text(const AssumptionCounts& counts) {
  return fmt::format("{} of {} ({}; {}; {})", counts.damaged, counts.asked, counts.named, counts.cannot_tell,
                     counts.unexplained);
}

}  // namespace

std::vector<AssumptionRow> measure_assumptions(const AssumptionOptions& options,
                                               const AssumptionRowsDone& done) {
  OpenedDatabases opened = open_databases({.databases = options.databases});
  std::vector<AssumptionRow> all;
  for (const std::string& file : options.bridges) {
    const std::vector<AssumptionRow> rows = BridgeRows(file, opened, options).measure();
    done(rows);
    all.insert(all.end(), rows.begin(), rows.end());
  }
  return all;
}

std::string to_markdown(const std::vector<AssumptionRow>& rows) {
  std::string text =
      "Intact bridges called damaged (in brackets: with a block named; `cannot-tell`; `unexplained`)\n\n"
      "| the bridge in truth | points | asked of | changes | absolute | changes called damage |\n"
      "|---|---|---|---|---|---|\n";
  for (const AssumptionRow& row : rows)
    text += fmt::format("| {} | {} | {} | {} | {} | {} |\n", row.bridge, row.points, row.database,
                        counts_text(row.changes), counts_text(row.absolute),
                        row.alarms.empty() ? "none" : fmt::format("{}", fmt::join(row.alarms, "; ")));
  return text;
}

}  // namespace voussoir
