#include "lookup/search/genetic_search.h"

#include <algorithm>
#include <array>
#include <limits>
#include <ranges>

#include "core/error.h"
#include "lookup/search/eligible_rows.h"
#include "lookup/search/misfit.h"

namespace voussoir {
namespace {

constexpr std::size_t kMostBlocks = 3;
constexpr std::uint32_t kLargestStep = 2;  // of a local mutation, in courses or positions
constexpr double kLocalMutation = 0.5;     // share of mutations that stay near; the others go anywhere
constexpr std::uint32_t kNoRow = std::numeric_limits<std::uint32_t>::max();
constexpr double kNotScored = -1.0;

/// Genes (course and position of a block) that left their range come back to its end.
void repair(std::span<int, 2> block, const GeneSpace& space) {
  block[0] = std::clamp(block[0], 0, space.courses() - 1);
  block[1] = std::clamp(block[1], 1, std::max(1, space.positions(block[0])));
}

void move_anywhere(std::span<int, 2> block, const GeneSpace& space, Random& random) {
  block[0] = static_cast<int>(random.below(static_cast<std::uint32_t>(space.courses())));
  const int positions = std::max(1, space.positions(block[0]));
  block[1] = 1 + static_cast<int>(random.below(static_cast<std::uint32_t>(positions)));
}

struct Member {
  std::array<int, 2 * kMostBlocks> genes{};  // (x1, x2), (x3, x4)..: of each missing block

  std::span<int, 2> block(std::size_t i) { return std::span(genes).subspan(2 * i).first<2>(); }
  ScoredRow score{GeneSpace::none, std::numeric_limits<double>::infinity()};
};

class Evolution {
 public:
  Evolution(std::span<const double> readings, const SceneTable& table, const GeneSpace& space, int missing,
            const GeneticSettings& settings)
      : readings_(readings),
        table_(table),
        space_(space),
        missing_(static_cast<std::size_t>(missing)),
        settings_(settings),
        random_(settings.seed),
        sums_(table.rows, kNotScored) {}

  GeneticResult run(std::size_t count) {
    std::vector<Member> population = first_generation();
    Member best = *fittest(population);
    result_.converged = 1;
    for (result_.generations = 1; result_.generations < settings_.most_generations; ++result_.generations) {
      population = next_generation(population, best);
      const auto leader = fittest(population);
      if (leader->score < best.score) result_.converged = result_.generations + 1;
      if (leader->score < best.score) best = *leader;
    }
    result_.best = best_seen(count);
    return result_;
  }

 private:
  static std::vector<Member>::const_iterator fittest(const std::vector<Member>& population) {
    return std::min_element(population.begin(), population.end(),
                            [](const Member& a, const Member& b) { return a.score < b.score; });
  }

  std::vector<Member> first_generation() {
    std::vector<Member> population(static_cast<std::size_t>(settings_.population));
    for (Member& member : population) {
      for (std::size_t i = 0; i < missing_; ++i) move_anywhere(member.block(i), space_, random_);
      score(member);
    }
    return population;
  }

  std::vector<Member> next_generation(const std::vector<Member>& parents, const Member& best) {
    std::vector<Member> children = {best};
    while (children.size() < parents.size()) {
      Member child = crossed(tournament(parents), tournament(parents));
      mutate(child);
      score(child);
      children.push_back(child);
    }
    return children;
  }

  const Member& tournament(const std::vector<Member>& members) {
    const auto size = static_cast<std::uint32_t>(members.size());
    const Member& a = members[random_.below(size)];
    const Member& b = members[random_.below(size)];
    return a.score < b.score ? a : b;
  }

  /// Each block of the child comes from either parent; a single block inherits its course and position
  /// separately.
  Member crossed(const Member& a, const Member& b) {
    if (random_.uniform() >= settings_.crossover) return a;
    Member child = a;
    if (missing_ == 1) {
      child.genes[1] = b.genes[1];
      repair(child.block(0), space_);
      return child;
    }
    for (std::size_t block = 0; block < missing_; ++block) {
      const std::size_t from = random_.below(static_cast<std::uint32_t>(missing_));
      if (random_.below(2) == 1) std::copy_n(&b.genes[2 * from], 2, &child.genes[2 * block]);
    }
    return child;
  }

  void mutate(Member& member) {
    if (random_.uniform() >= settings_.mutation) return;
    mutate_block(member.block(random_.below(static_cast<std::uint32_t>(missing_))), space_, random_);
  }

  void score(Member& member) {
    const std::size_t row = space_.row(std::span(member.genes).first(2 * missing_));
    member.score = {row, row == GeneSpace::none ? std::numeric_limits<double>::infinity() : sum_of(row)};
  }

  double sum_of(std::size_t row) {
    if (sums_[row] != kNotScored) return sums_[row];
    ++result_.evaluations;
    return sums_[row] = sum_of_differences(readings_, table_.row(row));
  }

  std::vector<ScoredRow> best_seen(std::size_t count) const {
    std::vector<ScoredRow> seen;
    for (std::size_t row = 0; row < sums_.size(); ++row)
      if (sums_[row] != kNotScored) seen.push_back({row, sums_[row]});
    return best_rows(std::move(seen), count);
  }

  std::span<const double> readings_;
  const SceneTable& table_;
  const GeneSpace& space_;
  std::size_t missing_;
  GeneticSettings settings_;
  Random random_;
  std::vector<double> sums_;  // misfit arguments already computed
  GeneticResult result_;
};

}  // namespace

GeneSpace::GeneSpace(const BlockLayout& layout, const SceneTable& table)
    : table_(table),
      blocks_(layout.size()),
      row_of_pair_((blocks_ + 1) * (blocks_ + 1), kNoRow),
      first_triple_(row_of_pair_) {
  for (std::size_t id = 0; id < blocks_; ++id) {
    // Blocks that are not laid in courses are one row.
    const auto course = static_cast<std::size_t>(std::max(layout.blocks[id].index.course, 0));
    courses_.resize(std::max(courses_.size(), course + 1));
    courses_[course].push_back(BlockId{static_cast<std::int32_t>(id)});
  }
  for (std::size_t row = 0; row < table.rows; ++row) {
    const auto missing = static_cast<std::size_t>(missing_blocks(table, row));
    if (missing > kMostBlocks) break;  // few missing blocks come first
    std::array<std::size_t, 2> pair = {blocks_, blocks_};
    std::copy_n(table.removed.begin() + static_cast<std::ptrdiff_t>(row * table.most_missing),
                std::min(missing, pair.size()), pair.begin());
    auto& rows = missing > pair.size() ? first_triple_ : row_of_pair_;
    std::uint32_t& first = rows[pair[0] * (blocks_ + 1) + pair[1]];
    if (first == kNoRow) first = static_cast<std::uint32_t>(row);
  }
}

/// Of ascending blocks.
std::size_t GeneSpace::row_of(std::span<const std::int32_t> blocks) const {
  const auto place = [&](std::size_t i) {
    return i < blocks.size() ? static_cast<std::size_t>(blocks[i]) : blocks_;
  };
  const std::size_t pair = place(0) * (blocks_ + 1) + place(1);
  if (blocks.size() < kMostBlocks) return row_of_pair_[pair];
  // Behind the first there are no more triples of the pair than blocks; those of other pairs follow.
  const std::size_t first = first_triple_[pair];
  if (first == kNoRow) return none;
  const auto rows = std::views::iota(first, std::min(table_.rows, first + blocks_));
  const auto found = std::ranges::partition_point(rows, [&](std::size_t row) {
    return std::ranges::lexicographical_compare(
        table_.removed.subspan(row * table_.most_missing, kMostBlocks), blocks);
  });
  const bool is_there =
      found != rows.end() &&
      std::ranges::equal(table_.removed.subspan(*found * table_.most_missing, kMostBlocks), blocks);
  return is_there ? *found : none;
}

std::size_t GeneSpace::row(std::span<const int> genes) const {
  std::array<std::int32_t, kMostBlocks> all{};
  const auto blocks = std::span(all).first(genes.size() / 2);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const auto course = static_cast<std::size_t>(genes[2 * i]);
    const auto position = static_cast<std::size_t>(genes[2 * i + 1]);
    if (position > courses_[course].size()) return none;
    blocks[i] = value(courses_[course][position - 1]);
  }
  std::ranges::sort(blocks);
  const std::size_t row = row_of(blocks);
  return row < table_.rows && table_.has_answer(row) ? row : none;
}

void mutate_block(std::span<int, 2> block, const GeneSpace& space, Random& random) {
  if (random.uniform() < kLocalMutation) {
    int& gene = block[random.below(2)];
    const int distance = 1 + static_cast<int>(random.below(kLargestStep));
    gene += random.below(2) == 0 ? distance : -distance;
  } else {
    move_anywhere(block, space, random);
  }
  repair(block, space);
}

GeneticResult genetic_search(std::span<const double> readings, const SceneTable& table,
                             const GeneSpace& space, int missing, const GeneticSettings& settings,
                             std::size_t count) {
  if (static_cast<std::size_t>(missing) > kMostBlocks)
    throw InputError(
        fmt::format("--search genetic among scenes with {} missing blocks, expected at most {} "
                    "(--missing)",
                    missing, kMostBlocks));
  return Evolution(readings, table, space, missing, settings).run(count);
}

}  // namespace voussoir
