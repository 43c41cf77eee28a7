#pragma once
/// @file Scenes with three missing blocks that need no search: what singles and pairs change adds up to their
/// equilibrium, nearly.

#include <Eigen/Core>
#include <span>

#include "core/solve/state_plan.h"
#include "core/statics/equilibrium.h"
#include "core/statics/solution.h"
#include "generator/scenes/start_field.h"

namespace voussoir {

/// A composed signal (L1, difference from the intact bridge at the points of a family) is off by at most this
/// share of it, or by this much on average over the points [m].
inline constexpr double kComposedShare = 0.01;
inline constexpr double kComposedError = 1e-7;

/// The signal of a field that misses equilibrium by the forces r is off by Z^T r to first order, with Z the
/// intact bridge's displacements under unit forces at the control points (their adjoints, as its joints are
/// not quite symmetric). The bridge with missing blocks is softer: of 740 random triples of the reference
/// bridge, the error was more than 4.0 times that in one of a thousand and 5.6 times at most; with this
/// margin the largest that was taken is 0.38 of what is allowed (docs/numerics.md).
inline constexpr double kComposedMargin = 6.0;

/// How far vertical displacements of the control points [m] are off in L1, over what a composed signal may be
/// off; 0 where they are not off. Points that are gone (NaN) do not count.
double composed_error(std::span<const double> composed, std::span<const double> solved,
                      std::span<const double> intact);

class Composition {
 public:
  Composition() = default;
  /// With the intact bridge's field and equations as built. Composes nothing if its tangent is singular.
  ///
  /// A scene is composed only if the signal at each family of points allows it: at the upper corners of the
  /// top course and the intrados corners, whatever is measured (an equilibrium that few sensors see is none);
  /// at the control points; and, as a scene answers for its mirror image, at those of the image.
  Composition(const StageEquations& intact, const Field& displacement);

  /// Does the scene lack three blocks, and do all singles and pairs within it stand?
  bool has_parts(const Scene& scene, const StartingFields& starts) const;

  /// The start (StartingFields::start_for) of a scene that has its parts, taken for its equilibrium as built;
  /// `equations` are the scene's. Nothing unless the check allows it.
  std::optional<Solution> of(const Scene& scene, const StartingFields& starts,
                             const StageEquations& equations) const;

 private:
  struct Family {
    std::vector<ControlPoint> points;
    Eigen::MatrixXd influence;  ///< Z: displacement components x points [m/N]

    bool allows(const Scene& scene, const Field& signal, const Field& unbalanced) const;
  };

  std::vector<Family> families_;  ///< none: nothing is composed
};

}  // namespace voussoir
