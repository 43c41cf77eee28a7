#pragma once
/// @file Blocks that go when the bridge already carries its weight, in motion: the independent answer to the
/// history `lost` (tools/validation/history.h).

#include <memory>

#include "core/motion/dynamic_solver.h"

namespace voussoir::validation {

/// How the blocks go.
struct Release {
  double duration = 1.0;  ///< what they carried is let go over this time, as 3 x^2 - 2 x^3; 0: suddenly [s]
  double damping = 4.0;   ///< of the bridge from then on, times the solver's

  static Release sudden() { return {.duration = 0.0, .damping = 1.0}; }
};

/// Those of all blocks, with the joints as they are: in longer ones a loose block trembles more, and a loaded
/// bridge is followed on joints that are not softened, for which the step of softened ones is too long.
inline DynamicSettings short_steps() {
  DynamicSettings settings;
  settings.most_parts = 1;
  settings.least_step = 0.0;
  return settings;
}

struct LoadingSettings {
  DynamicSettings motion = short_steps();  ///< step, damping, integration; the ramp is this:
  double ramp = 3.0;                       ///< gravity grows over this time [s]
  double rest = 1e-7;  ///< the bridge rests when no more of its weight is unbalanced (sum over the blocks) ..
  double rest_time = 0.1;   ///< .. for this long [s]
  double longest = 6.0;     ///< that a motion is followed [s]
  double trembling = 1e-5;  ///< unbalanced weight up to which a bridge stands at the end of that, too: a
                            ///< loose block may tremble on
};

/// The intact bridge at rest under its weight, out of which blocks are taken. The joints keep their slip. The
/// model must outlive it.
class LoadedBridge {
 public:
  explicit LoadedBridge(const Model& model, const LoadingSettings& settings = {});
  ~LoadedBridge();
  LoadedBridge(LoadedBridge&&) noexcept;
  LoadedBridge& operator=(LoadedBridge&&) noexcept;

  /// Before anything is taken out. `time` since the start of loading.
  const DynamicSolution& intact() const;

  /// The bridge at rest again without the scene's blocks: their forces on their neighbours fade and they are
  /// gone. If it does not stand when its motion is followed no longer, `collapsed` if blocks have moved away
  /// by then (DecisionRules::moving_sags), otherwise `unresolved`. `time` since the start of the release.
  DynamicSolution without(const Scene& scene, const Release& release = {}) const;

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace voussoir::validation
