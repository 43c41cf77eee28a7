#pragma once
/// @file A number that nobody knows exactly of a bridge.

#include <string>

namespace voussoir {

/// Standardised it is theta, normally distributed with mean 0 and standard deviation 1: one unit of theta
/// changes the quantity, or its logarithm, by `sigma`.
struct UncertainParameter {
  std::string name;       ///< "stiffness 3,4/3,5", "young modulus", "temperature", "base dy"
  std::string unit;       ///< "K", "m", "rad"; "1": of a logarithm
  double sigma = 0.0;     ///< standard deviation, positive
  bool of_epoch = false;  ///< has a value of its own in every epoch; otherwise the bridge has one for good

  friend bool operator==(const UncertainParameter&, const UncertainParameter&) = default;
};

}  // namespace voussoir
