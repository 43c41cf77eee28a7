#include "core/law/cohesive_law.h"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>

#include "core/law/stretch_mass.h"

namespace voussoir {
namespace {

constexpr double kLittle = 0.01;       ///< share of a bond's strength that does not count as holding
constexpr int kMostNewtonSteps = 100;  ///< quadratic from one side: about six are needed

/// The bond before slip wears it further, and its derivative by the gap.
struct Opening {
  double w;       ///< inelastic opening now [m]
  double bond;    ///< exp(-w / l_1) times what slip has left before
  double by_gap;  ///< of `bond` [1/m]
  double ratio;   ///< g / (g_0 + w) where open, 0 where closed
  double ratio_by_gap;
};

Opening opening_at(const CohesiveStiffness& joint, const BondMemory& memory, double gap) {
  const double left_by_slip = std::exp(-memory.slipped / joint.slip_length);
  const bool wears = gap - joint.elastic_opening > memory.opening;
  const double w = wears ? gap - joint.elastic_opening : memory.opening;
  const double bond = std::exp(-w / joint.opening_length) * left_by_slip;
  const double reach = joint.elastic_opening + w;
  return {.w = w,
          .bond = bond,
          .by_gap = wears ? -bond / joint.opening_length : 0.0,
          .ratio = gap > 0.0 ? gap / reach : 0.0,
          .ratio_by_gap = gap > 0.0 && !wears ? 1.0 / reach : 0.0};
}

/// The bound of the shear, worn * exp(-dlambda / l_2) + lasting, and its derivatives by the gap.
struct ShearBound {
  double worn, worn_by_gap;
  double lasting, lasting_by_gap;
};

ShearBound shear_bound(const CohesiveStiffness& joint, const Opening& opening, double gap) {
  ShearBound bound{};
  double a = joint.cohesion;
  double a_by_gap = 0.0;
  if (gap > 0.0) {
    a -= joint.friction * joint.tension * opening.ratio;
    a_by_gap = -joint.friction * joint.tension * opening.ratio_by_gap;
  } else {
    const double excess = (joint.friction - joint.residual_friction) * joint.dry.normal;
    a -= excess * gap;
    a_by_gap = -excess;
    bound.lasting = -joint.dry.cap * gap;
    bound.lasting_by_gap = -joint.dry.cap;
  }
  bound.worn = opening.bond * a;
  bound.worn_by_gap = opening.by_gap * a + opening.bond * a_by_gap;
  return bound;
}

/// dlambda of p_t (x - dlambda) = worn exp(-dlambda / l_2) + lasting, which x = 0 .. exceeds at dlambda = 0.
/// From the bond that is gone Newton's method comes down to it without a turn: the left minus the right side
/// is concave.
double plastic_length(const CohesiveStiffness& joint, const ShearBound& bound, double x) {
  double length = x - bound.lasting / joint.dry.tangential;
  for (int step = 0; step < kMostNewtonSteps; ++step) {
    const double worn = bound.worn * std::exp(-length / joint.slip_length);
    const double excess = joint.dry.tangential * (x - length) - worn - bound.lasting;
    const double change = excess / (joint.dry.tangential - worn / joint.slip_length);
    if (!(change < 0.0)) break;  // round-off: the root is passed
    length += change;
    if (-change <= 1e-15 * x) break;
  }
  return std::max(length, 0.0);
}

/// Energy dissipated by opening from w_before to w and by slip over `length`.
double dissipation(const CohesiveStiffness& joint, const BondMemory& before, const Opening& opening,
                   const ShearBound& bound, double length) {
  const double left_by_slip = std::exp(-before.slipped / joint.slip_length);
  const auto still_to_come = [&](double w) {
    return 0.5 * joint.tension * left_by_slip * std::exp(-w / joint.opening_length) *
           (joint.elastic_opening + w + 2.0 * joint.opening_length);
  };
  const double share_worn = -std::expm1(-length / joint.slip_length);
  const double stored = 0.5 * joint.tension * opening.bond * opening.ratio * opening.ratio *
                        (joint.elastic_opening + opening.w);
  return still_to_come(before.opening) - still_to_come(opening.w) + stored * share_worn +
         bound.worn * joint.slip_length * share_worn + bound.lasting * length;
}

/// What crushing leaves of a gap.
struct Crushing {
  double thinner;            ///< q [m]
  double left_by_gap = 1.0;  ///< d (gap + q) / d gap
  double dissipated = 0.0;   ///< [J]
};

/// q + deepest exp(-q / l_c) = -gap where that is more than the q of before. The left side is convex: from
/// q = -gap Newton's method comes down to it without a turn.
Crushing crushing_at(const CohesiveStiffness& joint, const BondMemory& memory, double gap) {
  if (std::isinf(joint.deepest)) return {memory.crushed};
  const auto bound = [&](double q) { return joint.deepest * std::exp(-q / joint.crushing_length); };
  const double before = bound(memory.crushed);
  if (-gap - memory.crushed <= before) return {memory.crushed};
  double q = -gap;
  for (int step = 0; step < kMostNewtonSteps; ++step) {
    const double change = (q + bound(q) + gap) / (1.0 - bound(q) / joint.crushing_length);
    if (!(change > 0.0)) break;  // round-off: the root is passed
    q -= change;
    if (change <= 1e-15 * -gap) break;
  }
  q = std::max(q, memory.crushed);
  const double lost = std::isinf(joint.crushing_length) ? joint.deepest * (q - memory.crushed)
                                                        : joint.crushing_length * (before - bound(q));
  return {q, 1.0 - 1.0 / (1.0 - bound(q) / joint.crushing_length), joint.dry.normal * lost};
}

/// `gap` counts from where crushing has left the joint.
BondResponse uncrushed_response(const CohesiveStiffness& joint, const BondMemory& memory, double gap,
                                double slip) {
  const Opening opening = opening_at(joint, memory, gap);
  const ShearBound bound = shear_bound(joint, opening, gap);
  const double xi = slip - memory.plastic_slip;
  const double sign = xi < 0.0 ? -1.0 : 1.0;
  const double stiffness = joint.dry.tangential;

  double length = 0.0;
  double length_by_gap = 0.0;
  double length_by_slip = 0.0;  // by |xi|
  if (stiffness * std::abs(xi) > bound.worn + bound.lasting) {
    length = plastic_length(joint, bound, std::abs(xi));
    const double left = std::exp(-length / joint.slip_length);
    const double slope = stiffness - bound.worn * left / joint.slip_length;
    length_by_slip = stiffness / slope;
    length_by_gap = -(bound.worn_by_gap * left + bound.lasting_by_gap) / slope;
  }

  BondResponse response;
  response.shear = stiffness * (xi - sign * length);
  response.tangent(1, 1) = stiffness * (1.0 - length_by_slip);
  response.tangent(1, 0) = -sign * stiffness * length_by_gap;
  if (gap > 0.0) {
    const double left = std::exp(-length / joint.slip_length);
    response.normal = joint.tension * opening.bond * left * opening.ratio;
    response.tangent(0, 0) =
        joint.tension * left * (opening.by_gap * opening.ratio + opening.bond * opening.ratio_by_gap) -
        response.normal / joint.slip_length * length_by_gap;
    response.tangent(0, 1) = -sign * response.normal / joint.slip_length * length_by_slip;
  } else {
    response.normal = joint.dry.normal * gap;
    response.tangent(0, 0) = joint.dry.normal;
    response.tangent(0, 1) = 0.0;
  }
  response.memory = {memory.plastic_slip + sign * length, opening.w, memory.slipped + length, 0.0};
  response.dissipated = dissipation(joint, memory, opening, bound, length);
  return response;
}

const BondMemory& memory_at(const JointMemory& memory, std::size_t point) {
  static const BondMemory kUnhurt;
  return memory.bond.empty() ? kUnhurt : memory.bond[point];
}

double along(double at_0, double at_1, double s) {
  return at_0 + s * (at_1 - at_0);
}

/// Calls `visit(point of the stretch, its number, response)`.
template <class Visit>
void for_bond_points(const CohesiveStiffness& joint, const JointMemory& memory, const JointState& state,
                     const Visit& visit) {
  const auto& points = bond_points();
  for (std::size_t i = 0; i < kBondPoints; ++i) {
    const double s = points[i].at;
    visit(points[i], i,
          bond_response(joint, memory_at(memory, i), along(state[0], state[2], s),
                        along(state[1], state[3], s)));
  }
}

/// Adds what a point's stresses do to the two ends of the stretch.
void add_force(const BondPoint& point, const BondResponse& at_point, Eigen::Vector4d& force) {
  const Eigen::Vector2d stress = point.weight * Eigen::Vector2d(at_point.normal, at_point.shear);
  force.head<2>() += (1.0 - point.at) * stress;
  force.tail<2>() += point.at * stress;
}

}  // namespace

CohesiveStiffness cohesive_stiffness(const JointMaterial& material, double area) {
  const Mortar& mortar = material.mortar;
  const double elastic_opening = mortar.tensile_strength / material.normal_stiffness;
  return {.dry = joint_stiffness(material, area),
          .tension = area * mortar.tensile_strength,
          .cohesion = area * mortar.cohesion,
          .friction = mortar.friction_coefficient(),
          .residual_friction = material.friction_coefficient(),
          .elastic_opening = elastic_opening,
          .opening_length = mortar.opening_energy / mortar.tensile_strength - 0.5 * elastic_opening,
          .deepest = mortar.compressive_strength / material.normal_stiffness,
          .crushing_length = mortar.crushing_energy / mortar.compressive_strength,
          .slip_length = mortar.slip_energy / mortar.cohesion};
}

BondResponse bond_response(const CohesiveStiffness& joint, const BondMemory& memory, double gap,
                           double slip) {
  const Crushing crushing = crushing_at(joint, memory, gap);
  BondResponse response = uncrushed_response(joint, memory, gap + crushing.thinner, slip);
  response.tangent.col(0) *= crushing.left_by_gap;
  response.memory.crushed = crushing.thinner;
  response.dissipated += crushing.dissipated;
  return response;
}

double bond_left(const CohesiveStiffness& joint, const BondMemory& memory) {
  return std::exp(-memory.opening / joint.opening_length - memory.slipped / joint.slip_length);
}

JointResponse integrate_bond(const CohesiveStiffness& joint, const JointMemory& memory,
                             const JointState& state) {
  JointResponse response{Eigen::Vector4d::Zero(), Eigen::Matrix4d::Zero()};
  for_bond_points(joint, memory, state,
                  [&](const BondPoint& point, std::size_t, const BondResponse& at_point) {
                    const StretchMass mass = mass_of_point(point.at, point.weight);
                    for (int row = 0; row < 2; ++row)
                      for (int column = 0; column < 2; ++column)
                        add_mass(response.tangent, mass, row, column, at_point.tangent(row, column));
                    add_force(point, at_point, response.force);
                  });
  return response;
}

BondStep bond_step(const CohesiveStiffness& joint, const JointMemory& memory, const JointState& state) {
  BondStep step{Eigen::Vector4d::Zero(), memory};
  step.memory.bond.resize(kBondPoints);
  for_bond_points(joint, memory, state,
                  [&](const BondPoint& point, std::size_t i, const BondResponse& at_point) {
                    add_force(point, at_point, step.force);
                    step.memory.bond[i] = at_point.memory;
                  });
  return step;
}

JointContact bond_contact(const CohesiveStiffness& joint, const JointMemory& memory,
                          const JointState& state) {
  JointContact contact;
  for_bond_points(joint, memory, state, [&](const BondPoint& point, std::size_t i, const BondResponse& now) {
    if (!(now.normal < 0.0) && bond_left(joint, now.memory) < kLittle) return;
    contact.closed += point.weight;
    if (now.memory.slipped > memory_at(memory, i).slipped) contact.sliding += point.weight;
  });
  return contact;
}

double bond_pressure(const CohesiveStiffness& joint, const JointMemory& memory, const JointState& state,
                     int end) {
  const BondMemory& nearest = memory_at(memory, end == 0 ? 0 : kBondPoints - 1);
  return std::max(0.0, -bond_response(joint, nearest, state[2 * end], state[2 * end + 1]).normal);
}

JointMemory updated_bond(const CohesiveStiffness& joint, const JointMemory& memory, const JointState& state) {
  return bond_step(joint, memory, state).memory;
}

double dissipated_energy(const CohesiveStiffness& joint, const JointMemory& memory, const JointState& state) {
  double sum = 0.0;
  for_bond_points(joint, memory, state,
                  [&](const BondPoint& point, std::size_t, const BondResponse& at_point) {
                    sum += point.weight * at_point.dissipated;
                  });
  return sum;
}

const std::array<BondPoint, kBondPoints>& bond_points() {
  static const std::array<BondPoint, kBondPoints> points = [] {
    using Rule = boost::math::quadrature::gauss<double, kBondPoints>;
    std::array<BondPoint, kBondPoints> result;
    for (std::size_t i = 0; i < Rule::abscissa().size(); ++i) {
      const double x = Rule::abscissa()[i];
      const double weight = 0.5 * Rule::weights()[i];
      result[2 * i] = {0.5 * (1.0 - x), weight};
      result[2 * i + 1] = {0.5 * (1.0 + x), weight};
    }
    return result;
  }();
  return points;
}

}  // namespace voussoir
