#pragma once
/// @file What mortar a joint can have: none that breaks by itself, or is stronger in tension than Coulomb's
/// line allows.

#include <optional>
#include <string>

#include "core/structure/bridge_description.h"

namespace voussoir {

/// The first key of [[mortar]] whose value cannot be, and why.
struct RefusedMortar {
  const char* key;
  std::string reason;
};

/// By the mortar's own numbers.
std::optional<RefusedMortar> refused_cohesion(const Mortar& mortar);

/// By the stiffness of the joint, too: up to its strength it stores energy as a spring.
std::optional<RefusedMortar> refused_energy(const JointMaterial& joint);

/// The mortar of a joint that is said to have another stiffness or friction than before. Energies go against
/// stiffness: the curves of stress against opening and slip are stretched as their elastic parts are, so that
/// what the joint stores up to its strength, f_t^2 / (2 p_n), stays the same share of what breaks it.
/// Friction scales all of Coulomb's line, and the slip's curve with it: mortar stays at least as rough as the
/// dry joint. So no mortar that can be becomes one that cannot.
Mortar mortar_on(const JointMaterial& joint, const JointMaterial& before);

}  // namespace voussoir
