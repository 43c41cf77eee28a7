#include "generator/outcome_counts.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace voussoir {
namespace {

constexpr std::size_t kMostListed = 20;  ///< unresolved scenes

}  // namespace

void OutcomeCounts::add(const Record& record, const BlockLayout& layout) {
  const RecordedState& state = record.states.front();
  ++scenes;
  if (state.outcome == Outcome::standing) ++standing;
  if (state.outcome == Outcome::unresolved)
    unresolved.push_back({to_string(record.key, layout), state.residual});
  if (state.outcome != Outcome::collapsed) return;
  ++collapsed;
  if (state.extent == CollapseExtent::arch) ++arch_collapses;
  if (state.extent == CollapseExtent::local) ++local_collapses;
}

OutcomeCounts count_outcomes(const Database& database) {
  OutcomeCounts counts;
  for (std::size_t variant = 0; variant < database.variant_count(); ++variant) {
    const SceneTable table = database.table(static_cast<std::int32_t>(variant), 0);
    for (std::size_t row = 0; row < table.rows; ++row) {
      Record record;
      RecordedState& state = record.states.emplace_back();
      state.outcome = static_cast<Outcome>(table.outcome[row]);
      state.extent = static_cast<CollapseExtent>(table.collapse[row]);
      if (state.outcome == Outcome::unresolved) record = database.record(table.first_record + row);
      counts.add(record, database.layout());
    }
  }
  return counts;
}

std::string to_text(const OutcomeCounts& counts) {
  std::string text = fmt::format("  standing    {}\n", counts.standing);
  text += fmt::format("  collapsed   {} ({} of the arch, {} of wall blocks only)\n", counts.collapsed,
                      counts.arch_collapses, counts.local_collapses);
  text += fmt::format("  unresolved  {}\n", counts.unresolved.size());
  for (std::size_t i = 0; i < std::min(counts.unresolved.size(), kMostListed); ++i)
    text +=
        fmt::format("    {}, residual {:.1e}\n", counts.unresolved[i].scene, counts.unresolved[i].residual);
  if (counts.unresolved.size() > kMostListed)
    text += fmt::format("    and {} more\n", counts.unresolved.size() - kMostListed);
  return text;
}

nlohmann::ordered_json to_json(const OutcomeCounts& counts) {
  nlohmann::ordered_json unresolved = nlohmann::ordered_json::array();
  for (const UnresolvedScene& scene : counts.unresolved)
    unresolved.push_back({{"scene", scene.scene}, {"residual", scene.residual}});
  return {{"scenes", counts.scenes},
          {"standing", counts.standing},
          {"collapsed", counts.collapsed},
          {"arch_collapses", counts.arch_collapses},
          {"local_collapses", counts.local_collapses},
          {"unresolved", counts.unresolved.size()},
          {"unresolved_scenes", unresolved}};
}

}  // namespace voussoir
