#include <catch2/catch.hpp>
#include <fstream>
#include <random>

#include "core/error.h"
#include "database/records/journal.h"
#include "tests/support/made_up_database.h"
#include "tests/support/temporary_folder.h"

namespace voussoir {
namespace {

struct Fixture {
  test::TemporaryFolder folder;
  std::filesystem::path target = folder / "small.h5";
  BridgeFile file = test::small_bridge_file();
  Model bridge = make_model(file.description);
  std::vector<RecordKey> keys = keys_of(1, all_scenes(bridge.layout.size(), 1));
  Provenance provenance = test::made_up_provenance(file);

  Record record(std::size_t i) const { return test::made_up_record(bridge, keys[i], 2, KeepField::yes); }
  void append_first(std::size_t count) const {
    Journal journal = Journal::open(target, provenance, "key");
    for (std::size_t i = 0; i < count; ++i) journal.append(record(i));
  }
};

}  // namespace

TEST_CASE("Records appended to a journal are there after it is opened again") {
  const Fixture f;
  f.append_first(20);
  const Journal journal = Journal::open(f.target, f.provenance, "key");
  REQUIRE(journal.size() == 20);
  for (std::size_t i = 0; i < 20; ++i) CHECK(serialise(journal.read(f.keys[i])) == serialise(f.record(i)));
  CHECK_FALSE(journal.contains(f.keys[20]));
  CHECK_FALSE(journal.contains({0, f.keys[0].scene}));  // of another variant
}

TEST_CASE("A journal cut off anywhere keeps every record before the cut and can be continued") {
  const Fixture f;
  f.append_first(10);
  const auto path = Journal::path_for(f.target);
  const auto whole = std::filesystem::file_size(path);
  const std::uintmax_t frame = serialise(f.record(5)).size();
  for (std::uintmax_t cut = 1; cut < 3 * frame; cut += 97) {
    std::filesystem::resize_file(path, whole - cut);
    Journal journal = Journal::open(f.target, f.provenance, "key");
    REQUIRE(journal.size() >= 6);
    REQUIRE(journal.size() < 10);
    while (journal.size() < 10) journal.append(f.record(journal.size()));
    REQUIRE(std::filesystem::file_size(path) == whole);
    REQUIRE(serialise(journal.read(f.keys[9])) == serialise(f.record(9)));
  }
}

TEST_CASE("A bit flipped in a journal costs the records from there on and mixes nothing in") {
  const Fixture f;
  std::mt19937_64 random(2);
  for (int trial = 0; trial < 100; ++trial) {
    f.append_first(5);
    const auto path = Journal::path_for(f.target);
    std::fstream stream(path, std::ios::in | std::ios::out | std::ios::binary);
    const auto at = static_cast<std::streamoff>(random() % std::filesystem::file_size(path));
    stream.seekg(at);
    const char byte = static_cast<char>(stream.get() ^ (1 << (random() % 8)));
    stream.seekp(at);
    stream.put(byte);
    stream.close();
    const Journal journal = Journal::open(f.target, f.provenance, "key");
    REQUIRE(journal.size() < 5);
    for (std::size_t i = 0; i < journal.size(); ++i)
      REQUIRE(serialise(journal.read(f.keys[i])) == serialise(f.record(i)));
    std::filesystem::remove(path);
  }
}

TEST_CASE("Only one builder at a time can hold the journal of a database") {
  const Fixture f;
  const Journal journal = Journal::open(f.target, f.provenance, "key");
  CHECK_THROWS_AS(Journal::open(f.target, f.provenance, "key"), Failure);
  CHECK_THROWS_WITH(Journal::open(f.target, f.provenance, "key"), Catch::Contains("another build-database"));
  CHECK_NOTHROW(Journal::open(f.folder / "other.h5", f.provenance, "key"));
}

TEST_CASE("A journal of another build is begun anew and tells whose records it held") {
  const Fixture f;
  f.append_first(3);
  const Journal journal = Journal::open(f.target, f.provenance, "another key");
  CHECK(journal.size() == 0);
  REQUIRE(journal.discarded().has_value());
  CHECK(journal.discarded()->bridge_text == f.file.text);
}

TEST_CASE("A removed journal leaves no file behind") {
  const Fixture f;
  Journal journal = Journal::open(f.target, f.provenance, "key");
  journal.append(f.record(0));
  journal.remove();
  CHECK(std::filesystem::is_empty(f.folder.path()));
}

}  // namespace voussoir
