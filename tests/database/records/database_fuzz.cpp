/// @file The reader of databases against damaged and made-up files. Oracle: it reads them or throws
/// InputError or Failure.

#include <catch2/catch.hpp>

#include "core/error.h"
#include "tests/support/damaged_database.h"
#include "tests/support/whole_database.h"

namespace voussoir {
namespace {

test::GoodDatabase made_up(const std::string& bridge, const std::vector<Scene>& scenes, KeepField fields) {
  return test::good_database(test::made_up_bytes(parse_bridge_file(bridge, "corpus"), scenes, fields));
}

/// Databases of a bridge of the corpus: one scene (a single chunk), some (an index of chunks), none with
/// fields.
std::vector<test::GoodDatabase> good_files() {
  const std::string block = test::text_of(test::corpus_folder("bridges") / "one-block.toml");
  const std::string arch = test::text_of(test::corpus_folder("bridges") / "one-span.toml");
  auto scenes = all_scenes(20, 1);
  scenes.resize(4);
  return {made_up(block, {Scene{}}, KeepField::yes), made_up(arch, scenes, KeepField::yes),
          made_up(arch, scenes, KeepField::no)};
}

test::Verdict read(const std::filesystem::path& path) {
  try {
    test::read_all(path);
    return test::Verdict::accepted;
  } catch (const InputError&) {
    return test::Verdict::refused;
  } catch (const Failure&) {
    return test::Verdict::refused;
  }
}

test::Tally feed(int inputs, std::uint64_t seed) {
  const std::vector<test::GoodDatabase> good = good_files();
  const test::TemporaryFolder folder;
  test::Chance chance(seed);
  return test::feed(inputs, [&] {
    const test::GoodDatabase& start = good[test::below(chance, good.size())];
    std::ofstream(folder / "mutant.h5", std::ios::binary | std::ios::trunc)
        << test::damaged_database(start, chance);
    return read(folder / "mutant.h5");
  });
}

}  // namespace

TEST_CASE("Three thousand damaged and forged databases are read or refused, never worse", "[fuzz]") {
  const test::Tally tally = feed(3'000, 5);
  CHECK(tally.accepted > 200);
  CHECK(tally.refused > 1000);
}

TEST_CASE("Ten minutes or a million damaged and forged databases are read or refused, never worse",
          "[.long][fuzz]") {
  const test::Tally tally = feed(1'000'000, 6);
  WARN(tally.accepted << " read, " << tally.refused << " refused");
  CHECK(tally.accepted > 0);
  CHECK(tally.refused > 0);
}

TEST_CASE("Forging reaches every structure of a database") {
  for (const test::GoodDatabase& good : good_files()) {
    std::size_t headers = 0;
    for (std::size_t at = good.bytes.find("OHDR"); at != std::string::npos;
         at = good.bytes.find("OHDR", at + 1))
      ++headers;
    CHECK(good.structures.size() > headers);  // the superblock as well
  }
}

}  // namespace voussoir
