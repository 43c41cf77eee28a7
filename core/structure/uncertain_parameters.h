#pragma once
/// @file The uncertain parameters of a bridge, in a fixed order, and what values of them make of it.
///
/// Of the bridge: the common factors (stiffness, p_t / p_n, friction, Young's modulus, density) and then the
/// own factor of each pair of blocks that meet, on all their joints: one part of it is of the pair alone, one
/// is alike in pairs that are near each other (correlation_by_distance.h). Of an epoch: the temperature, what
/// each support can do, and a factor on the stiffness of all joints, as damp and frost may change it. A
/// factor is exp(s theta), s = sqrt(ln(1 + c^2)) with its coefficient of variation c, so that theta = 0 is
/// the bridge as its file states it; a joint's own is exp(s theta - s^2/2), whose mean is 1. What is known
/// exactly (standard deviation 0) is no parameter.

#include <Eigen/Core>
#include <cstdint>
#include <span>

#include "core/structure/model.h"
#include "core/structure/stage.h"
#include "core/structure/uncertain_parameter.h"

namespace voussoir {

/// Names of parameters of an epoch that are not a support's.
inline constexpr char kTemperature[] = "temperature";
inline constexpr char kEpochStiffness[] = "joint stiffness";

/// What a parameter acts on.
enum class UncertainQuantity {
  stiffness,        ///< p_n and p_t of the joints
  stiffness_ratio,  ///< p_t of the joints
  friction,         ///< tan(phi) of the joints
  young_modulus,
  density,
  temperature,
  movement_x,  ///< of a support
  movement_y,
  rotation  ///< counter-clockwise about the middle of the support's nodes
};

struct UncertainAction {
  UncertainQuantity quantity;
  UncertainParameter parameter;
  std::vector<std::size_t> joints{};  ///< that it acts on; ascending
  std::size_t support = 0;            ///< of movements: place in Structure::supports
  bool has_mean_one = false;          ///< the factor's mean is 1; otherwise its median
  std::vector<std::size_t> blocks{};  ///< of temperatures: that it acts on, ascending; none: all
};

struct UncertainParameters {
  std::vector<UncertainAction> of_bridge;
  std::vector<UncertainAction> of_epoch;
  Eigen::MatrixXd correlation_factor;  ///< lower triangular: of_bridge's parameters are it times as many
                                       ///< independent standard normal ones. An epoch's are independent

  /// Those of the bridge, then those of an epoch.
  std::vector<UncertainParameter> all() const;
};

UncertainParameters uncertain_parameters(const Structure& structure, const Uncertainty& uncertainty);

/// Are there any? The same as asking uncertain_parameters, without correlating those of all joints.
bool has_uncertain_parameters(const Structure& structure, const Uncertainty& uncertainty);

/// Standard deviation of the logarithm of a lognormal factor with this coefficient of variation.
double log_deviation(double variation);

/// An action on the stiffness of each pair of blocks that meet, on all stretches of their joint; none if the
/// standard deviation of its logarithm is 0.
std::vector<UncertainAction> own_stiffness(const Structure& structure, double deviation);

/// Of each action the middle of the first of its joints [m]. Precondition: it has some.
std::vector<Point> places_of(std::span<const UncertainAction> actions, const Structure& structure);

/// The bridge's parameters if the standardised uncertain ones have these values. Precondition: one value for
/// each parameter of the bridge.
Parameters parameters_at(const Model& bridge, const UncertainParameters& uncertain,
                         const Eigen::VectorXd& theta);

/// The stage in an epoch in which the parameters of an epoch have these values: with its temperature, the
/// movements of the supports and the joints' stiffness. Precondition: one value for each of them.
Stage in_epoch(Stage stage, const Structure& structure, const UncertainParameters& uncertain,
               const Eigen::VectorXd& theta);

/// Independent standard normal numbers, the same on every machine for the same seed and count.
Eigen::VectorXd sampled_theta(std::size_t count, std::uint64_t seed);

/// The bridge's parameters with uncertain ones drawn at random.
Parameters sampled_parameters(const Model& bridge, const UncertainParameters& uncertain, std::uint64_t seed);

/// The bridge with them. It has no mirror symmetry.
Model sampled(const Model& bridge, const Uncertainty& uncertainty, std::uint64_t seed);

/// Displacements [m], 2 x nodes, of the supports' nodes if the parameter's quantity has this value [m or
/// rad]; zero if it is no movement.
Field movement_of(const Structure& structure, const UncertainAction& action, double value);

}  // namespace voussoir
