#pragma once
/// @file Thrust lines: where the resultant of what goes through each joint of a ring crosses it. Inside the
/// middle third the whole joint is pressed; at an edge there is a hinge (Heyman, The stone skeleton, 1966).

#include "core/statics/joint_forces.h"

namespace voussoir {

/// The resultant through the joint between two blocks of a ring.
struct ThrustPoint {
  int ring = 0;
  BlockId first, second;
  Point centre;            ///< of the joint [m]
  Point outward;           ///< unit vector along the joint, from the intrados to the extrados
  double thickness = 0.0;  ///< of the ring there [m]
  double normal = 0.0;     ///< [N] compression
  double shear = 0.0;      ///< [N] on `second` along `outward`
  double eccentricity =
      0.0;  ///< [m] of the resultant from the centre along `outward`; NaN without compression

  Point at() const { return centre + eccentricity * outward; }
};

/// Of all rings, by ring and then along it. Joints without any contact at rest are not looked at.
std::vector<ThrustPoint> thrust_lines(const Structure& structure, const std::vector<JointForces>& joints);

}  // namespace voussoir
