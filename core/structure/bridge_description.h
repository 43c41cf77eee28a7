#pragma once
/// @file What a bridge file says: geometry, material, joints, supports, control points, loads. SI units
/// throughout.

#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/polygon.h"
#include "core/structure/block.h"
#include "core/structure/mortar.h"
#include "core/structure/sensor_description.h"
#include "core/structure/uncertainty.h"

namespace voussoir {

/// How the blocks of successive courses are laid.
enum class Bond {
  running,  ///< odd courses are shifted by half a block
  stack     ///< all courses start with a whole block
};

/// A tenth of a block: what a mason would rather leave at the stone beside it.
inline constexpr double kSmallestBlock = 0.1;

/// The spandrel wall: courses of rectangular blocks, laid from x = 0, y = 0.
struct WallDescription {
  double length = 20.0;        ///< [m]
  int courses = 12;            ///< numbered from 1 at the bottom
  double course_height = 0.5;  ///< [m]
  double block_length = 1.0;   ///< [m]
  Bond bond = Bond::running;
  double smallest_piece = 1e-9;  ///< [m2] smaller remains of blocks cut by a ring vanish
  double smallest_block = 0.0;   ///< [-] share of a whole block; smaller pieces are joined to a neighbour. A
                                 ///< bridge file that says nothing means kSmallestBlock
  bool halved = false;  ///< whole blocks are laid as two halves, so that they can break in the middle
};

/// The curve of an arch's inner face. docs/shapes.md has a picture of each.
enum class IntradosShape {
  semicircular,   ///< centre and radius; stilted if the centre lies above the ground
  segmental,      ///< span and rise
  pointed,        ///< span, rise and radius of two arcs
  three_centred,  ///< span, rise and radius of the haunches
  elliptic,       ///< span and rise
  points          ///< surveyed
};

/// One ring of several, its joints its own.
struct RingDescription {
  double thickness = 0.5;  ///< [m]
  int voussoirs = 17;      ///< of equal length along the intrados
  bool staggered = false;  ///< begins and ends with half a voussoir
  friend bool operator==(const RingDescription&, const RingDescription&) = default;
};

/// An arch: its intrados, its rings, and the stones below its ends. The opening below it goes down to the
/// ground (y = 0).
struct SpanDescription {
  double centre_x = 10.0;        ///< [m] middle of the span
  double centre_y = 1.05;        ///< [m] height of the springings
  double intrados_radius = 3.5;  ///< [m] of semicircles
  double ring_thickness = 0.5;   ///< [m] of the innermost ring
  int voussoirs = 17;            ///< of the innermost ring, of equal length along the intrados
  IntradosShape shape = IntradosShape::semicircular;
  double span = 7.0;            ///< [m] clear; of segmental, pointed, three-centred and elliptic arches
  double rise = 2.0;            ///< [m] of these
  double arc_radius = 0.0;      ///< [m] of pointed arches, of the haunches of three-centred ones
  std::vector<Point> points{};  ///< [m] of the intrados, from the left springing to the right one
  bool staggered = false;       ///< the innermost ring begins and ends with half a voussoir
  std::vector<RingDescription> outer_rings{};  ///< on the innermost one, outwards
  std::optional<double> skewback{};            ///< [m] height below the springing of the stones on which the
                                               ///< ring stands, 0: none; nothing: the usual (has_skewbacks)

  double extrados_radius() const { return intrados_radius + ring_thickness; }  ///< of semicircles
};

/// Courses laid elsewhere than the wall: piers, abutments, spandrel walls, parapet, backing, fill.
struct WallPart {
  BlockRole role = BlockRole::wall;
  double from_x = 0.0;      ///< [m] left end
  double base_y = 0.0;      ///< [m] lower edge of its first course
  WallDescription courses;  ///< its length counts from `from_x`
};

enum class PlaneState { stress, strain };

/// Linear elastic blocks (paper, Table 1).
struct Material {
  double young_modulus = 2.5e10;  ///< [Pa]
  double poisson_ratio = 0.2;     ///< [-]
  double density = 2400.0;        ///< [kg/m3]
  double thickness = 1.0;         ///< [m] out of plane
  PlaneState plane = PlaneState::stress;
  double thermal_expansion = 8e-6;  ///< [1/K] linear
  friend bool operator==(const Material&, const Material&) = default;
};

/// Joints; by default dry: no tension, no cohesion (paper, Table 1).
struct JointMaterial {
  double normal_stiffness = 1e9;                            ///< [Pa/m] per unit joint area
  double tangential_stiffness = 1e8;                        ///< [Pa/m] per unit joint area
  double friction_angle = 35.0 * std::numbers::pi / 180.0;  ///< [rad] of the dry joint
  Mortar mortar{};

  double friction_coefficient() const { return std::tan(friction_angle); }
  friend bool operator==(const JointMaterial&, const JointMaterial&) = default;
};

/// Blocks chosen by role or label, and the material of them and of their joints.
struct Region {
  std::vector<std::string> of;  ///< names of roles, or labels
  Material material;            ///< whole: what the file leaves out is the bridge's
  JointMaterial joints;         ///< the same
};

/// Soil over the rings that only weighs.
struct FillWeight {
  double unit_weight = 0.0;      ///< [N/m3]; 0: none
  std::vector<Point> surface{};  ///< [m] its top, from left to right, straight between the points
};

enum class SupportKind {
  clamped,  ///< both displacements are zero
  roller,   ///< the displacement along the outward normal is zero
  free
};

struct SupportDescription {
  SupportKind base = SupportKind::clamped;  ///< nodes at y = 0
  SupportKind sides = SupportKind::roller;  ///< nodes at x = 0 and x = length
  SupportKind top = SupportKind::free;      ///< nodes at the top of the wall
  int embedded_courses = 0;  ///< so many at the base, of each foot those above it, and, if it is held, at
                             ///< the top are held whole, as in a steel beam
};

/// A movement of a support, one after the other, each from where the one before has ended.
struct MovementDescription {
  std::string support;  ///< its name: "top", "foot 1", ..
  std::optional<double>
      pressure;  ///< [Pa] the support moves straight towards the structure until it presses with this
  double x = 0.0, y = 0.0;  ///< [m] or by this much
  int steps = 1;
  friend bool operator==(const MovementDescription&, const MovementDescription&) = default;
};

/// Which sets of points are measured. T1.. are the upper corners of the top course's blocks, A1.. the
/// intrados corners of the arch blocks, both from left to right, F1.. the middles of the blocks of walls,
/// piers, abutments and parapets, as they are laid.
struct ControlPointDescription {
  bool top = true;
  bool arch = true;
  bool face = false;
};

/// How blocks are cut into triangles; the defaults are the paper's Fig. 2 as far as one rule can follow it.
struct MeshDescription {
  int refinement = 0;            ///< each level cuts every triangle into four
  bool split_at_corners = true;  ///< also put nodes where neighbours' corners touch an edge
};

/// A force at a place on top.
struct PointLoad {
  double x = 0.0;      ///< [m]
  double force = 0.0;  ///< [N] downwards
  friend bool operator==(const PointLoad&, const PointLoad&) = default;
};

/// A force spread evenly along the top.
struct LineLoad {
  double from_x = 0.0, to_x = 0.0;  ///< [m]
  double force_per_length = 0.0;    ///< [N/m] downwards, per length along x
  friend bool operator==(const LineLoad&, const LineLoad&) = default;
};

struct Axle {
  double at =
      0.0;  ///< [m] behind the vehicle's front, which points to the right: x = place of the front - at
  double force = 0.0;  ///< [N] downwards
  friend bool operator==(const Axle&, const Axle&) = default;
};

/// A load case: what stands on the bridge beside its weight.
struct LoadDescription {
  std::string name;  ///< letters, digits, - and _
  std::vector<PointLoad> points;
  std::vector<LineLoad> lines;
  std::vector<Axle> axles;     ///< of one vehicle
  std::vector<double> places;  ///< [m] x of the vehicle's front, one step of the load after the other
  std::optional<double>
      width;            ///< [m] out of plane over which forces spread; nothing: the bridge's thickness
  bool unload = false;  ///< the load is taken away at the end
  friend bool operator==(const LoadDescription&, const LoadDescription&) = default;
};

/// Everything that defines a bridge. The default value is the reference bridge.
struct BridgeDescription {
  std::string name = "reference";
  WallDescription wall;
  std::vector<SpanDescription> spans = {SpanDescription{}};
  std::vector<WallPart> parts{};              ///< laid after the wall, in this order
  std::vector<Block> blocks{};                ///< given one by one; if there are any, nothing else is laid
  std::vector<std::string> missing_blocks{};  ///< labels of those that are known to be gone
  Material material;
  JointMaterial joints;
  std::vector<MortarRegion> mortar;  ///< later ones take the place of earlier ones
  std::vector<Region> regions{};     ///< a later one goes before an earlier one
  FillWeight fill{};
  SupportDescription supports;
  ControlPointDescription control_points;
  std::vector<SensorDescription> sensors{};
  MeshDescription mesh;
  double gravity = 9.81;          ///< [m/s2] downwards
  double joint_tolerance = 1e-6;  ///< [m] edges closer than this form a joint
  std::vector<LoadDescription> loads;
  std::vector<MovementDescription> movements;
  Uncertainty uncertainty;
  bool collapse_fields =
      true;  ///< a database keeps fields of scenes that fall, as the paper does, where motion
             ///< can follow the joints as they are. A file that says nothing wants none
};

/// What the supports and the axis of symmetry of a bridge refer to.
struct Bounds {
  Point corner = Point::Zero();  ///< [m] lower left
  double length = 0.0;           ///< [m] along x
};

/// The wall's, from (0, 0), or those of the blocks that are given one by one.
Bounds bounds_of(const BridgeDescription& description);

}  // namespace voussoir
