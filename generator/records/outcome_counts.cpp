#include "generator/records/outcome_counts.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/solve/state_name.h"

namespace voussoir {
namespace {

constexpr std::size_t kMostUnresolved = 20;  ///< unresolved scenes

void count(const RecordedState& state, const RecordKey& key, const BlockLayout& layout,
           StateOutcomes& counts) {
  if (state.origin == Origin::composed) ++counts.composed;
  if (state.origin == Origin::inherited) ++counts.inherited;
  if (state.outcome == Outcome::standing) ++counts.standing;
  if (state.outcome == Outcome::unresolved)
    counts.unresolved.push_back({to_string(key, layout), state.residual});
  if (state.outcome != Outcome::collapsed) return;
  ++counts.collapsed;
  if (state.extent == CollapseExtent::arch) ++counts.arch_collapses;
  if (state.extent == CollapseExtent::local) ++counts.local_collapses;
}

std::string intact_text(const StateOutcomes& counts) {
  if (counts.by_slip)
    return "    the intact bridge stands only by what its joints have slid, which depends on how it was "
           "loaded\n";
  const std::optional<Outcome>& intact = counts.intact;
  if (!intact || *intact == Outcome::standing) return {};
  return fmt::format(
      "    the intact bridge {}, so that what its scenes change is not known. Is the bridge as it is meant?\n"
      "    build-database --draw bridge.svg shows it\n",
      *intact == Outcome::collapsed ? "falls" : "has no outcome");
}

std::string state_text(const StateOutcomes& counts) {
  std::string text = fmt::format("  standing    {}\n", counts.standing);
  text += fmt::format("  collapsed   {} ({} of the arch, {} of wall blocks only)\n", counts.collapsed,
                      counts.arch_collapses, counts.local_collapses);
  if (counts.composed > 0)
    text += fmt::format("  composed    {} of those that stand, from scenes with fewer missing blocks\n",
                        counts.composed);
  if (counts.inherited > 0)
    text += fmt::format("  inherited   {} of the collapses, from scenes with fewer missing blocks\n",
                        counts.inherited);
  text += fmt::format("  unresolved  {}\n", counts.unresolved.size());
  for (std::size_t i = 0; i < std::min(counts.unresolved.size(), kMostUnresolved); ++i)
    text +=
        fmt::format("    {}, residual {:.1e}\n", counts.unresolved[i].scene, counts.unresolved[i].residual);
  if (counts.unresolved.size() > kMostUnresolved)
    text += fmt::format("    and {} more\n", counts.unresolved.size() - kMostUnresolved);
  return text + intact_text(counts);
}

nlohmann::ordered_json state_json(const StateOutcomes& counts) {
  nlohmann::ordered_json unresolved = nlohmann::ordered_json::array();
  for (const UnresolvedScene& scene : counts.unresolved)
    unresolved.push_back({{"scene", scene.scene}, {"residual", scene.residual}});
  return {{"standing", counts.standing},
          {"collapsed", counts.collapsed},
          {"arch_collapses", counts.arch_collapses},
          {"local_collapses", counts.local_collapses},
          {"composed", counts.composed},
          {"inherited", counts.inherited},
          {"unresolved", counts.unresolved.size()},
          {"unresolved_scenes", unresolved},
          {"intact", counts.intact ? nlohmann::ordered_json(to_string(*counts.intact)) : nullptr},
          {"stands_by_slip", counts.by_slip}};
}

}  // namespace

OutcomeCounts::OutcomeCounts(const std::vector<std::string>& state_names) {
  for (const std::string& name : state_names)
    states.push_back({.state = name, .unresolved = {}, .intact = {}});
}

void OutcomeCounts::add(const Record& record, const BlockLayout& layout) {
  ++scenes;
  for (std::size_t state = 0; state < states.size(); ++state) {
    count(record.states.at(state), record.key, layout, states[state]);
    if (record.key.variant != kNominalVariant || !record.key.scene.removed.empty()) continue;
    states[state].intact = record.states[state].outcome;
    states[state].by_slip = !record.states[state].slipped.empty();
  }
}

OutcomeCounts count_outcomes(const Database& database) {
  OutcomeCounts counts(database.states());
  counts.scenes = database.rows();
  for (std::size_t variant = 0; variant < database.variant_count(); ++variant)
    for (std::size_t place = 0; place < counts.states.size(); ++place) {
      const SceneTable table = database.table(static_cast<std::int32_t>(variant), place);
      for (std::size_t row = 0; row < table.rows; ++row) {
        RecordedState state;
        state.outcome = static_cast<Outcome>(table.outcome[row]);
        state.extent = static_cast<CollapseExtent>(table.collapse[row]);
        state.origin = table.origin_of(row);
        RecordKey key;
        if (state.outcome == Outcome::unresolved) {  // the only ones of which more is told
          Record record = database.record(table.first_record + row);
          state.residual = record.states[place].residual;
          key = std::move(record.key);
        }
        count(state, key, database.layout(), counts.states[place]);
      }
      const auto intact = table.find(Scene{});
      if (variant != std::size_t{kNominalVariant} || !intact) continue;
      counts.states[place].intact = static_cast<Outcome>(table.outcome[*intact]);
      counts.states[place].by_slip = database.stands_by_slip(place);
    }
  return counts;
}

std::string to_text(const OutcomeCounts& counts) {
  if (counts.states.size() == 1) return state_text(counts.states.front());
  std::string text;
  for (const StateOutcomes& state : counts.states)
    if (is_history(state.state))
      text += fmt::format("  {}\n", state.state) + state_text(state);
    else
      text += fmt::format("  {}: {} standing, {} collapsed, {} unresolved\n", state.state, state.standing,
                          state.collapsed, state.unresolved.size());
  return text;
}

std::string collapses_text(bool keeps_fields) {
  return keeps_fields ? "" : "  collapses   whether and what falls, without fields\n";
}

nlohmann::ordered_json to_json(const OutcomeCounts& counts) {
  nlohmann::ordered_json json = {{"scenes", counts.scenes}};
  if (!counts.states.empty()) json.update(state_json(counts.states.front()));
  nlohmann::ordered_json states = nlohmann::ordered_json::array();
  for (const StateOutcomes& state : counts.states) {
    states.push_back({{"state", state.state}});
    states.back().update(state_json(state));
  }
  json["states"] = std::move(states);
  return json;
}

}  // namespace voussoir
