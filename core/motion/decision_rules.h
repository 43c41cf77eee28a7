#pragma once
/// @file When it is said of a scene in motion what has become of it.

namespace voussoir {

/// When a scene in motion has come to rest, and when it falls. Times in seconds of the bridge's own time.
struct DecisionRules {
  double earliest_decision = 0.4;  ///< but for collapses that are plain at the moment of the field
  double latest_decision = 1.0;    ///< a scene that neither rests nor falls by then is unresolved
  double standing_unbalance =
      2.3e-4;  ///< sum of the blocks' resultant forces over the bridge's weight [-], at most
  double collapsing_unbalance =
      0.05;  ///< resultant force on a block over its weight, at least, when blocks have moved away
  double plain_unbalance =
      1e-2;  ///< unbalance over the bridge's weight, at least, of a collapse that is plain at its moment
  double largest_standing_unbalance = 1e-2;  ///< resultant force on a block over its weight, at most
  double moving_sags = 2.0;  ///< blocks that have moved further than this many sags of the bonded bridge, or
                             ///< half a mean block, have moved away
  // What is nearly balanced is damped less for a while: a block that creeps, held by nearly enough friction,
  // falls the sooner.
  double freer_from = 0.0;  ///< when it is looked at whether a scene is
  double freer_unbalance =
      0.0;                     ///< sum of the blocks' resultant forces over the bridge's weight [-], at most
  double freer_until = 0.0;    ///< when it is damped as before again; equal to `freer_from`: never less
  double freer_damping = 1.0;  ///< share of the damping [-] in between
};

/// Rules that follow a motion until friction that nearly holds has let go, or the bridge is really at rest.
DecisionRules patient_rules(DecisionRules rules);

/// Rules by which something falls only when it is far away: bridges with soft joints come to rest after they
/// have sagged fifteen times as far as bonded.
DecisionRules far_fall_rules(DecisionRules rules);

/// Rules for a patch of a bridge (core/structure/patch.h): more has to move before it counts as a fall.
DecisionRules patch_rules(DecisionRules rules);

/// How far blocks move that have moved away [m]. `sag` of the bonded bridge, `block` the size of a mean block
/// [m].
double moved_away(const DecisionRules& rules, double sag, double block);

}  // namespace voussoir
