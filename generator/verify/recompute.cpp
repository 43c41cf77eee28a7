#include "generator/verify/recompute.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

#include "database/format/field_codec.h"
#include "generator/verify/field_difference.h"

namespace voussoir {

std::vector<std::size_t> choose_rows(std::size_t rows, std::size_t count, std::uint64_t seed) {
  std::vector<std::size_t> chosen(rows);
  std::iota(chosen.begin(), chosen.end(), std::size_t{0});
  std::mt19937_64 random(seed);
  count = std::min(count, rows);
  for (std::size_t i = 0; i < count; ++i) std::swap(chosen[i], chosen[i + random() % (rows - i)]);
  chosen.resize(count);
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

std::vector<Solution> recompute_start(const RecordKey& key, const RecomputedVariant& variant,
                                      const StageSolver& solver) {
  const bool is_kept = key.scene.missing() <= 1;
  if (auto found = is_kept ? variant.starts->find(key) : std::nullopt) return std::move(*found);
  std::vector<Solution> states = recompute(key, variant, solver);
  if (is_kept) variant.starts->add(key, states);
  return states;
}

std::optional<std::vector<Solution>> SolvedStarts::find(const RecordKey& key) const {
  const std::scoped_lock lock(mutex_);
  const auto found = solved_.find(key);
  return found == solved_.end() ? std::nullopt : std::optional(found->second);
}

void SolvedStarts::add(const RecordKey& key, const std::vector<Solution>& states) {
  const std::scoped_lock lock(mutex_);
  solved_.emplace(key, states);
}

SearchBasis basis_of(const std::set<Scene>& starting, std::int32_t number, const RecomputedVariant& variant,
                     const StageSolver& solver) {
  const bool is_stored =
      variant.database.has_fields() && kept_states(variant.plan).size() == variant.plan.size();
  StartingFields starts;
  for (const Scene& start : starting) {
    const RecordKey key{number, start};
    const auto row = is_stored ? variant.database.find(number, start) : std::nullopt;
    const std::vector<Solution> anew = row ? std::vector<Solution>{} : recompute_start(key, variant, solver);
    for (std::size_t state = 0; state < variant.plan.size(); ++state)
      starts.add(start, state, row ? variant.database.solution(*row, state) : anew[state]);
  }
  return variant.equations.basis(solver, std::move(starts), variant.rules);
}

std::vector<Solution> recompute(const RecordKey& key, const RecomputedVariant& variant,
                                const StageSolver& solver) {
  SceneGroup group{
      .solved = representative(key.scene, variant.bridge, variant.rules), .states = {}, .image = {}};
  if (group.solved != key.scene) group.image = key.scene;
  group.needs_all = !group.image;
  const auto starting = starting_scenes(group.solved, group.image, variant.rules, variant.plan);
  const SearchBasis basis = basis_of(starting, key.variant, variant, solver);
  variant.equations.solve(solver, basis, std::span(&group, 1));
  std::vector<Solution> solutions;
  for (std::optional<Solution>& state : group.image ? group.image_states : group.states)
    solutions.push_back(std::move(state.value()));
  return solutions;
}

double largest_difference(const Solution& recomputed, const RecordedState& stored, const Structure& bridge) {
  if (!stored.packed_field.empty()) {
    const auto field = unpack_field(stored.packed_field, bridge.mesh.node_count());
    return field ? largest_difference(recomputed.displacement.reshaped(), field->reshaped())
                 : std::numeric_limits<double>::infinity();
  }
  return largest_difference(readings_at(bridge.control_points, recomputed.displacement),
                            Eigen::Map<const Eigen::VectorXd>(
                                stored.vertical.data(), static_cast<Eigen::Index>(stored.vertical.size())));
}

}  // namespace voussoir
