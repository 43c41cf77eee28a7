#include "generator/outcome_counts.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace voussoir {
namespace {

constexpr std::size_t kMostListed = 20;  ///< unresolved scenes

}  // namespace

void OutcomeCounts::add(const Record& record, const BlockLayout& layout) {
  ++scenes;
  if (record.outcome == Outcome::standing) ++standing;
  if (record.outcome == Outcome::unresolved)
    unresolved.push_back({to_string(record.scene, layout), record.residual});
  if (record.outcome != Outcome::collapsed) return;
  ++collapsed;
  if (record.extent == CollapseExtent::arch) ++arch_collapses;
  if (record.extent == CollapseExtent::local) ++local_collapses;
}

OutcomeCounts count_outcomes(const Database& database) {
  OutcomeCounts counts;
  const SceneTable& table = database.table();
  for (std::size_t row = 0; row < table.rows; ++row) {
    Record record;
    record.scene = table.scene(row);
    record.outcome = static_cast<Outcome>(table.outcome[row]);
    record.extent = static_cast<CollapseExtent>(table.collapse[row]);
    if (record.outcome == Outcome::unresolved) record.residual = database.residual(row);
    counts.add(record, database.layout());
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
