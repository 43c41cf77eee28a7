#include "core/structure/mortar_limits.h"

#include <fmt/format.h>

#include <cmath>

namespace voussoir {

std::optional<RefusedMortar> refused_cohesion(const Mortar& mortar) {
  const double least = mortar.friction_coefficient() * mortar.tensile_strength;
  if (mortar.cohesion >= least) return std::nullopt;
  return RefusedMortar{
      "cohesion_Pa", fmt::format("is {:g}: expected at least tan(friction_angle) tensile_strength_Pa = {:g}",
                                 mortar.cohesion, least)};
}

std::optional<RefusedMortar> refused_energy(const JointMaterial& joint) {
  const Mortar& mortar = joint.mortar;
  const double f_t = mortar.tensile_strength, f_m = mortar.compressive_strength, c = mortar.cohesion;
  const auto refused = [](const char* key, double energy, double stored, const char* formula) {
    return RefusedMortar{
        key, fmt::format("is {:g}: expected more than {} = {:g}: the joint would break at once", energy,
                         formula, stored)};
  };
  const double opening = 0.5 * f_t * f_t / joint.normal_stiffness;
  if (mortar.opening_energy <= opening)
    return refused("opening_energy_J_m2", mortar.opening_energy, opening, "f_t^2 / (2 p_n)");
  const double slip = c * c / joint.tangential_stiffness;
  if (mortar.slip_energy <= slip) return refused("slip_energy_J_m2", mortar.slip_energy, slip, "c^2 / p_t");
  const double crushing = f_m * f_m / joint.normal_stiffness;
  if (std::isfinite(mortar.crushing_energy) && mortar.crushing_energy <= crushing)
    return refused("crushing_energy_J_m2", mortar.crushing_energy, crushing,
                   "f_m^2 / p_n of compressive_strength_Pa");
  return std::nullopt;
}

Mortar mortar_on(const JointMaterial& joint, const JointMaterial& before) {
  Mortar mortar = before.mortar;
  if (!mortar.is_there()) return mortar;
  const double across = joint.normal_stiffness / before.normal_stiffness;
  const double along = joint.tangential_stiffness / before.tangential_stiffness;
  const double smooth = before.friction_coefficient();
  const double rougher = smooth > 0.0 ? joint.friction_coefficient() / smooth : 1.0;
  mortar.opening_energy /= across;
  mortar.crushing_energy /= across;
  mortar.slip_energy *= rougher * rougher / along;
  if (rougher == 1.0) return mortar;  // to the last bit
  mortar.cohesion *= rougher;
  mortar.friction_angle = std::atan(mortar.friction_coefficient() * rougher);
  return mortar;
}

}  // namespace voussoir
