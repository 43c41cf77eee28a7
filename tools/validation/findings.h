#pragma once
/// @file What a study of the solvers finds: known answers, hard cases, plots.

#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/statics/solution.h"

namespace voussoir::validation {

/// One known answer beside what the solvers make of it.
struct Case {
  std::string name = {};
  std::string quantity = {};  ///< with its unit
  double expected = 0.0;
  std::string source = {};  ///< of the expected value
  double computed = 0.0;
  double error = 0.0;                    ///< relative, or absolute where the expected value is zero
  std::optional<double> tolerance = {};  ///< of the error; empty: a comparison, without a mark
  std::string reason = {};               ///< why this tolerance, or why there is none

  bool within() const { return !tolerance || error <= *tolerance; }  // NaN is not
};

/// Error relative to the expected value. Precondition: that is not zero.
Case relative_case(Case known, double tolerance, std::string reason);
/// Error in the quantity's own unit.
Case absolute_case(Case known, double tolerance, std::string reason);
/// Relative error, no mark.
Case comparison(Case known, std::string reason);

/// One run of a sweep towards the limits of the numerics.
struct HardCase {
  std::string sweep = {};    ///< what is varied
  std::string setting = {};  ///< its value, with the unit
  std::string scene = {};
  std::string verdict = {};
  std::string expected = {};         ///< and how it is known
  std::optional<double> error = {};  ///< of the signal (of d for the intact bridge) against the tightest run
  int iterations = 0;
  bool correct = false;
};

struct Series {
  std::string label = {};
  std::vector<std::pair<double, double>> points = {};
  bool line = true;  ///< false: points only
};

struct Plot {
  std::string title = {};
  std::string x_label = {};
  std::string y_label = {};
  bool log_x = false;
  bool log_y = false;
  std::vector<Series> series = {};
};

struct Findings {
  std::vector<Case> cases = {};
  std::vector<HardCase> hard_cases = {};
  std::vector<Plot> plots = {};
  std::vector<std::string> notes = {};  ///< sentences: limits found, costs
};

/// A group of runs that belong together.
struct Study {
  std::string name = {};  ///< short, for filters: "arch-thickness"
  std::string title = {};
  bool quick = true;  ///< part of every test run
  std::function<Findings()> run = {};
};

}  // namespace voussoir::validation
