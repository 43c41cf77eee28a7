#pragma once
/// @file The phases of Newton's search, and how each of them behaves.

#include "core/statics/quasi_static_solver.h"

namespace voussoir {

/// The phases of a search. It begins with `warm` from a given start and with `quick` from rest; with
/// `descending` instead of either where the settings say patient_first; with `patient` where its task does.
/// What follows on a phase that finds no equilibrium is said beside it; the search ends instead if that is to
/// have no factorisations (most_iterations).
enum class SearchPhase {
  warm,        ///< from a given start. Then `descending`, if the settings say descends_near and the structure
               ///< has not moved as far as what falls; otherwise `quick`
  descending,  ///< with less unbalance after every step, given up soon when that falls no more. Then `bold`
               ///< where the settings say patient_first; otherwise `quick`
  quick,       ///< from rest, given up where the first few steps make little progress. Then `falling` where
               ///< the settings say follow_falls; otherwise `bold`
  bold,        ///< from where the search is, a few bolder steps, which cross what others cannot. The last: in
               ///< vain, the search ends where it was before them
  falling,     ///< from where the search is, bolder steps for longer: does something fall? Then `patient`
  patient,     ///< from rest, or from the start of its task, with less unbalance after every step, given up
               ///< late. The last
  done
};

/// How a phase behaves.
struct PhaseRules {
  double largest_step;    ///< in units of the largest displacement so far; loose blocks would jump further
  double rise;            ///< that a step may make of the worst of the last residuals
  int given_up_after;     ///< so many steps if the residual is not `promising` by then
  double promising;       ///< below this share of the residual after the first step
  int most_stalled;       ///< steps without progress after which the phase is given up
  bool descends = false;  ///< every step but the first must leave less unbalance than there was
};

const PhaseRules& rules_of(SearchPhase phase);

/// Factorisations after which a phase is given up; 0: it is left out.
int most_iterations(SearchPhase phase, const QuasiStaticSettings& settings);

}  // namespace voussoir
