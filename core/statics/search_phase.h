#pragma once
/// @file The phases of Newton's search, and how each of them behaves.

#include "core/statics/quasi_static_solver.h"

namespace voussoir {

/// The phases of a search, in the order in which they are tried, some of them left out by the settings; or
/// one of those that descend alone.
enum class SearchPhase {
  warm,        ///< from a given start
  descending,  ///< from there on, or at first: the unbalance falling, given up when it falls no more
  quick,       ///< from rest, given up when it has no hope
  bold,        ///< goes on with a few bolder steps, which cross what the others cannot; in vain, the search
               ///< ends where it was before
  falling,     ///< goes on with bolder steps for longer: does something fall?
  patient,     ///< likewise, from rest after the others, with all patience: the last word
  done
};

/// How a phase behaves.
struct PhaseRules {
  double largest_step;    ///< in units of the largest displacement so far; loose blocks would jump further
  double rise;            ///< that a step may make of the worst of the last residuals
  int patience;           ///< steps after which the phase is given up ..
  double promising;       ///< .. unless the residual is below this share of the first step's
  int most_stalled;       ///< steps without progress after which the phase is given up
  bool descends = false;  ///< every step but the first must leave less unbalance than there was
};

const PhaseRules& rules_of(SearchPhase phase);

/// Factorisations after which a phase is given up; 0: it is left out.
int most_iterations(SearchPhase phase, const QuasiStaticSettings& settings);

}  // namespace voussoir
