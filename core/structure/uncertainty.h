#pragma once
/// @file What nobody knows exactly of a real bridge, and how well it is known: the table [uncertainty] of a
/// bridge file. Where the defaults come from: examples/bridges/reference.toml and docs/uncertainty.md.

namespace voussoir {

/// Stiffness, friction, modulus and density are multiplied by lognormal factors, whose coefficients of
/// variation these are; all others are normal, with these standard deviations about zero. 0: known exactly.
struct Uncertainty {
  double joint_stiffness = 0.2;  ///< [-] of each pair of blocks that meet, its own factor on p_n and p_t
  double regional_stiffness =
      0.2;  ///< [-] of p_n and p_t of each pair of blocks, too, but alike where pairs are near
  double common_stiffness = 0.3;  ///< [-] of p_n and p_t of all joints alike
  double stiffness_ratio = 0.3;   ///< [-] of p_t / p_n of all joints alike
  double friction = 0.1;          ///< [-] of tan(phi) of all joints alike
  double young_modulus = 0.25;    ///< [-] of all blocks alike
  double density = 0.05;          ///< [-] of all blocks alike
  double temperature = 10.0;      ///< [K] of the whole bridge in an epoch
  double foot_movement = 1e-3;    ///< [m] of each foot in an epoch, along x and y
  double foot_rotation = 1e-4;    ///< [rad] of each foot in an epoch, about its middle
  double side_movement = 0.5e-3;  ///< [m] of each held side in an epoch
  double epoch_stiffness = 0.05;  ///< [-] of p_n and p_t of all joints alike in an epoch
  double epoch_unevenness =
      0.03;  ///< [-] of p_n and p_t of each joint in an epoch, alike where joints are near
  double uneven_temperature = 1.0;  ///< [K] of each block in an epoch, alike where blocks are near

  friend bool operator==(const Uncertainty&, const Uncertainty&) = default;
};

/// Is anything of the bridge or of an epoch not known exactly?
inline bool is_uncertain(const Uncertainty& uncertainty) {
  return uncertainty != Uncertainty{0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
}

}  // namespace voussoir
