#include "generator/build_settings.h"

#include <fmt/format.h>

#include "database/format/field_codec.h"

namespace voussoir {
namespace {

constexpr const char* kMirrorImages = "mirror_images";
constexpr const char* kWarmStarts = "warm_starts";
constexpr const char* kCollapseOutcomes = "collapses = outcome\n";
constexpr const char* kCollapseFields = "collapses = field\n";

std::string line(const char* rule, bool used) {
  return fmt::format("{} = {}\n", rule, used ? "used" : "not used");
}

}  // namespace

std::string build_settings(const SolverChoice& solver, const Model& bridge, const PlanRules& rules) {
  return solver.settings(bridge) + line(kMirrorImages, rules.mirror_images && bridge.symmetry.has_value()) +
         line(kWarmStarts, rules.warm_starts) +
         (rules.collapse_fields ? kCollapseFields : kCollapseOutcomes) +
         fmt::format("storage_step_m = {}\n", kStorageStep);
}

PlanRules rules_in(const std::string& settings) {
  const auto used = [&](const char* rule) { return settings.find(line(rule, true)) != std::string::npos; };
  return {.mirror_images = used(kMirrorImages),
          .warm_starts = used(kWarmStarts),
          .collapse_fields = settings.find(kCollapseOutcomes) == std::string::npos};
}

}  // namespace voussoir
