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

}  // namespace voussoir
