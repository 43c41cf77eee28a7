#include "core/solve/state_plan.h"

#include <algorithm>
#include <map>

#include "core/error.h"
#include "core/solve/state_name.h"
#include "core/structure/loads.h"
#include "core/structure/mirror_symmetry.h"
#include "core/text.h"

namespace voussoir {
namespace {

std::vector<std::string> chosen_histories(const std::string& text) {
  const std::vector<std::string_view> words = split(text, ',');
  std::vector<std::string> histories;
  for (const char* history : {kBuiltState, kLostState})
    if (std::ranges::count(words, history) == 1) histories.emplace_back(history);
  if (histories.size() != words.size())
    throw InputError(fmt::format("--history: cannot read '{}': expected built, lost or built,lost", text));
  return histories;
}

std::vector<LoadDescription> chosen_loads(const std::string& text,
                                          const std::vector<LoadDescription>& loads) {
  if (text == "all") return loads;
  if (text == "none") return {};
  std::vector<std::string> known;
  for (const LoadDescription& load : loads) known.push_back(load.name);
  std::vector<LoadDescription> chosen;
  for (const std::string_view name : split(text, ',')) {
    const auto load = std::ranges::find(loads, name, &LoadDescription::name);
    if (load == loads.end())
      throw InputError(fmt::format(
          "--loads: the bridge has no load case {}: expected all, none or names of its load "
          "cases ({})",
          in_quotes(name), known.empty() ? "it has none" : fmt::format("{}", fmt::join(known, ", "))));
    if (std::ranges::find(chosen, *load) != chosen.end())
      throw InputError(fmt::format("--loads: names {} twice", in_quotes(name)));
    chosen.push_back(*load);
  }
  return chosen;
}

[[noreturn]] void refuse_state(const std::string& name, const std::string& why) {
  throw InputError(fmt::format("state '{}': {}", name, why));
}

std::size_t place_of(const StatePlan& plan, const std::string& name, const std::string& follower) {
  const auto found = std::ranges::find(plan, name, &PlannedState::name);
  if (found == plan.end() || !found->kept)
    refuse_state(follower, fmt::format("expected the state '{}' before it", name));
  return static_cast<std::size_t>(found - plan.begin());
}

/// A load is its own mirror image if forces differ by no more than round-off.
bool is_symmetric(const Field& load, const std::optional<MirrorSymmetry>& symmetry) {
  constexpr double kRoundOff = 1e-9;
  return symmetry &&
         (mirrored(load, *symmetry) - load).cwiseAbs().maxCoeff() <= kRoundOff * load.cwiseAbs().maxCoeff();
}

/// The stages of all load cases of a description, found by their names.
class LoadCases {
 public:
  LoadCases(const Structure& bridge, const BridgeDescription& description)
      : bridge_(bridge), description_(description) {}

  /// The state in which this stage acts, after the stage before it.
  PlannedState state_of(const std::string& name, const StatePlan& plan) {
    const std::string history(history_of(name));
    const std::string_view stage = load_stage_of(name);
    const std::string_view load_name = stage.substr(0, stage.find('@'));
    const std::vector<LoadStage>& stages = stages_of(std::string(load_name), name);
    const auto found = std::ranges::find(stages, stage, &LoadStage::name);
    if (found == stages.end()) refuse_state(name, "the load case has no such stage");
    const std::string before =
        found == stages.begin() ? history : state_name(history, std::prev(found)->name);
    const std::size_t place = place_of(plan, before, name);
    return {name, place, true, found->force,
            plan[place].mirrors && is_symmetric(found->force, bridge_.symmetry)};
  }

 private:
  const std::vector<LoadStage>& stages_of(const std::string& load_name, const std::string& state) {
    const auto [place, is_new] = stages_.try_emplace(load_name);
    if (!is_new) return place->second;
    const auto load = std::ranges::find(description_.loads, load_name, &LoadDescription::name);
    if (load == description_.loads.end()) refuse_state(state, "the bridge has no such load case");
    return place->second = load_stages(*load, bridge_, description_.material.thickness);
  }

  const Structure& bridge_;
  const BridgeDescription& description_;
  std::map<std::string, std::vector<LoadStage>> stages_;
};

}  // namespace

std::vector<std::string> state_names(const std::string& histories, const std::string& loads,
                                     const std::vector<LoadDescription>& bridge_loads) {
  std::vector<std::string> names = chosen_histories(histories);
  const std::vector<std::string> chosen = names;
  for (const std::string& history : chosen)
    for (const LoadDescription& load : chosen_loads(loads, bridge_loads))
      for (const std::string& stage : stage_names(load)) names.push_back(state_name(history, stage));
  return names;
}

StatePlan plan_states(const std::vector<std::string>& names, const Structure& bridge,
                      const BridgeDescription& description) {
  LoadCases loads(bridge, description);
  StatePlan plan = {{.name = kBuiltState, .kept = !names.empty() && names.front() == kBuiltState}};
  for (const std::string& name : names) {
    if (name == kBuiltState && plan.size() == 1 && plan.front().kept) continue;
    if (std::ranges::find(plan, name, &PlannedState::name) != plan.end())
      refuse_state(name, "is out of place");
    if (name == kLostState)
      plan.push_back({.name = name, .before = kBuilt});
    else
      plan.push_back(loads.state_of(name, plan));
  }
  return plan;
}

std::optional<std::size_t> place_of_lost(const StatePlan& plan) {
  const auto lost = std::ranges::find(plan, kLostState, &PlannedState::name);
  return lost == plan.end() ? std::nullopt : std::optional(static_cast<std::size_t>(lost - plan.begin()));
}

bool has_one_sided_loads(const StatePlan& plan) {
  return std::ranges::any_of(plan, [](const PlannedState& state) { return !state.mirrors; });
}

std::vector<std::size_t> kept_states(const StatePlan& plan) {
  std::vector<std::size_t> kept;
  for (std::size_t state = 0; state < plan.size(); ++state)
    if (plan[state].kept) kept.push_back(state);
  return kept;
}

}  // namespace voussoir
