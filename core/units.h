#pragma once
/// @file Everything inside is in SI units; these turn what people write and read.

namespace voussoir {

inline constexpr double kMillimetres = 1e3;   ///< of a metre
inline constexpr double kKilonewtons = 1e-3;  ///< of a newton
inline constexpr double kMetresPerMillimetre =
    1e-3;  ///< not 1 / kMillimetres: products would be rounded otherwise

}  // namespace voussoir
