#pragma once
/// @file Random numbers that are the same on every machine for the same seed (the standard library's
/// distributions are not).

#include <cstdint>

namespace voussoir {

/// Of seeds that users state: what is larger, or wraps around, is no number that anyone meant.
inline constexpr std::uint64_t kLargestSeed = 1'000'000'000'000'000'000;

/// PCG32 (O'Neill, "PCG: A family of simple fast space-efficient statistically good algorithms for random
/// number generation", 2014): 64 bits of state, 32 bits a number.
class Random {
 public:
  explicit Random(std::uint64_t seed);

  std::uint32_t bits();                      ///< 32 random bits
  double uniform();                          ///< in [0, 1)
  std::uint32_t below(std::uint32_t bound);  ///< in [0, bound), unbiased; precondition: bound > 0
  double gaussian();                         ///< mean 0, standard deviation 1 (polar method)

 private:
  std::uint64_t state_ = 0;
};

/// A seed for each number of a series that has a seed of its own: neighbouring numbers and seeds give
/// unrelated ones (Steele, Lea and Flood, "Fast splittable pseudorandom number generators", 2014:
/// SplitMix64).
std::uint64_t series_seed(std::uint64_t seed, std::uint64_t number);

}  // namespace voussoir
