#include "generator/summary.h"

#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/json_text.h"

namespace voussoir {
namespace {

std::string origin_text(const BuildSummary& summary) {
  if (summary.up_to_date) return "nothing to do: the file is up to date";
  std::string text = fmt::format("{} computed", summary.computed);
  if (summary.resumed > 0) text += fmt::format(", {} from the interrupted build", summary.resumed);
  if (summary.merged > 0) text += fmt::format(", {} from the parts", summary.merged);
  if (summary.reused > 0) text += fmt::format(", {} from the old file", summary.reused);
  return text;
}

std::string blocks_text(const BuildSummary& summary) {
  std::string text = fmt::format("  blocks      {}\n", summary.blocks);
  const SmallPieces& small = summary.small_pieces;
  if (small.joined > 0)
    text += fmt::format(
        "  joined      {} pieces below the smallest block (key smallest_block), to their neighbours\n",
        small.joined);
  if (small.left > 0)
    text += fmt::format("  left small  {} pieces without a neighbour in the wall\n", small.left);
  return text;
}

/// What may be done about scenes that have no answer as built.
std::string patience_text(const OutcomeCounts& counts) {
  if (counts.states.empty() || counts.states.front().unresolved.empty()) return "";
  return "              --patience 20 follows their motions for up to 20 s, and builds the file anew\n";
}

}  // namespace

std::string to_text(const BuildSummary& summary) {
  return fmt::format("{}: {} scenes ({})\n", summary.output.string(), summary.outcomes.scenes,
                     origin_text(summary)) +
         blocks_text(summary) + to_text(summary.outcomes) + patience_text(summary.outcomes) +
         collapses_text(summary.collapse_fields) +
         fmt::format("  time        {:.1f} s\n  size        {:.1f} MB\n  digest      {}\n", summary.seconds,
                     static_cast<double>(summary.bytes) * 1e-6, summary.digest);
}

std::string to_json(const BuildSummary& summary) {
  nlohmann::ordered_json json = {
      {"ok", true}, {"file", summary.output.string()}, {"up_to_date", summary.up_to_date}};
  json.update({{"blocks", summary.blocks},
               {"joined_pieces", summary.small_pieces.joined},
               {"small_pieces", summary.small_pieces.left}});
  json.update(to_json(summary.outcomes));
  json.update({{"collapses", summary.collapse_fields ? "field" : "outcome"},
               {"computed", summary.computed},
               {"resumed", summary.resumed},
               {"reused", summary.reused},
               {"merged", summary.merged},
               {"changes", summary.changes},
               {"seconds", summary.seconds},
               {"bytes", summary.bytes},
               {"digest", summary.digest}});
  return json_text(json);
}

}  // namespace voussoir
