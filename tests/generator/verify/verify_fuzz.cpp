/// @file verify-database against damaged files. Oracle: the undamaged file; whatever is changed, there is a
/// report or an error in words within seconds.

#include <catch2/catch.hpp>

#include "core/error.h"
#include "tests/support/damaged_database.h"
#include "tests/support/few_scenes.h"

namespace voussoir {
namespace {

test::Verdict verdict_of(const test::FewScenes& few, const std::string& bytes) {
  try {
    return few.verify_with(bytes).ok() ? test::Verdict::accepted : test::Verdict::refused;
  } catch (const Failure&) {
    return test::Verdict::refused;
  }
}

test::Tally verify_damaged(int inputs, std::uint64_t seed) {
  const test::FewScenes few;
  const test::GoodDatabase good = test::good_database(few.bytes);
  test::Chance chance(seed);
  return test::feed(inputs, [&] { return verdict_of(few, test::damaged_database(good, chance)); });
}

}  // namespace

TEST_CASE("A flipped bit in what mesh, joints and control points hang on is named, and nothing is solved") {
  const test::FewScenes few;
  test::Chance chance(7);
  for (const char* path :
       {dataset::kTriangles, dataset::kEdges, dataset::kBlockNodes, dataset::kBlockTriangles,
        dataset::kBlockEdges, dataset::kBlockCorners, dataset::kJointBlocks, dataset::kJointNodes,
        dataset::kPointBlock, dataset::kPointNode}) {
    std::ofstream(few.path, std::ios::binary | std::ios::trunc) << few.bytes;
    std::size_t place = 0, size = 0;
    {
      const Database database = Database::open(few.path);
      place = test::place_of(few.bytes, database, path);
      size = database.dataset_bytes(path).size();
    }
    for (int trial = 0; trial < 50; ++trial) {
      std::string changed = few.bytes;
      char& byte = changed[place + test::below(chance, size)];
      byte = static_cast<char>(byte ^ (1 << test::below(chance, 8)));
      const VerifyReport report = few.verify_with(changed);
      INFO(path << ", trial " << trial);
      const bool is_joint =
          std::string_view(path).starts_with("geometry/joint");  // blocks and nodes do not fit
      REQUIRE(
          (test::names(report, is_joint ? "geometry/joint" : path) || test::names(report, "control point")));
      REQUIRE(report.fields == 0);
    }
  }
}

TEST_CASE("Five hundred damaged and forged databases are verified or refused, never worse", "[fuzz]") {
  const test::Tally tally = verify_damaged(500, 8);
  CHECK(tally.refused > 400);
}

TEST_CASE("Ten minutes or a million damaged and forged databases are verified or refused, never worse",
          "[.long][fuzz]") {
  const test::Tally tally = verify_damaged(1'000'000, 9);
  WARN(tally.accepted << " in order, " << tally.refused << " refused");
  CHECK(tally.refused > 0);
}

}  // namespace voussoir
