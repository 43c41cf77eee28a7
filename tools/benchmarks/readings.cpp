#include "tools/benchmarks/readings.h"

#include <oneapi/tbb/parallel_for.h>

#include <optional>

#include "lookup/evidence/evidence_screen.h"
#include "lookup/readings/simulate.h"

namespace voussoir {
namespace {

constexpr double kCalledDamaged = 0.5;

std::optional<std::size_t> standing_row(const Library& library, const Scene& scene) {
  const auto row = library.table.find(scene);
  return row && library.table.stands(*row) ? row : std::nullopt;
}

Comparison take_readings(const TwoBridges& bridges, std::size_t true_row, const Instrument& instrument,
                         Random& random) {
  const std::span<const double> truth = bridges.truth.table.row(true_row);
  const bool absolute = instrument.kind == ReadingKind::absolute;
  Measurements measured;
  if (absolute) {
    measured = simulate_readings(truth, instrument.noise, random);
  } else {
    const std::span<const double> true_intact = bridges.truth.table.row(0);
    const std::span<const double> intact = bridges.library.table.row(0);
    std::vector<double> readings(truth.begin(), truth.end());
    for (std::size_t i = 0; i < readings.size(); ++i)
      readings[i] += intact[i] - true_intact[i] + instrument.noise.floor * random.gaussian();
    measured = as_measurements(readings);
    measured.sigma.assign(readings.size(), instrument.noise.floor);
  }
  return {.kind = instrument.kind,
          .library = bridges.library,
          .measured = std::move(measured),
          .model_error = bridges.model_error};
}

/// The noise as the lookup is told of it.
NoiseModel told(const Instrument& instrument) {
  NoiseModel noise = instrument.noise;
  if (instrument.kind != ReadingKind::absolute) noise = {};
  if (!instrument.level_told) noise = {};
  return noise;
}

void count(const Posterior& posterior, std::size_t truth, Rates& rates) {
  count_posterior(truth, posterior, rates.success);
  rates.damaged += posterior.missing_probability.front() < 1.0 - kCalledDamaged ? 1 : 0;
}

double predictive_chance(const Observation& observation, const Library& library, const Posterior& posterior) {
  if (posterior.credible.empty()) return 0.0;
  const std::span<const double> best = library.table.row(posterior.credible.front());
  return check_fit(observation, estimate_noise(observation, best), best).chance;
}

Rates look_up(const TwoBridges& bridges, const Scene& scene, const Eligible& eligible, const Prior& prior,
              const Instrument& instrument, int times, std::uint64_t seed) {
  Rates rates;
  const auto true_row = standing_row(bridges.truth, scene);
  const auto row = standing_row(bridges.library, scene);
  if (!true_row || !row) return rates;
  const EvidenceScreen screen(bridges.library.table, bridges.library.index, eligible, prior);
  Random random(seed);
  for (int i = 0; i < times; ++i) {
    const Observation observation =
        observe(take_readings(bridges, *true_row, instrument, random), told(instrument));
    const Posterior answer =
        posterior(bridges.library.table, eligible, screen(observation), prior, bridges.library.layout.size());
    count(answer, *row, rates);
    rates.chances.push_back(predictive_chance(observation, bridges.library, answer));
  }
  return rates;
}

}  // namespace

Rates find_again(const TwoBridges& bridges, const std::vector<Scene>& scenes, const Prior& prior,
                 const Instrument& instrument, int times, std::uint64_t seed) {
  const Prior stated = stated_prior(prior, bridges.library.table, true);
  const Eligible eligible = eligible_rows(bridges.library.table, stated.missing);
  std::vector<Rates> parts(scenes.size());
  tbb::parallel_for(std::size_t{0}, scenes.size(), [&](std::size_t i) {
    parts[i] = look_up(bridges, scenes[i], eligible, stated, instrument, times, seed + i);
  });
  Rates sum;
  for (const Rates& part : parts) {
    sum.success.trials += part.success.trials;
    sum.success.first += part.success.first;
    sum.success.in_five += part.success.in_five;
    sum.success.in_credible += part.success.in_credible;
    sum.success.in_exact += part.success.in_exact;
    sum.damaged += part.damaged;
    sum.chances.insert(sum.chances.end(), part.chances.begin(), part.chances.end());
  }
  return sum;
}

std::vector<Scene> standing_singles(const TwoBridges& bridges) {
  std::vector<Scene> singles;
  for (std::size_t b = 0; b < bridges.library.layout.size(); ++b) {
    const Scene single{{BlockId{static_cast<std::int32_t>(b)}}};
    if (standing_row(bridges.library, single) && standing_row(bridges.truth, single))
      singles.push_back(single);
  }
  return singles;
}

}  // namespace voussoir
