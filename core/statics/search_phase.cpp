#include "core/statics/search_phase.h"

#include <limits>

namespace voussoir {
namespace {

constexpr int kForever = std::numeric_limits<int>::max();
/// Of 390 singles of stiff random bridges those that fall take 13 linear systems so, and 11 of the 209 that
/// stand are left to later searches.
constexpr int kFewStalled = 5;
/// Few would do for the reference bridge, but two of 24 other bridges would have no answer intact.
constexpr int kManyStalled = 30;
/// Nine of ten standing scenes have a hundredth of the residual after three steps, falling ones more than a
/// half.
constexpr PhaseRules kQuick{
    .largest_step = 0.5, .rise = 1.0, .given_up_after = 3, .promising = 0.3, .most_stalled = kFewStalled};
/// A residual that may rise lets joints open and close in turn for ever (docs/speed.md).
constexpr PhaseRules kPatient{.largest_step = 0.5,
                              .rise = 1.0,
                              .given_up_after = kForever,
                              .promising = 0.0,
                              .most_stalled = kManyStalled,
                              .descends = true};
constexpr PhaseRules kDescending = [] {
  PhaseRules rules = kPatient;
  rules.most_stalled = kFewStalled;
  return rules;
}();
constexpr PhaseRules kBold{
    .largest_step = 2.0, .rise = 3.0, .given_up_after = kForever, .promising = 0.0, .most_stalled = kForever};

}  // namespace

const PhaseRules& rules_of(SearchPhase phase) {
  switch (phase) {
    case SearchPhase::bold:
    case SearchPhase::falling:
      return kBold;
    case SearchPhase::descending:
      return kDescending;
    case SearchPhase::patient:
      return kPatient;
    case SearchPhase::warm:
    case SearchPhase::quick:
    case SearchPhase::done:
      break;
  }
  return kQuick;
}

int most_iterations(SearchPhase phase, const QuasiStaticSettings& settings) {
  switch (phase) {
    case SearchPhase::warm:
      return settings.most_warm_iterations;
    case SearchPhase::bold:
      return settings.most_bold_iterations;
    case SearchPhase::falling:
      return settings.most_falling_iterations;
    case SearchPhase::descending:
    case SearchPhase::patient:
      return settings.most_patient_iterations;
    case SearchPhase::quick:
    case SearchPhase::done:
      break;
  }
  return settings.most_iterations;
}

}  // namespace voussoir
