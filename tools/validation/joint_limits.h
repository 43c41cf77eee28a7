#pragma once
/// @file Limits of elastic joints, and what rigid ones would have.

#include <functional>
#include <vector>

#include "core/structure/model.h"

namespace voussoir::validation {

/// Does Newton's method find an equilibrium? `start` is that of a bridge near this one, or empty, and becomes
/// this one's.
bool newton_stands(const Model& bridge, Field& start, const Field& load = {});

/// The least value down to which equilibria go on: in steps from `from`, where the bridge stands, each from
/// what the last two equilibria promise, halved where there is none down to `width`. Near a limit of stiff
/// joints Newton's method finds equilibria only from close by.
double continued_down(double from, double step, double width, const std::function<Model(double)>& bridge_of);

/// A limit against the joints' stiffness.
struct Limit {
  std::vector<double> roots;   ///< the power of the compliance
  std::vector<double> values;  ///< the limit at each
  double rigid = 0.0;          ///< extrapolated with the polynomial through all but the softest point,
                               ///< and through three at least
  double spread = 0.0;         ///< how far straight and curved extrapolation differ
};

/// Compliance of the joints, made dimensionless: the settlement under a column as high as the radius (1 m),
/// over the radius.
double compliance(double normal_stiffness);

/// Limits of elastic joints approach those of rigid ones as the compliance to this power.
inline constexpr double kAtLimit = 1.0 / 3.0;
/// A hinge that has turned by a given angle presses over a width that goes with the square root of the
/// compliance.
inline constexpr double kAtGivenTurn = 1.0 / 2.0;

/// [Pa/m] Hinges of the softest are a hundredth of the radius wide, a fraction of the thinnest ring.
inline const std::vector<double> kStiffForThinRings = {1e10, 1e11, 1e12};

/// `value` of each stiffness [Pa/m], ascending, extrapolated in this power of the compliance.
Limit find_limit(const std::vector<double>& stiffnesses, const std::function<double(double)>& value,
                 double power = kAtLimit);

inline constexpr const char* kExtrapolation =
    "hinges of elastic joints cost a share of (rho g R / p_n)^(1/3); what curving the extrapolation changes, "
    "and the digits of the source";

}  // namespace voussoir::validation
