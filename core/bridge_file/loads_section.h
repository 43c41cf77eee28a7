#pragma once
/// @file The load cases of a bridge file.

#include "core/bridge_file/toml_section.h"
#include "core/structure/bridge_description.h"

namespace voussoir {

/// From left to right [m].
struct Interval {
  double left = 0.0;
  double right = 0.0;
};

/// Reads [[loads]]. Throws InputError "file:line: message" for impossible values, names that are taken and
/// places outside the bridge, which reaches over `bridge`. Axles may stand beside the bridge, but not all of
/// a vehicle's.
std::vector<LoadDescription> read_loads(const toml::array& tables, const std::string& file,
                                        const Interval& bridge);

}  // namespace voussoir
