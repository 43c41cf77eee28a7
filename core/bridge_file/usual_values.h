#pragma once
/// @file Numbers of a bridge file that are possible but so unusual that another unit may have been meant.

#include <toml++/toml.h>

#include <string>
#include <vector>

namespace voussoir {

/// A sentence for every number in a table and the tables within it that is outside of what is usual for its
/// key: "line 7: density_kg_m3 = 2.4: usual are 500 to 10000; t/m3 or kN/m3?". Zero is no mistake of units.
/// Blocks given one by one are not looked at.
std::vector<std::string> unusual_values(const toml::table& table);

}  // namespace voussoir
