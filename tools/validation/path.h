#pragma once
/// @file Following equilibria along a path, in steps: how a structure gives way when supports are moved, what
/// its strongest resistance is, and what comes after it.

#include <Eigen/SparseCore>
#include <vector>

#include "core/statics/equilibrium.h"

namespace voussoir::validation {

struct PathSettings {
  int steps = 50;  ///< equal ones; each is cut where Newton's method fails
  double tolerance =
      1e-6;  ///< largest unbalanced force over the largest force of a support or load so far [-]
  int most_iterations = 16;        ///< of a step
  double smallest_step = 1.0 / 8;  ///< of a step that is cut; below it a snap is followed
  int most_snap_steps = 400;       ///< before the path ends
};

/// An equilibrium on the path.
struct PathPoint {
  double share = 0.0;  ///< of the way from the stage before
  State state;
  Field support_forces;     ///< [N] 2 x nodes, by which supports hold the structure
  double dissipated = 0.0;  ///< by mortar since the path's start [J]
  bool snapped = false;     ///< no equilibrium was near: the structure has jumped here
  int iterations = 0;       ///< linear systems
};

/// Two stages of the same scene, and the state at the first one's end.
struct PathTask {
  Stage from;
  Stage to;
  State start;
};

struct Path {
  std::vector<PathPoint> points;  ///< the start is not among them
  bool complete = false;          ///< false: no equilibrium was found beyond the last point
};

/// Goes from one stage to the other in a straight line: loads, gravity, temperature and the supports'
/// movement all in the same share. The joints' memory is taken over at the end of every step. Where no
/// equilibrium is near, because the structure snaps, it is held back by forces proportional to the way from
/// where it is, which are let go step by step: what a very viscous bath would do.
Path follow_path(const EquilibriumSystem& system, const Coefficients& coefficients, const PathTask& task,
                 const PathSettings& settings = {});

}  // namespace voussoir::validation
