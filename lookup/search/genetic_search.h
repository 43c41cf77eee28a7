#pragma once
/// @file The paper's genetic algorithm, with the database in place of a simulation for each candidate.

#include <cstdint>
#include <span>
#include <vector>

#include "core/random.h"
#include "core/structure/block_layout.h"
#include "database/records/database.h"
#include "lookup/search/scored_row.h"

namespace voussoir {

/// The paper's settings (section 4): population 50, crossover 0.8, mutation 0.7.
struct GeneticSettings {
  int population = 50;
  double crossover = 0.8;
  double mutation = 0.7;
  int most_generations = 400;
  std::uint64_t seed = 1;
};

/// All scenes with a number of missing blocks, as genes see them.
class GeneSpace {
 public:
  GeneSpace(const BlockLayout& layout, const SceneTable& table);

  int courses() const { return static_cast<int>(courses_.size()); }  ///< the arch (0) included
  int positions(int course) const {
    return static_cast<int>(courses_[static_cast<std::size_t>(course)].size());
  }

  /// The table's row of the scene that lacks the blocks (x1, x2), (x3, x4)..., or `none`: blocks named twice,
  /// scenes that are not in the database, unresolved scenes. One to three blocks.
  std::size_t row(std::span<const int> genes) const;
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

 private:
  std::size_t row_of(std::span<const std::int32_t> blocks) const;

  SceneTable table_;
  std::vector<std::vector<BlockId>> courses_;
  std::size_t blocks_ = 0;
  // (blocks + 1)^2; the last index means "no block". Of scenes that lack the two, and the first of those that
  // lack a third behind them.
  std::vector<std::uint32_t> row_of_pair_, first_triple_;
};

/// Changes the genes (course, position) of a block: half of the time one of them by one or two, the other
/// half both to anything.
void mutate_block(std::span<int, 2> block, const GeneSpace& space, Random& random);

struct GeneticResult {
  std::vector<ScoredRow> best;  ///< the best scenes seen, best first
  int generations = 0;          ///< run
  int converged = 0;            ///< the generation in which the best scene appeared, from 1
  std::size_t evaluations = 0;  ///< misfits computed (each scene once)
};

/// Minimises the paper's Eq. 1 over integer genes (x1, x2[, x3, x4[, x5, x6]]). Each generation keeps its
/// best member, chooses parents by tournaments of two, exchanges whole blocks between them, and moves a block
/// to a neighbouring or to any position. Reproducible for a seed. Throws
/// InputError for more than three missing blocks; precondition: at least one.
GeneticResult genetic_search(std::span<const double> readings, const SceneTable& table,
                             const GeneSpace& space, int missing, const GeneticSettings& settings,
                             std::size_t count);

}  // namespace voussoir
