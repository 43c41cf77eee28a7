#pragma once
/// @file Derivatives of one scene's states by what is uncertain of the bridge.

#include "core/solve/state_history.h"
#include "generator/uncertainty/sensitivities.h"

namespace voussoir {

/// What all threads share.
struct SensitivityEquations {
  SensitivityEquations(const Model& bridge, UncertainParameters parameters)
      : system(bridge),
        coefficients(system, bridge.parameters),
        uncertain(std::move(parameters)),
        readings(reading_columns(bridge, bridge.control_points)) {}

  EquilibriumSystem system;
  Coefficients coefficients;
  UncertainParameters uncertain;
  Eigen::MatrixXd readings;  ///< of the control points
};

/// One a thread. The study and the equations outlive it.
class SceneDerivatives {
 public:
  SceneDerivatives(const SensitivityStudy& study, const SensitivityEquations& equations);

  /// The steps that end in the state of the plan; nothing if the scene does not stand. `states` are the
  /// scene's and `intact` the intact bridge's.
  std::optional<SolvedHistory> history(const Scene& scene, std::size_t state, const SceneStates& states,
                                       const SceneStates& intact) const;

  /// Points x parameters [m per standard deviation] at their end; empty if the scene does not stand.
  Eigen::MatrixXd of(const Scene& scene, std::size_t state, const SceneStates& states,
                     const SceneStates& intact);

 private:
  StateEquations equations_;
  const Eigen::MatrixXd& readings_;
  SensitivitySolver derivatives_;
};

}  // namespace voussoir
