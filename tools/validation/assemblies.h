#pragma once
/// @file Bodies and assemblies of blocks that are no bridges: columns, beams, wedges, rings.

#include "core/structure/model.h"

namespace voussoir::validation {

inline constexpr double kSpecificWeight = 2400.0 * 9.81;  ///< [N/m3] of every block
inline constexpr double kHighFriction = 2.0;              ///< nothing slides in an arch
inline constexpr double kArchCentre = 50.0;               ///< [m] x of an arch's crown
inline constexpr double kFooting = 0.1;                   ///< [m] height of the stones below its springings

/// Blocks of any shape, numbered as in `polygons`, meshed by the bridges' rule. Supports act at y = 0, x = 0
/// and x = description.wall.length, as in a bridge. No control points.
Model assemble_blocks(const BridgeDescription& description, const std::vector<Polygon>& polygons);

/// Moves the nodes inside blocks at random by up to `share` of `spacing` [m], and leaves the boundaries
/// alone.
void disturb_inner_nodes(double spacing, double share, Model& bridge);

/// Rectangle with its lower left corner at `corner` and extra corners every `spacing` along both long sides.
Polygon rectangle(const Point& corner, double width, double height);
Polygon strip(double length, double depth, int parts);

/// All corners turned about the origin by an angle [rad], counter-clockwise, then moved.
Polygon turned(const Polygon& polygon, double angle, const Point& shift = Point::Zero());

/// A block of 1 m x 0.5 m times `size` on the upper side of a wedge of this slope [rad].
Model block_on_wedge(double slope, double friction_angle, double size = 1.0);

/// A course of blocks of 1 m x 0.5 m that nothing holds and nothing pulls.
Model floating_course(int blocks, double friction_angle);

/// A column of square-edged blocks of 1 m x 0.5 m on a clamped one, free at the sides.
Model column(int courses, double young_modulus = 2.5e10);

/// What describes an arch of mean radius 1 m about kArchCentre but for its blocks: free at the sides, no
/// courses; the tangential stiffness is the normal one, E is 100 p_n x 1 m.
BridgeDescription arch_description(double normal_stiffness, double friction);

/// A semicircular ring of mean radius 1 m with curved faces (chords of less than 6 degrees) and radial
/// joints, on two clamped footings; `thickness` in m.
Model semicircular_ring(int voussoirs, double thickness, double friction, double normal_stiffness);

/// Forces that a constant Piola stress (xx, yy, xy) [Pa] does on the outline of all blocks, node by node [N]:
/// a dead load.
Field boundary_tractions(const Model& bridge, const Eigen::Vector3d& stress);

/// Force that block `first` gives block `second` through their joints [N].
Point joint_force(const Model& bridge, const Field& displacement, BlockId first, BlockId second);

}  // namespace voussoir::validation
