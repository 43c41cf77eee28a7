#pragma once
/// @file The settings of the solvers as values, and their one text form.

#include <string>
#include <string_view>

#include "core/motion/dynamic_solver.h"
#include "core/statics/quasi_static_solver.h"

namespace voussoir {

enum class SolverKind {
  quasi_static,  ///< Newton for scenes that stand, motion for all others
  dynamic        ///< motion for all scenes: the reference
};

/// Everything beside the model that solutions depend on.
struct SolverSettings {
  SolverKind kind = SolverKind::quasi_static;
  QuasiStaticSettings newton{};  ///< of the quasi-static kind
  DynamicSettings motion{};      ///< of scenes in motion
  DecisionRules patient{};       ///< of the quasi-static kind: for what neither rests nor falls soon
  bool falls_nearby = false;     ///< of the quasi-static kind: scenes are set in motion near their missing
                                 ///< blocks first (near_falls.h), which shows no field of what falls

  /// Newton and motion with these settings of the motion; Newton has its skips.
  static SolverSettings of(SolverKind kind, const DynamicSettings& motion = {});
};

/// The settings that act on this model: where joints are stiff against blocks, or along against across,
/// Newton's search descends; of motion see its own.
SolverSettings acting_settings(SolverSettings settings, const Model& model);

/// "key = value" lines, a key for every setting that acts, named for its phase: "newton.tolerance",
/// "motion.ramp_s".
std::string to_text(const SolverSettings& settings);

/// The inverse; lines with other keys are passed over, and settings that no text states, as they change no
/// answer, are as in `unstated`. Throws Failure naming the line if a key of a solver is missing or its value
/// cannot be read: another version wrote it.
SolverSettings parse_settings(std::string_view text, const SolverSettings& unstated = {});

}  // namespace voussoir
