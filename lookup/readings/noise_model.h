#pragma once
/// @file How readings scatter about the truth.
///
/// The instrument's error of sensor i under a candidate scene has the scale
///     sigma_i = relative * |movement_i| + floor,
/// or the sensor's own sigma where the measurements state one; the movement is the displacement, or the
/// change where changes are read (noise_scale.h). The paper's noise d_i (1 + p U(-1, 1)) is `uniform` with
/// relative = p. The model's own error comes on top (Observation).
///
/// A sensor on a missing block cannot read anything; one on a standing block may fail by itself. So a sensor
/// that is there and silent speaks for the loss of its block, the more so the more reliable sensors are.

#include <optional>
#include <string>
#include <string_view>

namespace voussoir {

enum class NoiseShape {
  automatic,  ///< uniform, Gaussian or Laplace, equally likely beforehand; the readings decide
  uniform,    ///< bounded: sigma_i is the largest possible error
  gaussian,   ///< sigma_i is the standard deviation, here and below
  laplace,    ///< double exponential: forgives single bad readings
  student     ///< Student's t: forgives wild readings
};

struct NoiseModel {
  NoiseShape shape = NoiseShape::automatic;
  std::optional<double> relative{};  ///< [-] of the displacement; nothing: unknown, and marginalised
  double floor = 0.0;                ///< [m] absolute part
  double degrees_of_freedom = 4.0;   ///< of Student's t, more than 2
  double silence = 0.1;              ///< chance that a sensor on a standing block gives no reading
};

/// An unknown level has a prior uniform in its logarithm between these two [-].
inline constexpr double kSmallestLevel = 1e-6;
inline constexpr double kLargestLevel = 0.5;

/// Relative noise counts every displacement as this much [m] larger than it is, so that a point that hardly
/// moves does not have a scale of zero.
inline constexpr double kSmallestMovement = 1e-6;

/// log density of an error z in units of sigma (so the density of the error itself is this minus log sigma).
/// Precondition: shape is not automatic. -infinity outside the bound of the uniform shape.
double log_density(NoiseShape shape, double z, double degrees_of_freedom);

/// Standard deviation of the shape in units of sigma.
double standard_deviation(NoiseShape shape);

/// "uniform", ... ; parse_noise_shape throws InputError naming the text and what was expected.
std::string_view to_string(NoiseShape shape);
NoiseShape parse_noise_shape(std::string_view text);

/// "5%" or "0.05" -> 0.05. Throws InputError unless it is a number from 0 to 1 (100 %).
double parse_noise_level(std::string_view text);

/// The same of a chance.
double parse_chance(std::string_view text);

}  // namespace voussoir
