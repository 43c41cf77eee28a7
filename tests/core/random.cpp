#include <catch2/catch.hpp>
#include <set>

#include "core/random.h"

namespace voussoir {

TEST_CASE("Seeds of series are SplitMix64's and all different (published numbers of seed 1234567)") {
  // The first outputs of SplitMix64 from 1234567, as in Rosetta Code's "Pseudo-random numbers/Splitmix64".
  const std::uint64_t published[] = {6457827717110365317u, 3203168211198807973u, 9817491932198370423u,
                                     4593380528125082431u, 16408922859458223821u};
  for (std::uint64_t number = 0; number < 5; ++number)
    CHECK(series_seed(1234567, number) == published[number]);
  std::set<std::uint64_t> seeds;
  for (std::uint64_t seed = 0; seed < 100; ++seed)
    for (std::uint64_t number = 0; number < 100; ++number) seeds.insert(series_seed(seed, number));
  CHECK(seeds.size() == 10000);
}

}  // namespace voussoir
