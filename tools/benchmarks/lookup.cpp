#include "tools/benchmarks/lookup.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "lookup/evidence/evidence_screen.h"
#include "lookup/readings/simulate.h"
#include "lookup/search/exhaustive_search.h"
#include "lookup/search/indexed_search.h"
#include "lookup/search/nearest_search.h"
#include "tools/trials/random_truth.h"

namespace voussoir {
namespace {

constexpr std::size_t kTop = 10;
constexpr double kLowestLevel = 0.01;
constexpr double kHighestLevel = 0.10;

/// Times a function for each query; `prepare(i)` is called before and not timed.
template <typename Prepare, typename Function>
Timing timed(const std::string& name, std::size_t queries, Prepare prepare, Function function) {
  std::vector<double> milliseconds;
  for (std::size_t i = 0; i < queries; ++i) {
    prepare(i);
    const auto start = std::chrono::steady_clock::now();
    function(i);
    milliseconds.push_back(
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  return timing_of(name, std::move(milliseconds));
}
template <typename Function>
Timing timed(const std::string& name, std::size_t queries, Function function) {
  return timed(
      name, queries, [](std::size_t) {}, function);
}

struct Query {
  std::size_t truth = 0;
  double level = 0.0;
  Measurements measured;
};

std::vector<Query> make_queries(const SceneTable& table, const LookupQueries& asked) {
  std::vector<Eligible> by_missing;
  for (const int missing : numbers_of_missing(table)) by_missing.push_back(eligible_rows(table, {missing}));
  Random random(asked.seed);
  std::vector<Query> queries;
  for (int i = 0; i < asked.count; ++i) {
    const std::size_t truth =
        random_truth(by_missing[static_cast<std::size_t>(i) % by_missing.size()], random);
    const double even = kLowestLevel + (kHighestLevel - kLowestLevel) * random.uniform();
    NoiseModel noise{NoiseShape::uniform, asked.level.value_or(even)};
    noise.silence = 0.0;
    queries.push_back({truth, *noise.relative, simulate_readings(table.row(truth), noise, random)});
  }
  return queries;
}

using Found = std::vector<std::vector<ScoredRow>>;  // of each query

/// Of a scan, which says what the others have to find, and of the search index.
Found time_exact_searches(const Library& library, const std::vector<Query>& queries, const Eligible& eligible,
                          LookupTimings& timings) {
  const SceneTable& table = library.table;
  const IndexedSearch indexed(table, library.index, library.points, eligible);
  Found scan(queries.size());
  timings.searches.push_back(timed("scan of all rows, vectorised", queries.size(), [&](std::size_t i) {
    scan[i] = exhaustive_search(queries[i].measured.displacement, table, eligible.rows, kTop);
  }));
  timings.searches.push_back(timed("search index, exact", queries.size(), [&](std::size_t i) {
    if (indexed.search(queries[i].measured.displacement, kTop).best != scan[i]) ++timings.disagreements;
  }));
  return scan;
}

/// FLANN's index covers the points with readings, which are fewer where the scene lacks a block with points.
void time_flann(const Library& library, const std::vector<Query>& queries, const Eligible& eligible,
                const Found& scan, LookupTimings& timings) {
  std::unique_ptr<LinearIndex> linear;
  std::vector<bool> covered;
  const auto cover = [&](std::size_t i) {
    std::vector<bool> points;
    for (const double value : queries[i].measured.displacement) points.push_back(!std::isnan(value));
    if (points == covered) return;
    linear = std::make_unique<LinearIndex>(library.table, eligible.rows, queries[i].measured.displacement);
    linear->search(queries[i].measured.displacement, kTop);  // with its rows in the cache, as far as they fit
    covered = points;
  };
  timings.searches.push_back(timed("FLANN linear, L1", queries.size(), cover, [&](std::size_t i) {
    if (linear->search(queries[i].measured.displacement, kTop) != scan[i]) ++timings.disagreements;
  }));
}

Observation observed(const Library& library, const Query& query, bool stated) {
  return observe(absolute_readings(library, query.measured),
                 stated ? NoiseModel{NoiseShape::uniform, query.level} : NoiseModel{});
}
std::string noise_of(bool stated) {
  return stated ? "uniform noise, stated" : "noise unknown (default)";
}

void time_posteriors(const Library& library, const std::vector<Query>& queries, const Eligible& eligible,
                     LookupTimings& timings) {
  const SceneTable& table = library.table;
  const Prior prior = stated_prior({}, table, true);
  const EvidenceScreen screen(table, library.index, eligible, prior);
  const auto posterior_of = [&](const RowValues& evidence) {
    return posterior(table, eligible, evidence, prior, library.layout.size());
  };
  for (const bool stated : {true, false}) {
    std::vector<Posterior> exact(queries.size()), screened(queries.size());
    timings.posteriors.push_back(timed("every row, " + noise_of(stated), queries.size(), [&](std::size_t i) {
      exact[i] =
          posterior_of(log_evidence_of_rows(observed(library, queries[i], stated), table, eligible.rows));
    }));
    timings.posteriors.push_back(timed("screened, " + noise_of(stated), queries.size(), [&](std::size_t i) {
      screened[i] = posterior_of(screen(observed(library, queries[i], stated)));
    }));
    for (std::size_t i = 0; i < queries.size(); ++i)
      for (std::size_t row = 0; row < table.rows; ++row)
        timings.largest_difference = std::max(
            timings.largest_difference, std::abs(screened[i].probability[row] - exact[i].probability[row]));
  }
}

void time_screened_posteriors(const Library& library, const std::vector<Query>& queries,
                              const Eligible& eligible, LookupTimings& timings) {
  const Prior prior = stated_prior({}, library.table, true);
  const EvidenceScreen screen(library.table, library.index, eligible, prior);
  timings.posteriors.push_back(timed("screened, " + noise_of(true), queries.size(), [&](std::size_t i) {
    posterior(library.table, eligible, screen(observed(library, queries[i], true)), prior,
              library.layout.size());
  }));
}

void time_genetic(const Library& library, const std::vector<Query>& queries, LookupTimings& timings) {
  const GeneSpace space(library.layout, library.table);
  for (const int missing : {1, 2})
    timings.genetic.push_back(timed(missing == 1 ? "genetic search, one block" : "genetic search, two blocks",
                                    queries.size(), [&](std::size_t i) {
                                      GeneticSettings settings;
                                      settings.seed = i + 1;
                                      genetic_search(queries[i].measured.displacement, library.table, space,
                                                     missing, settings, kTop);
                                    }));
}

}  // namespace

LookupTimings time_lookups(const Library& library, const LookupQueries& asked) {
  const std::vector<Query> queries = make_queries(library.table, asked);
  const Eligible eligible = eligible_rows(library.table, numbers_of_missing(library.table));
  LookupTimings timings;
  const Found scan = time_exact_searches(library, queries, eligible, timings);
  time_flann(library, queries, eligible, scan, timings);
  time_posteriors(library, queries, eligible, timings);
  time_genetic(library, queries, timings);
  return timings;
}

LookupTimings time_lookups_of_triples(const Library& library, const LookupQueries& asked) {
  const std::vector<Query> queries = make_queries(library.table, asked);
  const Eligible eligible = eligible_rows(library.table, numbers_of_missing(library.table));
  LookupTimings timings;
  time_exact_searches(library, queries, eligible, timings);
  time_screened_posteriors(library, queries, eligible, timings);
  return timings;
}

}  // namespace voussoir
