#pragma once
/// @file The exact posterior over all scenes of a database: the library of scenes is finite, so it is
/// enumerated.

#include <array>
#include <vector>

#include "database/records/database.h"
#include "lookup/evidence/row_values.h"
#include "lookup/evidence/scene_evidence.h"
#include "lookup/search/eligible_rows.h"

namespace voussoir {

/// What is believed before the measurement.
struct Prior {
  std::vector<int> missing = {};    ///< numbers of missing blocks that are possible; empty: stated_prior
  std::vector<double> weight = {};  ///< of each of them; empty: kIntactWeight for no block, 1 for other
                                    ///< numbers. Uniform over the scenes within each number
};

/// Of a bridge that is not exactly known, no, one, two and three missing blocks: one in a hundred times that
/// a bridge is levelled a block has gone since, of these one in ten times two, and of those one in ten times
/// a third. No published rate was found (inspection records count conditions, not blocks); a stock that lost
/// blocks more often than once in a hundred inspections would be repaired, not monitored.
/// docs/uncertainty.md says what other beliefs change.
inline constexpr std::array<double, 4> kBeliefInMissing = {1000.0, 10.0, 1.0, 0.1};

/// The prior as it is used: numbers that are not given are those that the table holds, weights that are not
/// given become kBeliefInMissing, unless the bridge is known.
Prior stated_prior(Prior prior, const SceneTable& table, bool known_bridge);

/// Readings that say nothing leave the prior as it is: with equal weights two blocks in three questions would
/// be said to be missing. Of 500 intact bridges levelled to 0.1 and 0.2 mm, equal weights call 15 and 33 %
/// damaged, these 0.5 % (docs/results.md).
inline constexpr double kIntactWeight = 8.0;

/// The weight of each of a stated prior's numbers of missing blocks. Throws InputError if the prior has not
/// as many weights as numbers.
std::vector<double> weights_of(const Prior& prior);

/// How many times as likely readings have to be without any loss as with one to speak against it.
inline constexpr double kSpokenAgainst = 10.0;

/// A single that leaves the bridge standing and that the readings do not speak against.
struct OpenLoss {
  std::size_t row = 0;
  double times_as_likely = 0.0;  ///< the readings' density beside that of the intact bridge
};

struct Posterior {
  RowValues probability;                    ///< of each row of the table; all zero if no scene is possible
  std::vector<double> block_probability;    ///< that a block is missing: sum over the scenes that lack it
  std::vector<double> missing_probability;  ///< of 0, 1, 2... missing blocks
  std::vector<std::size_t> credible;  ///< the fewest rows that hold 95 % of the probability, likeliest first
  double log_evidence = kImpossible;  ///< log of the readings' density on average over the scenes,
                                      ///< as likely as they are beforehand, but for a constant
                                      ///< that only the sensors and their errors make
  double intact_if_even = 0.0;  ///< what the probability that no block is missing would be, if that had been
                                ///< as likely beforehand as a loss that leaves the bridge standing: what the
                                ///< readings themselves say of it
  std::vector<OpenLoss> open_losses{};  ///< in the order of rows; empty if the intact bridge is impossible
};

/// Probability that no block is missing.
double intact_probability(const Posterior& posterior);

/// A probability from which on something is said for certain.
inline constexpr double kCertain = 0.9;

/// Blocks that are missing with at least this probability, likeliest first.
std::vector<BlockId> likely_blocks(const Posterior& posterior, double least);

/// Share of the probability in Posterior::credible.
inline constexpr double kCredibleShare = 0.95;

/// log prior of one scene with 0, 1, 2... missing blocks, of a stated prior, but for its SceneTable::weight:
/// its number's share of all weights over how many eligible scenes have it. Throws as weights_of, and
/// InputError if the weights leave no eligible scene possible.
std::vector<double> log_prior_by_missing(const SceneTable& table, const Eligible& eligible,
                                         const Prior& prior);

/// prior x evidence, normalised. `log_evidence` is -infinity for rows that are impossible or not eligible.
/// Throws as log_prior_by_missing.
Posterior posterior(const SceneTable& table, const Eligible& eligible, const RowValues& log_evidence,
                    const Prior& prior, std::size_t block_count);

}  // namespace voussoir
