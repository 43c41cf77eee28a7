#pragma once
/// @file Run time against error of the solvers, over a fixed set of scenes.

#include <string>
#include <vector>

#include "core/structure/bridge_description.h"

namespace voussoir {

/// One way to solve scenes, and what it costs and misses.
struct AccuracyRow {
  std::string solver;
  std::string integrator;
  std::string step;    ///< time step or tolerance
  std::string joints;  ///< how the joint law is integrated
  std::string ramp;
  std::string mesh;
  std::string variation;       ///< what is switched off, if anything
  double seconds = 0.0;        ///< of processor time a scene
  double signal_error = 0.0;   ///< L1, relative: of the change that the removal makes at the control points
  double largest_error = 0.0;  ///< largest error of a control point's displacement [m]
  bool is_default = false;
};

struct AccuracyOptions {
  std::vector<std::string> scenes = {"10,4", "6,4", "2,6", "4,10", "8,12", "4,2+11,3", "4,10+2,6"};
  int reference_refinement = 2;  ///< of the mesh of the quasi-static reference
  bool plain = false;            ///< also plain central differences: minutes a scene, one scene only
};

/// Measures all rows. Throws InputError for unknown scenes, Failure if the reference does not stand.
std::vector<AccuracyRow> measure_accuracy(const BridgeDescription& description,
                                          const AccuracyOptions& options);

/// As a table in Markdown.
std::string to_markdown(const std::vector<AccuracyRow>& rows);

/// As a plot of error over time, both logarithmic.
std::string to_svg(const std::vector<AccuracyRow>& rows);

}  // namespace voussoir
