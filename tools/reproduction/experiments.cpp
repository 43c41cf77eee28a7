#include "tools/reproduction/experiments.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <functional>

#include "lookup/readings/simulate.h"

namespace voussoir {
namespace {

constexpr int kNoiseLevels = 21;      // 0, 1, .. 20 %
constexpr int kOperatingLevels = 11;  // 0, 2, .. 20 %
constexpr double kHighestNoise = 0.20;
constexpr double kSmallestTold = 1e-4;  // a known noise of zero is told as this: rounding
constexpr int kTrialsABlock = 5;

/// The noise of the paper: uniform, relative, all sensors read.
NoiseModel paper_noise(double level) {
  NoiseModel noise{NoiseShape::uniform, level};
  noise.silence = 0.0;
  return noise;
}

/// Each result from its own task, in the tasks' order.
template <typename Result>
std::vector<Result> in_parallel(std::size_t tasks, const std::function<Result(std::size_t)>& task) {
  std::vector<Result> results(tasks);
  tbb::parallel_for(std::size_t{0}, tasks, [&](std::size_t i) { results[i] = task(i); });
  return results;
}

/// Looks readings up among scenes with as many missing blocks as the truth has.
class Trial {
 public:
  Trial(const Library& library, int missing)
      : library_(library), prior_{{missing}, {}}, eligible_(eligible_rows(library.table, prior_.missing)) {}

  const Eligible& eligible() const { return eligible_; }

  Measurements measure(std::size_t truth, double noise, Random& random) const {
    return simulate_readings(library_.table.row(truth), paper_noise(noise), random);
  }
  std::vector<ScoredRow> by_misfit(const Measurements& measured) const {
    return best_by_misfit(library_, measured, eligible_);
  }
  Posterior knowing(const Measurements& measured, double noise) const {
    return posterior_of(library_, measured, eligible_, paper_noise(std::max(noise, kSmallestTold)), prior_);
  }
  Posterior knowing_nothing(const Measurements& measured) const {
    return posterior_of(library_, measured, eligible_, {}, prior_);
  }

 private:
  Library library_;
  Prior prior_;
  Eligible eligible_;
};

std::vector<std::size_t> standing_rows(const SceneTable& table, const Eligible& eligible) {
  std::vector<std::size_t> rows;
  for (const std::size_t row : eligible.rows)
    if (table.stands(row)) rows.push_back(row);
  return rows;
}

std::size_t any_of(const std::vector<std::size_t>& rows, Random& random) {
  return rows[random.below(static_cast<std::uint32_t>(rows.size()))];
}

OperatingPoint operating_point(const Subject& subject, const Trial& trial,
                               const std::vector<std::size_t>& truths, double noise) {
  OperatingPoint point{noise, {}, {}, {}};
  Random scenes(subject.settings.seed);
  Random errors(subject.settings.seed + 1);
  for (int i = 0; i < subject.settings.random_scenes; ++i) {
    const std::size_t truth = any_of(truths, scenes);
    const Measurements measured = trial.measure(truth, noise, errors);
    count_misfit(truth, trial.by_misfit(measured), point.misfit);
    count_posterior(truth, trial.knowing(measured, noise), point.known);
    count_posterior(truth, trial.knowing_nothing(measured), point.unknown);
  }
  return point;
}

/// The arch block of a scene, if it lacks one.
std::optional<BlockId> arch_block(const Scene& scene, const BlockLayout& layout) {
  for (const BlockId id : scene.removed)
    if (layout[id].role == BlockRole::ring) return id;
  return std::nullopt;
}

}  // namespace

std::vector<CaseResult> run_cases(const Subject& subject, const std::vector<PaperCase>& cases) {
  return in_parallel<CaseResult>(cases.size(), [&](std::size_t i) {
    const bool pair = cases[i].scene.find('+') != std::string::npos;
    return run_case(pair ? subject.all() : subject.one_block(), cases[i], subject.settings.trials,
                    subject.settings.seed);
  });
}

std::vector<GenerationsAtNoise> generations_against_noise(const Subject& subject) {
  const Library library = subject.one_block();
  const GeneSpace space(library.layout, library.table);
  const std::size_t truth = row_of(library, subject.cases.example.scene);
  return in_parallel<GenerationsAtNoise>(kNoiseLevels, [&](std::size_t level) {
    GenerationsAtNoise result{kHighestNoise * static_cast<double>(level) / (kNoiseLevels - 1),
                              subject.settings.trials};
    for (int trial = 0; trial < result.seeds; ++trial) {
      Random random(subject.settings.seed + static_cast<std::uint64_t>(trial));
      const Measurements measured =
          simulate_readings(library.table.row(truth), paper_noise(result.noise), random);
      GeneticSettings settings;
      settings.seed = subject.settings.seed + static_cast<std::uint64_t>(trial);
      const GeneticResult run = genetic_search(measured.displacement, library.table, space, 1, settings, 1);
      if (run.best.front().row == truth) result.generations.push_back(run.converged);
    }
    std::sort(result.generations.begin(), result.generations.end());
    return result;
  });
}

std::vector<OperatingPoint> operating_curve(const Subject& subject, int missing) {
  const Library library = missing <= 1 ? subject.one_block() : subject.all();
  const Trial trial(library, missing);
  const std::vector<std::size_t> truths = standing_rows(library.table, trial.eligible());
  return in_parallel<OperatingPoint>(kOperatingLevels, [&](std::size_t level) {
    return operating_point(subject, trial, truths,
                           kHighestNoise * static_cast<double>(level) / (kOperatingLevels - 1));
  });
}

std::vector<CourseSuccess> success_by_course(const Subject& subject) {
  const Library library = subject.one_block();
  const Trial trial(library, 1);
  const std::vector<std::size_t> truths = standing_rows(library.table, trial.eligible());
  const int courses = library.layout.blocks.back().index.course;
  return in_parallel<CourseSuccess>(static_cast<std::size_t>(courses), [&](std::size_t i) {
    CourseSuccess result{static_cast<int>(i) + 1, {}, {}};
    Random random(subject.settings.seed + i);
    for (const std::size_t truth : truths) {
      if (library.layout[library.table.scene(truth).removed.front()].index.course != result.course) continue;
      for (int repeat = 0; repeat < kTrialsABlock; ++repeat) {
        const Measurements measured = trial.measure(truth, kComparedNoise, random);
        count_misfit(truth, trial.by_misfit(measured), result.misfit);
        count_posterior(truth, trial.knowing(measured, kComparedNoise), result.known);
      }
    }
    return result;
  });
}

PairSuccess success_of_pairs(const Subject& subject, bool with_arch_block) {
  const Library library = subject.all();
  const Trial trial(library, 2);
  std::vector<std::size_t> truths;
  for (const std::size_t row : trial.eligible().rows)
    if (arch_block(library.table.scene(row), library.layout).has_value() == with_arch_block)
      truths.push_back(row);
  PairSuccess result;
  Random random(subject.settings.seed);
  for (int i = 0; i < subject.settings.random_scenes; ++i) {
    const std::size_t truth = any_of(truths, random);
    const Measurements measured = trial.measure(truth, kComparedNoise, random);
    const std::vector<ScoredRow> best = trial.by_misfit(measured);
    count_misfit(truth, best, result.misfit);
    count_posterior(truth, trial.knowing(measured, kComparedNoise), result.known);
    const auto arch = arch_block(library.table.scene(truth), library.layout);
    if (arch && library.table.scene(best.front().row).lacks(*arch)) ++result.arch_block_found;
  }
  return result;
}

}  // namespace voussoir
