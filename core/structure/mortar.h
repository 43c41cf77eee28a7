#pragma once
/// @file What glues the faces of a joint, and which joints have it.

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace voussoir {

/// Glue until it is worn away; then the joint is dry (core/law/cohesive_law.h).
struct Mortar {
  double tensile_strength = 0.0;                                          ///< f_t [Pa]; 0: no mortar
  double opening_energy = 0.0;                                            ///< G_I [J/m2], mode I
  double cohesion = 0.0;                                                  ///< c [Pa]
  double slip_energy = 0.0;                                               ///< G_II [J/m2], mode II
  double friction_angle = 0.0;                                            ///< of the intact mortar [rad]
  double compressive_strength = std::numeric_limits<double>::infinity();  ///< f_m [Pa]
  double crushing_energy = std::numeric_limits<double>::infinity();       ///< G_c [J/m2]

  bool is_there() const { return tensile_strength > 0.0; }
  double friction_coefficient() const { return std::tan(friction_angle); }
  friend bool operator==(const Mortar&, const Mortar&) = default;
};

/// Joints that have a mortar of their own, and stiffnesses if these are given.
struct MortarRegion {
  Mortar mortar;                                 ///< may be none: these joints are dry
  std::optional<double> normal_stiffness{};      ///< [Pa/m]
  std::optional<double> tangential_stiffness{};  ///< [Pa/m]
  bool within_blocks = false;          ///< the joints in the middle of halved blocks, instead of all others
  std::vector<std::string> between{};  ///< roles or labels: two, of the joint's two blocks; empty: any
};

}  // namespace voussoir
