#include "tools/trials/trial_series.h"

#include <oneapi/tbb/parallel_for.h>

namespace voussoir {
namespace {

/// A question and its right answer.
struct Question {
  std::size_t bridge = 0;
  Shown shown;
  std::size_t truth = 0;  ///< row in the database
};

Shown shown_of(const TrueBridge& bridge, const TrueScene& scene, ReadingsTaken taken) {
  if (is_loaded(taken)) return {bridge.added, scene.added};
  return {bridge.intact, taken == ReadingsTaken::absolute ? scene.built : scene.lost};
}

Shown shown_of(const IntactBridge& bridge, ReadingsTaken taken) {
  if (is_loaded(taken)) return {bridge.added_before, bridge.added_after};
  return {bridge.before, bridge.after};
}

std::vector<Trial> ask_all(const Asking& asking, const std::vector<Question>& questions,
                           const Taking& taking) {
  std::vector<Trial> trials(questions.size());
  tbb::parallel_for(std::size_t{0}, questions.size(), [&](std::size_t i) {
    Random random(series_seed(taking.seed, i));
    trials[i] =
        ask(asking, take_readings(questions[i].shown, taking.taken, taking.sigma, random, taking.load),
            questions[i].truth);
    trials[i].bridge = questions[i].bridge;
  });
  return trials;
}

}  // namespace

std::vector<Trial> look_for_damage(const Asking& asking, const std::vector<TrueBridge>& bridges, int missing,
                                   const Taking& taking) {
  std::vector<Question> questions;
  for (std::size_t b = 0; b < bridges.size(); ++b) {
    std::size_t number = b;  // so that bridges begin with different scenes
    for (const TrueScene& scene : bridges[b].damaged) {
      const auto row = asking.database.find(scene.scene);
      if (scene.scene.missing() != missing || !row || number++ % taking.every != 0) continue;
      questions.push_back({b, shown_of(bridges[b], scene, taking.taken), *row});
    }
  }
  return ask_all(asking, questions, taking);
}

std::vector<Trial> look_at_intact(const Asking& asking, const std::vector<IntactBridge>& bridges,
                                  const Taking& taking) {
  const std::size_t truth = asking.database.find(Scene{}).value();
  std::vector<Question> questions;
  for (std::size_t b = 0; b < bridges.size(); ++b)
    questions.push_back({b, shown_of(bridges[b], taking.taken), truth});
  return ask_all(asking, questions, taking);
}

}  // namespace voussoir
