#pragma once
/// @file Lengths as people type them.

#include <string_view>

namespace voussoir {

/// "0.3mm" or "0.3" (millimetres) -> 3e-4 [m]; with the unit "mm/m" of a tilt "0.01mm/m" or "0.01" -> 1e-5.
/// Throws InputError unless it is one from `least` to `most` millimetres.
double parse_millimetres(std::string_view text, double least, double most, std::string_view unit = "mm");

}  // namespace voussoir
