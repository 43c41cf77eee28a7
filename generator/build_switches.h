#pragma once
/// @file The names of what a build skips or shares, each of which can be switched off.

#include <span>
#include <string_view>

#include "core/statics/skips.h"
#include "generator/scenes/build_plan.h"

namespace voussoir {

struct BuildSwitch {
  std::string_view name;
  /// Without it no control displacement as built, of at most two missing blocks, changes by more than this
  /// [m], and no outcome (near-falls: one in a thousand), unless joints are stiffer along than across: there
  /// friction leaves several answers, and a search may find another one. In later states, scenes that
  /// friction hardly holds may come to rest elsewhere (docs/numerics.md).
  double largest_change;
  void (*switch_off)(PlanRules& rules, Skips& skips);
};

/// In alphabetical order.
std::span<const BuildSwitch> build_switches();

/// Precondition: there is a switch of this name.
const BuildSwitch& build_switch(std::string_view name);

}  // namespace voussoir
