#pragma once
/// @file Random plausible bridges and their bridge files.

#include <cstdint>
#include <string>

#include "core/structure/bridge_description.h"

namespace voussoir {

/// A bridge of 1 to 3 equal arches as masons may have built it: radius 1 to 5 m, ring 0.08 to 0.25 of it,
/// springing 0 to 1.5 m, courses 0.2 to 0.6 m, blocks 0.4 to 1.5 m, running or stack bond, 9 to 41 voussoirs,
/// E 2e9 to 6e10 Pa, p_n 1e8 to 3e10 Pa/m, p_t 2e7 to 3e9 Pa/m, friction 25 to 45 degrees; stiffnesses even
/// in their logarithm.
BridgeDescription random_bridge(std::uint64_t seed);

/// The bridge file (TOML) of a bridge that random_bridge drew, with all digits of its numbers.
std::string bridge_file_text(const BridgeDescription& random_bridge);

}  // namespace voussoir
