#include "generator/summary.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/error.h"

namespace voussoir {
namespace {

constexpr std::size_t kMostListed = 20;  ///< unresolved scenes

std::string unresolved_text(const std::vector<UnresolvedScene>& scenes) {
  std::string text;
  for (std::size_t i = 0; i < std::min(scenes.size(), kMostListed); ++i)
    text += fmt::format("    {}, residual {:.1e}\n", scenes[i].scene, scenes[i].residual);
  if (scenes.size() > kMostListed) text += fmt::format("    and {} more\n", scenes.size() - kMostListed);
  return text;
}

std::string origin_text(const BuildSummary& summary) {
  if (summary.up_to_date) return "nothing to do: the file is up to date";
  std::string text = fmt::format("{} computed", summary.computed);
  if (summary.resumed > 0) text += fmt::format(", {} from the interrupted build", summary.resumed);
  if (summary.reused > 0) text += fmt::format(", {} from the old file", summary.reused);
  return text;
}

}  // namespace

std::string to_text(const BuildSummary& summary) {
  return fmt::format("{}: {} scenes ({})\n", summary.output.string(), summary.scenes, origin_text(summary)) +
         fmt::format("  standing    {}\n  collapsed   {}\n  unresolved  {}\n", summary.standing,
                     summary.collapsed, summary.unresolved.size()) +
         unresolved_text(summary.unresolved) +
         fmt::format("  time        {:.1f} s\n  size        {:.1f} MB\n  digest      {}\n", summary.seconds,
                     static_cast<double>(summary.bytes) * 1e-6, summary.digest);
}

std::string to_json(const BuildSummary& summary) {
  nlohmann::ordered_json unresolved = nlohmann::ordered_json::array();
  for (const UnresolvedScene& scene : summary.unresolved)
    unresolved.push_back({{"scene", scene.scene}, {"residual", scene.residual}});
  const nlohmann::ordered_json json = {{"ok", true},
                                       {"file", summary.output.string()},
                                       {"up_to_date", summary.up_to_date},
                                       {"scenes", summary.scenes},
                                       {"standing", summary.standing},
                                       {"collapsed", summary.collapsed},
                                       {"unresolved", summary.unresolved.size()},
                                       {"unresolved_scenes", unresolved},
                                       {"computed", summary.computed},
                                       {"resumed", summary.resumed},
                                       {"reused", summary.reused},
                                       {"changes", summary.changes},
                                       {"seconds", summary.seconds},
                                       {"bytes", summary.bytes},
                                       {"digest", summary.digest}};
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace voussoir
