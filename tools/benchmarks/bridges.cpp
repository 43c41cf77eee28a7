#include "tools/benchmarks/bridges.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/motion/dynamic_solver.h"
#include "core/random.h"
#include "tools/benchmarks/default_build.h"
#include "tools/benchmarks/timing.h"
#include "tools/validation/random_bridge.h"

namespace voussoir {
namespace {

constexpr std::size_t kTogether = 16;  // scenes handed over at a time
constexpr std::size_t kMostNamed = 5;  // unresolved scenes in the table
constexpr int kBeside = 5;             // bridges between two measurements of the reference
constexpr double kLongest = 10.0;      // [s] of a bridge's own time that a scene is followed

std::vector<Scene> drawn_scenes(const Model& model, int count, std::uint64_t seed) {
  std::vector<Scene> scenes = all_scenes(static_cast<std::size_t>(model.block_count()), 1);
  if (count == 0) return scenes;
  Random random(seed);
  for (std::size_t i = 1; i + 1 < scenes.size(); ++i)  // a shuffle that leaves the intact bridge first
    std::swap(scenes[i], scenes[i + random.below(static_cast<std::uint32_t>(scenes.size() - i))]);
  scenes.resize(std::min(scenes.size(), static_cast<std::size_t>(count) + 1));
  return scenes;
}

void count(const std::vector<Solution>& solutions, std::span<const Scene> scenes, const BlockLayout& layout,
           BridgeRow& row) {
  for (std::size_t i = 0; i < solutions.size(); ++i) {
    const Outcome outcome = solutions[i].outcome;
    (outcome == Outcome::standing    ? row.standing
     : outcome == Outcome::collapsed ? row.collapsed
                                     : row.unresolved) += 1;
    if (outcome == Outcome::unresolved) row.unresolved_scenes.push_back(to_string(scenes[i], layout));
  }
}

/// The intact bridge, which comes first, alone.
std::vector<Solution> solve_group(DefaultBuild& build, std::span<const Scene> scenes) {
  if (!scenes.front().removed.empty()) return build.solve(scenes);
  return {build.solve_intact()};
}

/// The scene of a group that takes longest is looked for in the slowest group alone.
void find_worst(DefaultBuild& build, std::span<const Scene> scenes, const BlockLayout& layout,
                BridgeRow& row) {
  for (const Scene& scene : scenes) {
    const double begin = processor_seconds();
    solve_group(build, std::span(&scene, 1));
    const double seconds = processor_seconds() - begin;
    if (seconds <= row.worst) continue;
    row.worst = seconds;
    row.worst_scene = to_string(scene, layout);
  }
}

/// Until what moves rests or is far away.
DecisionRules until_it_rests_or_is_gone() {
  DecisionRules rules = far_fall_rules(patient_rules(DecisionRules{}));
  rules.latest_decision = kLongest;
  rules.freer_until = rules.freer_from;  // what friction holds is not to be shaken loose
  return rules;
}

/// The independent answer, whose steps are hundreds of times shorter.
void follow(const Model& model, std::span<const Scene> scenes, std::span<const Outcome> outcomes,
            BridgeRow& row) {
  DynamicSettings plain;
  plain.integrator = Integrator::central_differences;
  const std::vector<DynamicSolution> followed =
      DynamicSolver(model, plain).solve(scenes, until_it_rests_or_is_gone());
  row.followed = static_cast<int>(followed.size());
  for (std::size_t i = 0; i < followed.size(); ++i) {
    const Outcome there = followed[i].solution.outcome;
    if (there != outcomes[i])
      row.otherwise.push_back(fmt::format("{}: {}, in motion {}", to_string(scenes[i], model.layout),
                                          to_string(outcomes[i]), to_string(there)));
  }
}

BridgeRow measure(const BridgeDescription& description, const BridgeOptions& options, std::uint64_t seed) {
  const Model model = make_model(description);
  DefaultBuild build(description, model);
  const std::vector<Scene> scenes = drawn_scenes(model, options.scenes, seed);
  BridgeRow row{
      .name = description.name, .blocks = model.block_count(), .scenes = static_cast<int>(scenes.size())};
  std::span<const Scene> slowest;
  double longest = -1.0;
  std::vector<Outcome> outcomes;
  for (std::size_t first = 0; first < scenes.size();) {
    const std::size_t size = first == 0 ? 1 : std::min(kTogether, scenes.size() - first);
    const auto group = std::span(scenes).subspan(first, size);
    const double begin = processor_seconds();
    const std::vector<Solution> solutions = solve_group(build, group);
    const double seconds = processor_seconds() - begin;
    (first == 0 ? row.intact : row.singles) += seconds;
    count(solutions, group, model.layout, row);
    for (const Solution& solution : solutions) outcomes.push_back(solution.outcome);
    first += size;
    if (seconds > longest) {
      longest = seconds;
      slowest = group;
    }
  }
  find_worst(build, slowest, model.layout, row);
  if (row.blocks <= options.most_followed) follow(model, scenes, outcomes, row);
  return row;
}

/// Of the bridges beside the reference.
std::string summary(std::span<const BridgeRow> rows) {
  if (rows.empty()) return "";
  std::vector<double> times;
  int scenes = 0, unresolved = 0;
  for (const BridgeRow& row : rows) {
    times.push_back(row.times_the_reference());
    scenes += row.scenes;
    unresolved += row.unresolved;
  }
  std::ranges::sort(times);
  const auto within = [&](double most) { return std::ranges::upper_bound(times, most) - times.begin(); };
  return fmt::format(
      "\nOf {} bridges {} are within 4 times the reference's time a scene and block, {} within 10 times; "
      "median {:.2f}, most {:.1f}. Unresolved: {} of {} scenes.\n",
      times.size(), within(4.0), within(10.0), times[times.size() / 2], times.back(), unresolved, scenes);
}

/// Nothing if no bridge was followed.
std::string in_motion(std::span<const BridgeRow> rows) {
  int followed = 0, bridges = 0;
  std::vector<std::string> otherwise;
  for (const BridgeRow& row : rows) {
    followed += row.followed;
    bridges += row.followed > 0 ? 1 : 0;
    for (const std::string& scene : row.otherwise)
      otherwise.push_back(fmt::format("- {}, {}\n", row.name, scene));
  }
  if (followed == 0) return "";
  return fmt::format("\nIn plain explicit motion {} of {} scenes of {} bridges end as they were solved{}\n{}",
                     followed - static_cast<int>(otherwise.size()), followed, bridges,
                     otherwise.empty() ? "." : "; not:", fmt::join(otherwise, ""));
}

}  // namespace

std::vector<BridgeRow> measure_bridges(const BridgeOptions& options,
                                       const std::function<void(const BridgeRow&)>& progress) {
  std::vector<BridgeRow> rows;
  double beside = 0.0;
  const auto add = [&](BridgeRow row) {
    row.beside = beside;
    rows.push_back(std::move(row));
    progress(rows.back());
  };
  const auto measure_reference = [&] {
    BridgeRow row = measure(BridgeDescription{}, {.scenes = 0}, options.seed);
    beside = row.per_scene_and_block();
    return row;
  };
  add(measure_reference());
  for (int i = 0; i < options.bridges; ++i) {
    if (i > 0 && i % kBeside == 0) measure_reference();
    const std::uint64_t seed = options.seed + static_cast<std::uint64_t>(i);
    add(measure(random_bridge(seed), options, seed));
  }
  return rows;
}

std::string to_markdown(const std::vector<BridgeRow>& rows) {
  std::string text =
      "| bridge | blocks | scenes | standing | collapsed | unresolved | intact [ms] | ms a scene "
      "| us a scene and block | times the reference | worst scene [ms] | unresolved scenes |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const BridgeRow& row : rows) {
    std::vector<std::string> named = row.unresolved_scenes;
    if (named.size() > kMostNamed) {
      named.resize(kMostNamed);
      named.emplace_back("..");
    }
    text +=
        fmt::format("| {} | {} | {} | {} | {} | {} | {:.1f} | {:.1f} | {:.1f} | {:.2f} | {}: {:.0f} | {} |\n",
                    row.name, row.blocks, row.scenes, row.standing, row.collapsed, row.unresolved,
                    1e3 * row.intact, 1e3 * row.per_scene(), 1e6 * row.per_scene_and_block(),
                    row.times_the_reference(), row.worst_scene, 1e3 * row.worst, fmt::join(named, " "));
  }
  return text + summary(std::span(rows).subspan(1)) + in_motion(rows);
}

}  // namespace voussoir
