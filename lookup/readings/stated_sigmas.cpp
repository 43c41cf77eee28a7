#include "lookup/readings/stated_sigmas.h"

#include <cmath>

#include "core/error.h"
#include "core/text.h"
#include "core/units.h"

namespace voussoir {
namespace {

bool all_state_sigmas(const Measurements& measured) {
  for (std::size_t i = 0; i < measured.displacement.size(); ++i)
    if (!std::isnan(measured.displacement[i]) && std::isnan(measured.sigma[i])) return false;
  return true;
}

}  // namespace

double parse_sigma(std::string_view text) {
  std::string_view digits = text;
  if (digits.ends_with("mm")) digits.remove_suffix(2);
  const std::optional<double> number = parse_number(trimmed(digits));
  if (!number || !is_sigma(*number))
    throw InputError(fmt::format("{} given, expected millimetres from {:g} to {:g}, such as 0.02mm",
                                 in_quotes(text), kSmallestSigma, kLargestSigma));
  return kMetresPerMillimetre * *number;
}

NoiseModel noise_of(const Measurements& measured, NoiseModel wanted) {
  if (!all_state_sigmas(measured)) return wanted;
  wanted.relative = 0.0;
  if (wanted.shape == NoiseShape::automatic) wanted.shape = NoiseShape::gaussian;
  return wanted;
}

}  // namespace voussoir
