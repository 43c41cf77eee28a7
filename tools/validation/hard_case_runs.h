#pragma once
/// @file Running one setting of a sweep and judging what comes out.

#include <map>

#include "core/statics/quasi_static_solver.h"
#include "core/structure/model.h"
#include "tools/validation/findings.h"

namespace voussoir::validation {

/// A scene, what must come out, and how that is known.
struct Expectation {
  std::string scene;
  Outcome outcome;
  std::string because;
};

struct Setting {
  std::string sweep;
  std::string value;
  Model bridge;
  std::vector<Expectation> scenes;
};

/// Newton's method as near to equilibrium as round-off allows.
QuasiStaticSettings tightest();

/// The small example bridge, whose scenes the sweeps use: intact, a wall block missing (stands), an arch
/// block missing (falls).
BridgeDescription small_bridge();
std::vector<Expectation> usual_scenes();

/// Signals (d - d_intact at the control points; d itself for intact) by scene.
using Signals = std::map<std::string, Eigen::VectorXd>;

/// Of the standing ones among the scenes, by Newton's method as tight as it gets.
Signals tightest_signals(const Model& bridge, const std::vector<Expectation>& scenes);

/// L1 distance over L1 size, where both are numbers.
double relative_difference(const Eigen::VectorXd& a, const Eigen::VectorXd& b);

/// Solves the setting's scenes as build-database does. A verdict is correct if it is the expected one, and
/// where that is standing, if the field is finite, in equilibrium (assembled anew from the field alone) and
/// its signal within `tolerance` of the reference: the tightest run of the setting itself, or the one given.
void run_setting(const Setting& setting, double tolerance, const Signals* reference, Findings& findings);

}  // namespace voussoir::validation
