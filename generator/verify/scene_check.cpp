#include "generator/verify/scene_check.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/statics/quasi_static_solver.h"
#include "core/structure/mirror_symmetry.h"
#include "database/format/field_codec.h"
#include "generator/verify/field_difference.h"

namespace voussoir {
namespace {

/// One scene of one variant under examination.
class Examination {
 public:
  Examination(const CheckedVariant& checked, std::size_t row)
      : checked_(checked),
        row_(row),
        lost_(place_of_lost(checked.plan)),
        planned_states_(kept_states(checked.plan)),
        key_(checked.database.key(row)) {
    guarded([&] {
      record_ = checked_.database.record(row_);
      fields_ = take_fields(record_);
      check_checksum(record_, fields_);
      states_.resize(checked_.plan.size());
      for (std::size_t state = 0; state < fields_.size(); ++state)
        states_[planned_states_[state]] = solution_of(record_.states[state], fields_[state]);
    });
  }

  /// The scene as lost to be solved again if its blocks went in many steps: fields do not tell what the
  /// joints remember of these.
  std::optional<SceneGroup> many_steps() const {
    const bool is_searched = lost_ && !fields_.empty() && states_[*lost_] && stands(*states_[*lost_]);
    if (!is_searched || has_slipped(*states_[*lost_]) || checked_.basis.steps.of(key_.scene) == 1)
      return std::nullopt;
    SceneGroup group{.solved = key_.scene, .states = states_, .image = {}};
    group.states[*lost_].reset();
    return group;
  }

  /// Forces at the end of the steps are the same with the memory before the last one and after it.
  void take_memory(std::vector<JointMemory> memory) { states_[*lost_]->memory = std::move(memory); }

  SceneCheck run() {
    guarded([&] {
      for (std::size_t state = 0; state < record_.states.size(); ++state) {
        place_ = state;
        planned_ = planned_states_[state];
        check_collapse(record_.states[state]);
        if (!fields_.empty()) check_field(record_.states[state], fields_[state]);
      }
    });
    return std::move(check_);
  }

 private:
  template <class Check>
  void guarded(const Check& check) {
    try {
      check();
    } catch (const InputError& error) {
      report(error.what());
      record_.states.clear();
      fields_.clear();
    }
  }
  void report(const std::string& what) {
    check_.problems.push_back(fmt::format("scene {}: {}", to_string(key_, checked_.bridge.layout), what));
  }
  /// Of the state under examination.
  void report_state(const std::string& what) {
    const bool several = checked_.database.states().size() > 1;
    report(several ? fmt::format("as {}: {}", checked_.plan[planned_].name, what) : what);
  }

  /// The fields of the record's states; none if the database has none. Throws InputError if one cannot be
  /// decoded.
  std::vector<Field> take_fields(const Record& record) {
    std::vector<Field> fields;
    if (!checked_.database.has_fields()) return fields;
    for (const RecordedState& state : record.states) {
      if (crc32_of(state.packed_field) != state.field_crc)
        report("the stored bytes of its field do not have the stored CRC-32");
      auto field = unpack_field(state.packed_field, checked_.bridge.mesh.node_count());
      if (!field) throw InputError("its field cannot be decompressed");
      fields.push_back(std::move(*field));
    }
    return fields;
  }

  void check_checksum(const Record& record, const std::vector<Field>& fields) {
    std::vector<std::span<const double>> numbers;
    for (const Field& field : fields) numbers.push_back(numbers_of(field));
    if (scene_checksum(record, numbers) != record.checksum)
      report("its data do not have the stored checksum");
  }

  void check_collapse(const RecordedState& state) {
    if (state.extent != collapse_extent(checked_.bridge.layout, state.moving))
      report_state("its kind of collapse is not that of the blocks that move");
  }

  void check_field(const RecordedState& state, const Field& field) {
    ++check_.fields;
    check_presence(state, field);
    check_control_points(state, field);
    // What is composed misses equilibrium by as much as its check allows; solving it anew shows the error.
    if (state.outcome == Outcome::standing && state.origin != Origin::composed) check_equilibrium(field);
    check_repetition(state, field);
    if (checked_.bridge.symmetry && checked_.plan[planned_].mirrors) check_mirror_image(state, field);
  }

  /// Where a state is that of an earlier one (see StateSolving), both are equal bit by bit.
  void check_repetition(const RecordedState& state, const Field& field) {
    const PlannedState& planned = checked_.plan[planned_];
    if (!planned.before || !states_[*planned.before]) return;
    const Solution& before = *states_[*planned.before];
    const bool neither_stands = state.outcome != Outcome::standing && before.outcome != Outcome::standing;
    const bool repeats =
        planned.is_load ? before.outcome != Outcome::standing : neither_stands || key_.scene.removed.empty();
    if (!repeats) return;
    if (state.outcome != before.outcome ||
        !(largest_difference(field.reshaped(), before.displacement.reshaped()) <= 0.0))
      report_state(fmt::format("is not as it was as {}", checked_.plan[*planned.before].name));
  }

  /// Numbers at the nodes of all blocks but the removed ones; none at all of a collapse without a field.
  void check_presence(const RecordedState& state, const Field& field) {
    const bool only_outcome = !checked_.rules.collapse_fields || state.origin == Origin::inherited;
    if (only_outcome && state.outcome == Outcome::collapsed) {
      if (!field.array().isNaN().all()) report_state("has displacements, though only its outcome is known");
      return;
    }
    const auto removed = removal_mask(key_.scene, checked_.bridge.layout.size());
    for (std::size_t block = 0; block < removed.size(); ++block) {
      const IndexRange nodes = checked_.bridge.mesh.block_nodes[block];
      const auto numbers = field.middleCols(nodes.begin, nodes.size()).array();
      const bool right = removed[block] ? numbers.isNaN().all() : numbers.isFinite().all();
      if (!right)
        report_state(fmt::format("the displacements of block {} are {}",
                                 checked_.bridge.layout.blocks[block].label,
                                 removed[block] ? "there although it is removed" : "no numbers"));
    }
  }

  void check_control_points(const RecordedState& state, const Field& field) {
    const Eigen::VectorXd expected = readings_at(checked_.bridge.control_points, field);
    const auto same = [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); };
    if (!std::equal(expected.begin(), expected.end(), state.vertical.begin(), state.vertical.end(), same))
      report_state("its control displacements are not those of its field");
  }

  void check_equilibrium(const Field& field) {
    std::vector<JointMemory> memory;
    if (planned_ == lost_) memory = states_[planned_]->memory;
    if (memory.empty())
      memory = checked_.equations.memory_before(key_.scene, planned_, states_, checked_.basis.of_intact);
    const double unbalance =
        unbalanced_force(checked_.equations.equations(key_.scene, planned_, std::move(memory)), field);
    check_.unbalance = std::max(check_.unbalance, unbalance);
    if (!(unbalance <= checked_.most_unbalance))
      report_state(fmt::format(
          "stands, but its field is out of equilibrium by {:.1e} of the largest nodal weight", unbalance));
  }

  /// Each pair of images is compared once, by the earlier of the two.
  void check_mirror_image(const RecordedState& state, const Field& field) {
    const Scene image = mirrored(key_.scene, *checked_.bridge.symmetry);
    const auto image_row = checked_.database.find(key_.variant, image);
    if (!image_row || *image_row <= row_) return;
    check_.mirror_compared = true;
    const Solution other = checked_.database.solution(*image_row, place_);
    const std::string name = to_string(image, checked_.bridge.layout);
    if (other.outcome != state.outcome)
      report_state(fmt::format("its mirror image {} has another outcome", name));
    if (state.outcome != Outcome::standing && !checked_.rules.mirror_images) return;
    if (other.moving != mirrored(state.moving, *checked_.bridge.symmetry))
      report_state(fmt::format("its mirror image {} has other moving blocks", name));
    const double difference = largest_difference(other.displacement.reshaped(),
                                                 mirrored(field, *checked_.bridge.symmetry).reshaped());
    if (!(difference <= (checked_.rules.mirror_images ? 0.0 : kSameDisplacement)))
      report_state(fmt::format("differs from its mirror image {} by {:.1e} m", name, difference));
  }

  const CheckedVariant& checked_;
  std::size_t row_;
  std::optional<std::size_t> lost_;          ///< number of `lost` in the plan
  std::vector<std::size_t> planned_states_;  ///< of each state of the record its number in the plan
  Record record_;
  std::vector<Field> fields_;  ///< of the record's states
  SceneStates states_;         ///< as stored, in the order of the plan
  std::size_t place_ = 0;      ///< of the state under examination, in the database
  std::size_t planned_ = 0;    ///< the same in the plan
  RecordKey key_;
  SceneCheck check_;
};

}  // namespace

double most_stored_unbalance(const Model& bridge, std::string_view settings) {
  // A motion ends when the resultant on no block exceeds a hundredth of its weight; single nodes, which share
  // a block's resultant unevenly and still vibrate a little, may be a few times further off.
  constexpr double kRest = 0.05;
  if (settings.starts_with("solver = dynamic")) return kRest;
  constexpr double kBonded = 1.0;
  const EquilibriumSystem system(bridge);
  const Coefficients coefficients(system, bridge.parameters);
  const Field zero = Field::Zero(2, bridge.mesh.node_count());
  const StageEquations equations(system, coefficients, Stage{});
  Eigen::SparseMatrix<double> tangent = system.pattern;
  assemble(equations, zero, kBonded, {tangent.valuePtr()});
  const Eigen::VectorXd row_sums = tangent.cwiseAbs() * Eigen::VectorXd::Ones(tangent.cols());
  return QuasiStaticSettings{}.loose_tolerance +
         0.5 * kStorageStep * row_sums.maxCoeff() / equations.largest_load;
}

std::vector<SceneCheck> check_scenes(const CheckedVariant& checked, std::span<const std::size_t> rows,
                                     const StageSolver& solver) {
  std::vector<Examination> scenes;
  std::vector<SceneGroup> again;
  std::vector<std::size_t> places;
  for (const std::size_t row : rows) {
    if (auto group = scenes.emplace_back(checked, row).many_steps()) {
      again.push_back(std::move(*group));
      places.push_back(scenes.size() - 1);
    }
  }
  if (!again.empty()) checked.equations.solve(solver, checked.basis, again);
  for (std::size_t i = 0; i < again.size(); ++i)
    scenes[places[i]].take_memory(again[i].states[*place_of_lost(checked.plan)]->memory);
  std::vector<SceneCheck> checks;
  for (Examination& scene : scenes) checks.push_back(scene.run());
  return checks;
}

}  // namespace voussoir
