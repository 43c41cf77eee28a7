#pragma once
/// @file The likelihood of Gaussian and Laplace errors as a function of the noise level.

#include <cmath>

#include "lookup/evidence/row_statistics.h"
#include "lookup/readings/noise_model.h"

namespace voussoir {

/// log of the density at level exp(u), as constant - count u - a exp(-power u); the Gaussian has power 2 and
/// a = sum z^2 / 2, the Laplace power 1 and a = sqrt(2) sum |z|.
struct LevelCurve {
  double count;
  double a;
  double power;
  double constant;

  double at(double u) const;
  double peak() const;  ///< the u of the maximum over all u; precondition: a > 0
  double peak_between(double first, double last) const;  ///< the u of the maximum between these
};

LevelCurve level_curve(NoiseShape shape, const RowStatistics& statistics, std::size_t count);

inline const double kLogSmallestLevel = std::log(kSmallestLevel);
inline const double kLogLargestLevel = std::log(kLargestLevel);

/// log(kLargestLevel / kSmallestLevel): what the density over log level is divided by.
double log_range();

}  // namespace voussoir
