#include "core/motion/decision_rules.h"

#include <algorithm>

#include "core/structure/collapse.h"

namespace voussoir {

DecisionRules patient_rules(DecisionRules rules) {
  // Measured on the reference bridge: a bridge at rest goes below 1e-7 of its weight within a second; a block
  // that creeps keeps 4e-3 and more of its own weight unbalanced.
  rules.standing_unbalance = 1e-7;
  rules.collapsing_unbalance = 1e-3;
  rules.latest_decision = 4.0;
  // Damping holds what creeps: one that is nearly balanced moves away within 0.4 s without it, and what rests
  // stays at rest. Blocks that rattle, which only damping holds, would be shaken apart.
  rules.freer_from = 1.0;
  rules.freer_unbalance = 2.3e-4;
  rules.freer_until = 2.5;
  rules.freer_damping = 0.05;
  return rules;
}

DecisionRules far_fall_rules(DecisionRules rules) {
  rules.moving_sags = kGoneSags;
  return rules;
}

DecisionRules patch_rules(DecisionRules rules) {
  rules.moving_sags = 6.0;  // by two, as in the whole bridge, 21 of 99 would fall that rest (docs/speed.md)
  return rules;
}

double moved_away(const DecisionRules& rules, double sag, double block) {
  return std::min(rules.moving_sags * sag, kGoneShare * block);
}

}  // namespace voussoir
