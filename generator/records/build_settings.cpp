#include "generator/records/build_settings.h"

#include <fmt/format.h>

#include "database/format/field_codec.h"

namespace voussoir {
namespace {

constexpr const char* kMirrorImages = "mirror_images";
constexpr const char* kWarmStarts = "warm_starts";
constexpr const char* kInherited = "inherited";
constexpr const char* kComposed = "composed";
constexpr const char* kCollapseOutcomes = "collapses = outcome\n";
constexpr const char* kCollapseFields = "collapses = field\n";

std::string line(const char* rule, bool used) {
  return fmt::format("{} = {}\n", rule, used ? "used" : "not used");
}

/// Of rules for scenes of three and more missing blocks: databases without any need not say that they are
/// used.
std::string line_if_off(const char* rule, bool used) {
  return used ? "" : line(rule, used);
}

}  // namespace

std::string build_settings(const SolverChoice& solver, const Model& bridge, const PlanRules& rules) {
  return solver.settings(bridge) + line(kMirrorImages, rules.mirror_images && bridge.symmetry.has_value()) +
         line(kWarmStarts, rules.warm_starts) + line_if_off(kInherited, rules.inherited) +
         line_if_off(kComposed, rules.composed) +
         (rules.collapse_fields ? kCollapseFields : kCollapseOutcomes) +
         fmt::format("storage_step_m = {}\n", kStorageStep);
}

PlanRules rules_in(const std::string& settings) {
  const auto used = [&](const char* rule) { return settings.find(line(rule, true)) != std::string::npos; };
  return {.mirror_images = used(kMirrorImages),
          .warm_starts = used(kWarmStarts),
          .inherited = settings.find(line(kInherited, false)) == std::string::npos,
          .composed = settings.find(line(kComposed, false)) == std::string::npos,
          .collapse_fields = settings.find(kCollapseOutcomes) == std::string::npos};
}

}  // namespace voussoir
