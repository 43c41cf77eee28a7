#pragma once
/// @file How much a database's settlements change with what nobody knows exactly of the bridge, to first
/// order, and what the first order leaves.
///
///   d(theta) = d + A z + E epsilon + residual,   z = V^T (theta of the bridge),   epsilon = theta of the
///   epoch
///
/// d: vertical displacements of the control points [m], up is positive, as they are stored. All theta are
/// standardised, so z and epsilon have independent entries of variance 1. What readings say of z they say of
/// the bridge's parameters, too: theta = V z and what V leaves out, of which they say nothing.

#include <Eigen/Core>
#include <algorithm>
#include <optional>
#include <vector>

#include "core/structure/scene.h"
#include "core/structure/uncertain_parameter.h"
#include "database/records/stacked_matrices.h"
#include "database/records/stored_signals.h"

namespace voussoir {

/// Derivatives of one scene's displacements at the control points in one state [m per standard deviation].
/// Rows of points whose block is gone are zero. Both empty: not known, because the scene stands neither in
/// the nominal bridge nor in any that was drawn at random.
struct SceneFactors {
  Eigen::MatrixXd bridge;  ///< A: points x columns of the basis
  Eigen::MatrixXd epoch;   ///< E: points x parameters of an epoch
  /// What E leaves of what an epoch changes of the scene's signal d - d(intact), in each of some sampled
  /// bridges and over the root of their number: points x bridges. Zero where it does not stand in a bridge,
  /// and of the intact bridge.
  Eigen::MatrixXd left{};

  bool known() const { return bridge.rows() > 0; }
};

/// What the first order leaves, in one state, found by solving bridges with parameters drawn at random. The
/// columns are the same in all states of a database: what a load adds is off by their differences.
struct FirstOrderResidual {
  /// The intact bridge's displacements: covariance bridge * bridge^T [m2], the same error in every epoch.
  Eigen::MatrixXd bridge;  ///< points x any number of columns
  /// What an epoch's own parameters add: epoch * epoch^T [m2], an error of its own in every epoch.
  Eigen::MatrixXd epoch;  ///< points x any number of columns
  /// A scene's signal d - d(intact): at point i the error has the standard deviation
  ///     sqrt((share s_i)^2 + (common rms(s))^2),
  /// s_i being that of the signal to first order: the norm of row i of A - A_intact; rms over the points that
  /// the scene has.
  double share = 0.0;   ///< [-]
  double common = 0.0;  ///< [-]
  /// The same of what an epoch's own parameters add to a signal, s_i of E - E_intact; an error of its own in
  /// every epoch. It counts as far as no sampled bridges show the scene's own (SceneFactors::left).
  double epoch_share = 0.0;   ///< [-]
  double epoch_common = 0.0;  ///< [-]
};

/// The same in place, where they are kept.
struct FactorsView {
  StackedMatrices::View bridge, epoch, left;
};

/// A scene that falls in the nominal bridge, but stands in some of those drawn at random.
struct UncertainFall {
  double standing_share = 0.0;  ///< of those drawn at random, how many stand
  Eigen::VectorXd if_standing;  ///< [m] what the points of the nominal bridge would read if it stood, to
                                ///< first order; zero where the block is gone
};

/// Places on the top of a bridge that what a load adds is kept for, at most.
inline constexpr std::size_t kMostLoadPlaces = 201;

/// What a load that stands on the top adds to the intact bridge's readings under its own weight.
struct LoadInfluence {
  std::vector<double> places;  ///< x along the top, ascending [m]
  /// Points x places: of a force down of 1 N for each metre of the bridge's width [m per N/m].
  Eigen::MatrixXd readings;
};

/// Are a scene's factors known in a state? As they stand in a file.
enum class FactorsKnown : std::uint8_t {
  no = 0,
  yes = 1,
  of_uncertain_fall = 2  ///< it falls in the nominal bridge, but stands in some of those drawn at random
};

/// What a build makes, or what a file holds, whose factors stay where they are: they outlive this.
struct Sensitivities {
  std::vector<UncertainParameter> parameters;  ///< those of the bridge, then those of an epoch
  Eigen::MatrixXd basis;                       ///< L V: parameters of the bridge x columns, V orthonormal
  std::vector<Scene> scenes;           ///< ascending by missing blocks, then lexicographic: intact first
  std::vector<FactorsKnown> known;     ///< states x scenes
  StackedMatrices bridge;              ///< states x scenes: A, zero where nothing is known
  StackedMatrices epoch;               ///< states x scenes: E
  StackedMatrices left;                ///< states x scenes: what E leaves of signals in sampled bridges
  std::vector<double> standing_share;  ///< states x scenes: of uncertain falls, 0 of others; or nothing, if
                                       ///< there are none
  StackedMatrices if_standing;         ///< states x scenes: a column, of uncertain falls
  std::vector<FirstOrderResidual> residuals;  ///< of each state of the database
  /// What differs from part to part in an epoch (core/structure/unevenness.h) changes of the intact bridge
  /// [m], an error of its own in every epoch: of each state, points x columns that are independent and the
  /// same in all states. Empty: all is even.
  std::vector<Eigen::MatrixXd> unevenness;
  LoadInfluence load;                    ///< no places: nothing is known of it
  std::optional<StoredSignals> signals;  ///< as a file keeps them

  Eigen::Index of_bridge() const { return basis.rows(); }  ///< parameters of the bridge
  Eigen::Index of_epoch() const { return static_cast<Eigen::Index>(parameters.size()) - basis.rows(); }
  Eigen::Index leading_columns() const { return std::min(kLeadingColumns, basis.cols()); }

  bool is_known(std::size_t place) const { return known[place] != FactorsKnown::no; }

  /// Room for factors of all scenes at so many points, of which nothing is known yet, and for residuals; no
  /// uncertain falls.
  /// `samples`: bridges that show what E leaves of signals.
  void make_room(std::size_t states, Eigen::Index points, Eigen::Index samples = 0);
  /// Takes in what is known of a scene, or that nothing is.
  void set(std::size_t state, std::size_t scene, const SceneFactors& factors);

  /// Precondition: its factors are known.
  void set_fall(std::size_t state, std::size_t scene, const UncertainFall& fall);

  /// The scene's place in `known`, `bridge`, `epoch` and `left`; nothing if nothing is known of it.
  /// Precondition: the state exists.
  std::optional<std::size_t> place_of(std::size_t state, const Scene& scene) const;
  /// What is known of a scene in a state. Throws InputError if the file has a number there that is not
  /// finite.
  std::optional<FactorsView> find(std::size_t state, const Scene& scene) const;
  /// Nothing if it is none. Throws as find.
  std::optional<UncertainFall> find_fall(std::size_t state, const Scene& scene) const;
};

/// The order of Sensitivities::scenes.
bool precedes(const Scene& first, const Scene& second);

/// Looks at all factors, one scene after the other. Throws InputError if a number is not finite; false if
/// there are factors of scenes of which nothing is known, or readings of what is no uncertain fall, or if
/// something is left of the intact bridge's signal.
bool are_factors_sound(const Sensitivities& sensitivities);

}  // namespace voussoir
