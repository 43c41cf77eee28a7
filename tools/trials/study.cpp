#include "tools/trials/study.h"

#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <chrono>

namespace voussoir {
namespace {

/// Who is looked for among whom.
struct LookFor {
  const char* name;
  int missing;     ///< blocks of the truth
  bool among_all;  ///< else among scenes with as many missing blocks
};

constexpr std::array kLookFor = {LookFor{"singles among singles", 1, false},
                                 LookFor{"singles among all", 1, true},
                                 LookFor{"pairs among pairs", 2, false}, LookFor{"pairs among all", 2, true}};

Asking asking_for(const Database& database, const SensorList& sensors, const LookFor& search,
                  const StudySettings& settings, bool known_bridge) {
  Asking asking{database, sensors, {}, known_bridge, settings.sampled};
  if (!known_bridge) asking.lookup.conditions = settings.conditions;
  if (!search.among_all) asking.lookup.prior.missing = {search.missing};
  return asking;
}

using Trials = std::function<std::vector<Trial>(const Asking&, const Taking&)>;

/// One row; nothing if there was no trial.
void run_row(StudyRow row, const Asking& asking, const Taking& taking, const Trials& trials,
             const RowDone& done, std::vector<StudyRow>& rows) {
  const auto started = std::chrono::steady_clock::now();
  const std::vector<Trial> results = trials(asking, taking);
  if (results.empty()) return;
  const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - started;
  row.milliseconds =
      time.count() * tbb::this_task_arena::max_concurrency() / static_cast<double>(results.size());
  row.rates = rates_of(results);
  done(row);
  rows.push_back(std::move(row));
}

/// Of so many scenes one is looked for.
std::size_t every_of(const LookFor& search, const StudySettings& settings) {
  if (search.missing != 1) return 1;
  return search.among_all ? settings.every_all : settings.every;
}

void run_search(const Database& database, const std::string& truth, const LookFor& search,
                const StudySettings& settings, const Trials& trials, const RowDone& done,
                std::vector<StudyRow>& rows) {
  const SensorList sensors = control_point_sensors(database.control_points());
  for (const ReadingsTaken taken : all_taken(settings))
    for (const double sigma : settings.sigmas)
      for (const bool known_bridge : {true, false}) {
        if (known_bridge && taken == ReadingsTaken::two_epochs)
          continue;  // the first teaches nothing: a change
        run_row({truth, search.name, taken, sigma, known_bridge, {}},
                asking_for(database, sensors, search, settings, known_bridge),
                {taken, sigma, settings.seed, every_of(search, settings), settings.load}, trials, done, rows);
      }
}

}  // namespace

std::vector<ReadingsTaken> all_taken(const StudySettings& settings) {
  if (!settings.load.empty()) return {ReadingsTaken::load_change, ReadingsTaken::load};
  return {ReadingsTaken::change, ReadingsTaken::two_epochs, ReadingsTaken::absolute};
}

std::vector<StudyRow> study_damaged(const Database& database, const DamagedTruth& truth,
                                    const StudySettings& settings, const RowDone& done) {
  std::vector<StudyRow> rows;
  for (const LookFor& search : kLookFor)
    run_search(
        database, truth.name, search, settings,
        [&](const Asking& asking, const Taking& taking) {
          return look_for_damage(asking, truth.bridges, search.missing, taking);
        },
        done, rows);
  return rows;
}

std::vector<StudyRow> study_intact(const Database& database, const IntactTruth& truth,
                                   const StudySettings& settings, const RowDone& done) {
  std::vector<StudyRow> rows;
  run_search(
      database, truth.name, {"intact", 0, true}, settings,
      [&](const Asking& asking, const Taking& taking) {
        return look_at_intact(asking, truth.bridges, taking);
      },
      done, rows);
  return rows;
}

}  // namespace voussoir
