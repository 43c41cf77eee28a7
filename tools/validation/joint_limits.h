#pragma once
/// @file Limits of elastic joints, and what rigid ones would have.

#include <functional>
#include <vector>

#include "core/structure/model.h"

namespace voussoir::validation {

/// Does Newton's method find an equilibrium? `start` is that of a bridge near this one, or empty, and becomes
/// this one's.
bool newton_stands(const Model& bridge, Field& start, const Field& load = {});

/// A limit against the joints' stiffness.
struct Limit {
  std::vector<double> roots;   ///< cube roots of the compliance
  std::vector<double> values;  ///< the limit at each
  double rigid = 0.0;          ///< extrapolated with the polynomial through all but the softest point
  double spread = 0.0;         ///< how far straight and curved extrapolation differ
};

/// Compliance of the joints, made dimensionless: the settlement under a column as high as the radius (1 m),
/// over the radius.
double compliance(double normal_stiffness);

/// `value` of each stiffness [Pa/m], ascending.
Limit find_limit(const std::vector<double>& stiffnesses, const std::function<double(double)>& value);

inline constexpr const char* kExtrapolation =
    "hinges of elastic joints cost a share of (rho g R / p_n)^(1/3); what curving the extrapolation changes, "
    "and the digits of the source";

}  // namespace voussoir::validation
