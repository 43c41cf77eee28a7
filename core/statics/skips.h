#pragma once
/// @file What solvers leave out because a scene does not need it. Each can be switched on its own, so that
/// its gain and what it changes can be measured (tools/benchmarks/accuracy.h).

namespace voussoir {

struct Skips {
  bool shared_analysis = true;  ///< ordering and fill are found once for all scenes. Changes nothing
  bool lane_refill = true;      ///< a lane that finishes takes the next scene at once, instead of waiting for
                                ///< the others. Changes nothing
  bool settled_contacts = true;  ///< contacts are looked for anew when blocks have moved, instead of in every
                                 ///< step. Changes round-off
  bool early_outcome = true;     ///< a search that makes little progress ends after three steps instead of
                                 ///< thirty, and a plain collapse at its stated moment instead of at the
                                 ///< earliest decision. Changes fields of standing scenes by less than the
                                 ///< solver's tolerance
  bool likely_falls = true;      ///< a scene of which a part is known to fall is set in motion at once; what
                             ///< comes to rest Newton's method polishes. Changes fields of standing scenes
                             ///< by less than the solver's tolerance
  bool kept_factors = true;   ///< in all stages but the first, and from near starts there, too, a
                              ///< factorisation serves several steps as long as they make progress. Changes
                              ///< fields by less than the solver's tolerance
  bool early_motions = true;  ///< the motion of a pair of which one block's absence alone lets something fall
                              ///< begins where its singles' motions add up to after a third of the ramp.
                              ///< Changes fields of such collapses by some 1e-4
  bool near_falls = true;     ///< where only outcomes are wanted, a scene is set in motion near its missing
                              ///< blocks before all of it is. Changes which blocks are said to move
};

}  // namespace voussoir
