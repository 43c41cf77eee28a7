#include "lookup/readings/stated_sigmas.h"

#include <cmath>

#include "lookup/readings/millimetres.h"

namespace voussoir {
namespace {

bool all_state_sigmas(const Measurements& measured) {
  for (std::size_t i = 0; i < measured.displacement.size(); ++i)
    if (!std::isnan(measured.displacement[i]) && std::isnan(measured.sigma[i])) return false;
  return true;
}

}  // namespace

double parse_sigma(std::string_view text) {
  return parse_millimetres(text, kSmallestSigma, kLargestSigma);
}

NoiseModel noise_of(const Measurements& measured, NoiseModel wanted) {
  if (!all_state_sigmas(measured)) return wanted;
  wanted.relative = 0.0;
  if (wanted.shape == NoiseShape::automatic) wanted.shape = NoiseShape::gaussian;
  return wanted;
}

}  // namespace voussoir
