#include "lookup/readings/noise_model.h"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.h"
#include "core/text.h"

namespace voussoir {
namespace {

constexpr std::array<std::string_view, 5> kShapeNames = {"auto", "uniform", "gaussian", "laplace", "student"};

/// Student's t with `nu` degrees of freedom, scaled to a standard deviation of one.
double log_student(double z, double nu) {
  const double scale_square = (nu - 2.0) / nu;
  const double constant = std::lgamma((nu + 1.0) / 2.0) - std::lgamma(nu / 2.0) -
                          0.5 * std::log(nu * std::numbers::pi * scale_square);
  return constant - (nu + 1.0) / 2.0 * std::log1p(z * z / (nu * scale_square));
}

/// "5%" or "0.05"; nothing unless it is from 0 to 1.
std::optional<double> parse_share(std::string_view text) {
  const bool percent = text.ends_with('%');
  const std::optional<double> number = parse_number(text.substr(0, text.size() - (percent ? 1 : 0)));
  const double share = number ? *number * (percent ? 0.01 : 1.0) : -1.0;
  return share >= 0.0 && share <= 1.0 ? std::optional(share) : std::nullopt;
}

}  // namespace

double log_density(NoiseShape shape, double z, double degrees_of_freedom) {
  switch (shape) {
    case NoiseShape::uniform:
      return std::abs(z) <= 1.0 ? -std::numbers::ln2 : -std::numeric_limits<double>::infinity();
    case NoiseShape::laplace:
      return -std::numbers::ln2 / 2.0 - std::numbers::sqrt2 * std::abs(z);
    case NoiseShape::student:
      return log_student(z, degrees_of_freedom);
    default:
      return -0.5 * std::log(2.0 * std::numbers::pi) - 0.5 * z * z;
  }
}

double standard_deviation(NoiseShape shape) {
  return shape == NoiseShape::uniform ? std::numbers::inv_sqrt3 : 1.0;
}

std::string_view to_string(NoiseShape shape) {
  return kShapeNames.at(static_cast<std::size_t>(shape));
}

NoiseShape parse_noise_shape(std::string_view text) {
  for (std::size_t i = 0; i < kShapeNames.size(); ++i)
    if (text == kShapeNames.at(i)) return static_cast<NoiseShape>(i);
  throw InputError(fmt::format("{} is no noise model, expected auto, uniform, gaussian, laplace or student",
                               in_quotes(text)));
}

double parse_noise_level(std::string_view text) {
  const std::optional<double> level = parse_share(text);
  if (!level)
    throw InputError(fmt::format(
        "{} is no noise level, expected a share of the displacement such as 5% or 0.05", in_quotes(text)));
  return *level;
}

double parse_chance(std::string_view text) {
  const std::optional<double> chance = parse_share(text);
  if (!chance)
    throw InputError(
        fmt::format("{} is no chance, expected 0 to 100 %, such as 10% or 0.1", in_quotes(text)));
  return *chance;
}

}  // namespace voussoir
