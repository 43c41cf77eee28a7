#pragma once
/// @file The law of a joint with mortar: a bond that tension and slip wear away, then the dry law.
///
/// Symbols and signs as in joint_law.h, at one point of a joint:
///   g       [m]  opening, positive when the faces are apart
///   s, s_p  [m]  slip and plastic slip; xi = s - s_p is elastic
///   sigma   [Pa] normal stress, tension positive; p = <-sigma> pressure
///   tau     [Pa] shear stress, p_t xi
/// The point remembers the plastic slip s_p, the largest inelastic opening w and the length kappa of all
/// plastic slip that the bond has taken part in. What is left of the bond is the share
///   b = exp(-w / l_1) exp(-kappa / l_2),      l_1 = G_I / f_t - g_0 / 2,   l_2 = G_II / c,   g_0 = f_t / p_n
/// so that opening alone dissipates G_I and slip alone (beside friction) G_II; each leaves the other the
/// less.
///
/// Opening. Closed (g <= 0) sigma = p_n g, hurt or not. Open
///   w = max(w before, g - g_0),     sigma = f_t b g / (g_0 + w):
/// elastic up to f_t, then exponential softening; unloading goes straight to the origin.
///
/// Crushing. Pressure is bounded by f_m exp(-q / l_c), l_c = G_c / f_m; what the bound cuts off makes the
/// joint thinner for good, by q, and g counts from there: all of the above holds for g + q. Without G_c the
/// bound stays f_m. The bond does not mind.
///
/// Slip. tau is bounded to |tau| <= b (c - mu sigma) + (1 - b) mu_r p, pressure being the negative part of
/// sigma: Coulomb's line of the intact mortar (c, mu) turns into that of the dry joint (mu_r) as the bond
/// goes. What the bound cuts off is plastic slip of length dlambda, which wears the bond in turn, so dlambda
/// solves
///   p_t (|xi| - dlambda) = b exp(-dlambda / l_2) a + mu_r p,
///   a = c + (mu - mu_r) p  where closed,   c - mu f_t g / (g_0 + w)  where open
/// (implicit in the step). The right-hand side is convex in dlambda: there is one solution, and Newton's
/// method goes to it from above without a turn. Where mortar softens faster than the joint's own elasticity
/// gives (p_t < b a / l_2) it breaks at once. A bond that is gone leaves the dry law: an open joint forgets,
/// its plastic slip becomes its slip.
///
/// Energy. sigma and tau follow from the stored energy S(w, kappa) <g>^2 / 2 + p_n <-g>^2 / 2 + p_t xi^2 / 2
/// with S = f_t b / (g_0 + w), which w and kappa only lower, and tau does work on plastic slip only in its
/// own direction: the energy dissipated never falls.
///
/// Along a stretch the law is no longer linear by parts; it is integrated at kBondPoints Gauss points, each
/// with its own memory. A joint without mortar goes through joint_law.h.

#include <Eigen/Core>
#include <array>

#include "core/law/joint_law.h"

namespace voussoir {

/// Integration points along a stretch.
inline constexpr std::size_t kBondPoints = 8;

/// A joint's mortar, what multiplies stresses times the area of its stretch (length times thickness).
struct CohesiveStiffness {
  JointStiffness dry;              ///< p_n, p_t; the cap is that of the residual friction
  double tension = 0.0;            ///< f_t area [N]
  double cohesion = 0.0;           ///< c area [N]
  double friction = 0.0;           ///< mu of the intact mortar [-]
  double residual_friction = 0.0;  ///< mu_r of the dry joint [-]
  double elastic_opening = 0.0;    ///< g_0 [m]
  double opening_length = 0.0;     ///< l_1 [m]
  double deepest = 0.0;            ///< elastic penetration at f_m [m]; infinite: cannot be crushed
  double crushing_length = 0.0;    ///< l_c [m]; infinite: no softening
  double slip_length = 0.0;        ///< l_2 [m]
};

/// `area` is length times thickness [m2]. Precondition: the material has mortar with l_1, l_2 > 0 and c >= mu
/// f_t.
CohesiveStiffness cohesive_stiffness(const JointMaterial& material, double area);

/// What happens at one point; times the area of the whole stretch.
struct BondResponse {
  double normal = 0.0;      ///< sigma [N], tension positive
  double shear = 0.0;       ///< tau [N]
  Eigen::Matrix2d tangent;  ///< d (normal, shear) / d (gap, slip) [N/m]
  BondMemory memory;        ///< if the step ended here
  double dissipated = 0.0;  ///< in the step that would end here [J]; never negative
};

BondResponse bond_response(const CohesiveStiffness& joint, const BondMemory& memory, double gap, double slip);

/// Share b of the bond that is left.
double bond_left(const CohesiveStiffness& joint, const BondMemory& memory);

/// The law over a whole stretch, and its derivative.
JointResponse integrate_bond(const CohesiveStiffness& joint, const JointMemory& memory,
                             const JointState& state);

/// Shares of the stretch in which the faces press on each other or the bond has a hundredth of its strength,
/// and in which slip has worn the bond in the step that would end in this state.
JointContact bond_contact(const CohesiveStiffness& joint, const JointMemory& memory, const JointState& state);

/// Pressure at an end of the stretch, times its area [N]; what its nearest point has been crushed by counts.
double bond_pressure(const CohesiveStiffness& joint, const JointMemory& memory, const JointState& state,
                     int end);

/// What a step that ends in this state does: the law's forces, and what the joint remembers then.
struct BondStep {
  Eigen::Vector4d force;  ///< as in JointResponse
  JointMemory memory;
};
BondStep bond_step(const CohesiveStiffness& joint, const JointMemory& memory, const JointState& state);

/// What the joint remembers when a step ends in this state.
JointMemory updated_bond(const CohesiveStiffness& joint, const JointMemory& memory, const JointState& state);

/// Energy dissipated along the stretch in a step from `memory` that ends in this state [J].
double dissipated_energy(const CohesiveStiffness& joint, const JointMemory& memory, const JointState& state);

/// Where the points lie along a stretch of length 1, and their weights.
struct BondPoint {
  double at;
  double weight;
};
const std::array<BondPoint, kBondPoints>& bond_points();

}  // namespace voussoir
