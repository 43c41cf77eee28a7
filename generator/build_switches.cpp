#include "generator/build_switches.h"

#include <algorithm>
#include <array>

#include "generator/verify/field_difference.h"

namespace voussoir {

std::span<const BuildSwitch> build_switches() {
  // Where the same numbers are computed in another way nothing changes; where a search goes another way to
  // the same equilibrium, or contacts are added up in another order, two solutions of the same scene differ.
  constexpr double kNothing = 0.0;
  constexpr double kSameFall = 2e-4;  // of the reference bridge at most 5.5e-5
  static constexpr std::array kSwitches = {
      BuildSwitch{"composed", kNothing, [](PlanRules& rules, Skips&) { rules.composed = false; }},
      BuildSwitch{"early-motions", kSameFall, [](PlanRules&, Skips& skips) { skips.early_motions = false; }},
      BuildSwitch{"early-outcome", kSameDisplacement,
                  [](PlanRules&, Skips& skips) { skips.early_outcome = false; }},
      BuildSwitch{"inherited", kNothing, [](PlanRules& rules, Skips&) { rules.inherited = false; }},
      BuildSwitch{"kept-factors", kSameDisplacement,
                  [](PlanRules&, Skips& skips) { skips.kept_factors = false; }},
      BuildSwitch{"lane-refill", kNothing, [](PlanRules&, Skips& skips) { skips.lane_refill = false; }},
      BuildSwitch{"likely-falls", kSameDisplacement,
                  [](PlanRules&, Skips& skips) { skips.likely_falls = false; }},
      BuildSwitch{"mirror-images", kSameDisplacement,
                  [](PlanRules& rules, Skips&) { rules.mirror_images = false; }},
      // of random bridges, one outcome in a thousand (docs/speed.md)
      BuildSwitch{"near-falls", kNothing, [](PlanRules&, Skips& skips) { skips.near_falls = false; }},
      BuildSwitch{"settled-contacts", kSameDisplacement,
                  [](PlanRules&, Skips& skips) { skips.settled_contacts = false; }},
      BuildSwitch{"shared-analysis", kNothing,
                  [](PlanRules&, Skips& skips) { skips.shared_analysis = false; }},
      BuildSwitch{"warm-starts",
                  kSameFall,  // what a pair's singles do is not known, and no motion begins early
                  [](PlanRules& rules, Skips&) { rules.warm_starts = false; }}};
  return kSwitches;
}

const BuildSwitch& build_switch(std::string_view name) {
  return *std::ranges::find(build_switches(), name, &BuildSwitch::name);
}

}  // namespace voussoir
