#include "tools/benchmarks/skips.h"

#include <unistd.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>

#include "generator/build.h"
#include "generator/build_switches.h"

namespace voussoir {
namespace {

/// A database and what it cost.
struct Built {
  double seconds = 0.0;  ///< of processor time a scene
  std::vector<double> vertical;
  std::vector<std::uint8_t> outcome;
};

Built build(BuildRequest request, const SolverChoice& solver) {
  request.output = std::filesystem::temp_directory_path() / fmt::format("voussoir-skips-{}.h5", ::getpid());
  Progress quiet(Progress::Mode::quiet);
  const std::clock_t begin = std::clock();
  build_database(request, solver, quiet);
  const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  const Database database = Database::open(request.output);
  std::filesystem::remove(request.output);
  const SceneTable& table = database.table();
  return {seconds / static_cast<double>(table.rows),
          {table.vertical.begin(), table.vertical.end()},
          {table.outcome.begin(), table.outcome.end()}};
}

SkipRow compare(std::string name, const Built& with, const Built& without, double stated_change) {
  SkipRow row{std::move(name), with.seconds,
              without.seconds, largest_change(with.vertical, without.vertical),
              stated_change,   0};
  for (std::size_t i = 0; i < with.outcome.size(); ++i)
    row.other_outcomes += with.outcome[i] != without.outcome[i] ? 1 : 0;
  return row;
}

}  // namespace

double largest_change(std::span<const double> with, std::span<const double> without) {
  if (with.size() != without.size()) return std::numeric_limits<double>::infinity();
  double largest = 0.0;
  for (std::size_t i = 0; i < with.size(); ++i) {
    if (std::isnan(with[i]) && std::isnan(without[i])) continue;
    const double change = std::abs(with[i] - without[i]);
    if (std::isnan(change)) return std::numeric_limits<double>::infinity();
    largest = std::max(largest, change);
  }
  return largest;
}

std::vector<SkipRow> measure_skips(const BridgeFile& bridge, const std::string& scenes) {
  BuildRequest request;
  request.bridge = bridge;
  request.scenes = scenes;
  request.threads = 1;
  request.known_bridge = true;  // what is uncertain is derived from solved scenes, whatever solved them
  std::vector<SkipRow> rows;
  for (const BuildSwitch& each : build_switches()) {
    BuildRequest changed = request;
    DynamicSettings motion;
    each.switch_off(changed.rules, motion.skips);
    const Built with = build(request, quasi_static());
    rows.push_back(
        compare(std::string(each.name), with, build(changed, quasi_static(motion)), each.largest_change));
  }
  BuildRequest no_fields = request;
  no_fields.fields = KeepField::no;
  const Built with = build(request, quasi_static());
  rows.push_back(compare("fields (--fields none)", build(no_fields, quasi_static()), with, 0.0));
  return rows;
}

std::string to_markdown(const std::vector<SkipRow>& rows) {
  std::string text =
      "| skip | ms a scene with | without | gain | largest change [m] | stated bound [m] | other outcomes |\n"
      "|---|---|---|---|---|---|---|\n";
  for (const SkipRow& row : rows)
    text +=
        fmt::format("| {} | {:.2f} | {:.2f} | {:.2f} x | {:.1e} | {:.0e} | {} |\n", row.name,
                    1e3 * row.seconds_with, 1e3 * row.seconds_without, row.seconds_without / row.seconds_with,
                    row.largest_change, row.stated_change, row.other_outcomes);
  return text;
}

}  // namespace voussoir
