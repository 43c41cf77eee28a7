#include "tools/benchmarks/irregular.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "core/error.h"
#include "core/text_file.h"
#include "tools/trials/sampled_truth.h"
#include "tools/trials/study_report.h"

namespace voussoir {
namespace {

// Of the true bridges; no database draws with these what it knows.
constexpr std::uint64_t kDamagedSeed = 2611, kPairsSeed = 2612, kIntactSeed = 2613;
constexpr int kPairs = 20;
constexpr double kScatter = 0.2;      // of the joints of intact bridges
constexpr double kWarmer = 20.0;      // [K]
constexpr double kSunny = 5.0;        // [K]
constexpr double kSettlement = 1e-3;  // [m]
constexpr double kSofter = 0.9;       // of the joints' stiffness

/// All trials of one run.
struct Run {
  const Database& database;
  const IrregularOptions& options;
  BridgeFile bridge;
  StudySource source;
  std::vector<StudyRow> rows{};

  bool wants(const std::string& kind) const { return kind.find(options.kind) != std::string::npos; }

  /// `taken`: one of so many scenes has been solved.
  void damaged(const DamagedTruth& truth, std::size_t taken = 1) {
    StudySettings settings = options.settings;
    settings.every = std::max<std::size_t>(1, settings.every / taken);
    settings.every_all = std::max<std::size_t>(1, settings.every_all / taken);
    source.truths.push_back(truth.name);
    append(study_damaged(database, truth, settings, show));
  }
  void intact(const IntactTruth& truth) {
    source.truths.push_back(truth.name);
    append(study_intact(database, truth, options.settings, show));
  }

 private:
  static void show(const StudyRow& row) {
    fmt::print("{}", to_text(row));
    std::fflush(stdout);
  }
  void append(std::vector<StudyRow>&& more) {
    rows.insert(rows.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  }
};

void try_given(Run& run) {
  for (const std::string& truth : run.options.truths)
    run.damaged({std::filesystem::path(truth).stem().string(),
                 read_true_bridges(Database::open(truth), run.options.settings.load)});
}

/// Scattered joints, and all that the bridge file says is uncertain, with blocks missing.
void try_damaged(Run& run) {
  const IrregularOptions& options = run.options;
  const BlockLayout& layout = run.database.layout();
  const auto damaged = [&](const std::string& name, const Uncertainty& uncertainty, std::uint64_t seed,
                           const std::string& scenes) {
    if (run.wants(name))
      run.damaged(solve_damaged(run.bridge, {name, uncertainty, options.bridges, seed, options.settings.load},
                                scenes, options.folder));
  };
  for (const double scatter : options.scatters)
    damaged(fmt::format("joints {}", scatter), scattered_joints(scatter), kDamagedSeed, wall_singles(layout));
  damaged("everything", run.bridge.description.uncertainty, kDamagedSeed, wall_singles(layout));
  const SampledTruth in_epochs{"everything, epochs too", run.bridge.description.uncertainty, options.bridges,
                               kDamagedSeed, options.settings.load};
  if (run.wants(in_epochs.name))
    run.damaged(solve_lost_between(run.bridge.description, in_epochs, {.at_random = true},
                                   wall_blocks(layout), options.settings.every),
                options.settings.every);
  damaged(fmt::format("joints {} pairs", kScatter), scattered_joints(kScatter), kPairsSeed,
          random_pairs(layout, kPairs, kPairsSeed));
}

/// The same, intact at two times.
void try_intact(Run& run) {
  const IrregularOptions& options = run.options;
  const auto intact = [&](const std::string& name, const Uncertainty& uncertainty, const Between& between) {
    if (run.wants(name))
      run.intact(solve_intact(run.bridge.description,
                              {name, uncertainty, options.intact_bridges, kIntactSeed, options.settings.load},
                              between));
  };
  for (const double scatter : options.scatters)
    intact(fmt::format("joints {}", scatter), scattered_joints(scatter), {});
  intact("parts softer and stiffer", scattered_joints(kScatter, kScatter), {});
  intact("20 K warmer", scattered_joints(kScatter), {.warmer = kWarmer});
  intact("left half 5 K warmer", scattered_joints(kScatter), {.warmer = kSunny, .warmer_part = 0.5});
  intact("foot 1 mm lower", scattered_joints(kScatter), {.settlement = kSettlement});
  intact("joints a tenth softer", scattered_joints(kScatter), {.joint_stiffness = kSofter});
  intact("left half a tenth softer", scattered_joints(kScatter),
         {.joint_stiffness = kSofter, .softened_part = 0.5});
  intact("everything", run.bridge.description.uncertainty, {.at_random = true});
}

}  // namespace

std::string benchmark_irregular(const std::filesystem::path& path, IrregularOptions options) {
  const Database database = Database::open(path);
  options.settings.sampled = sampled_bridges(database, options.evidence);
  Run run{database,
          options,
          parse_bridge_file(database.bridge_text(), database.bridge_name()),
          {path.string(), database.digest(), database.bridge_name(), {}, options.settings}};
  fmt::print("{}", heading_text());
  if (!options.truths.empty())
    try_given(run);
  else if (!options.intact_only)
    try_damaged(run);
  if (options.truths.empty()) try_intact(run);
  if (!options.json.empty()) write_file(options.json, to_json(run.source, run.rows));
  if (!options.page.empty()) write_file(options.page, to_page(run.source, run.rows));
  return reliability_text(run.rows);
}

}  // namespace voussoir
