/// @file The reader of databases against damaged and made-up files. Oracle: it reads them or throws
/// InputError or Failure. Half of the inputs are forged: bytes of HDF5's own structures are changed and the
/// structure's checksum is put right again, so that the change reaches the reader's inside.

#include <array>
#include <catch2/catch.hpp>

#include "core/error.h"
#include "database/format/hdf5_format.h"
#include "tests/support/fuzzing.h"
#include "tests/support/whole_database.h"

namespace voussoir {
namespace {

/// A structure of HDF5 that ends with its checksum.
struct Structure {
  std::size_t offset = 0;
  std::size_t size = 0;
};

struct Good {
  std::string bytes;
  std::vector<Structure> structures;
};

std::uint32_t checksum_of(const std::string& bytes, std::size_t offset, std::size_t size) {
  return hdf5_format::lookup3(std::as_bytes(std::span(bytes)).subspan(offset, size));
}

/// The size at which the checksum of what begins at `offset` is right, or 0.
std::size_t size_of_structure(const std::string& bytes, std::size_t offset) {
  constexpr std::size_t kLargest = 8192;
  for (std::size_t end = offset + 8; end + 4 <= bytes.size() && end < offset + kLargest; ++end) {
    std::uint32_t stored = 0;
    std::memcpy(&stored, bytes.data() + end, sizeof stored);
    if (checksum_of(bytes, offset, end - offset) == stored) return end + 4 - offset;
  }
  return 0;
}

Good good_file(const std::string& bridge, std::vector<Scene> scenes, KeepField fields) {
  Good good{test::made_up_bytes(parse_bridge_file(bridge, "corpus"), scenes, fields), {}};
  for (const char* signature : {"\x89HDF", "OHDR", "OCHK", "FAHD", "FADB"})
    for (std::size_t at = good.bytes.find(signature); at != std::string::npos;
         at = good.bytes.find(signature, at + 1))
      if (const std::size_t size = size_of_structure(good.bytes, at)) good.structures.push_back({at, size});
  return good;
}

/// Databases of a bridge of the corpus: one scene (a single chunk), some (an index of chunks), none with
/// fields.
std::vector<Good> good_files() {
  const std::string block = test::text_of(test::corpus_folder("bridges") / "one-block.toml");
  const std::string arch = test::text_of(test::corpus_folder("bridges") / "one-span.toml");
  auto scenes = all_scenes(20, 1);
  scenes.resize(4);
  return {good_file(block, {Scene{}}, KeepField::yes), good_file(arch, scenes, KeepField::yes),
          good_file(arch, scenes, KeepField::no)};
}

void change_bits(std::string& bytes, const Good&, test::Chance& chance) {
  for (std::size_t count = 1 + test::below(chance, 4); count > 0; --count) {
    char& byte = bytes[test::below(chance, bytes.size())];
    byte = static_cast<char>(byte ^ (1 << test::below(chance, 8)));
  }
}

void overwrite(std::string& bytes, const Good&, test::Chance& chance) {
  const std::size_t size = 1 + test::below(chance, 64);
  const std::size_t at = test::below(chance, bytes.size() - size);
  const char filling = test::below(chance, 2) == 0 ? '\0' : '\xff';
  for (std::size_t i = 0; i < size; ++i)
    bytes[at + i] = test::below(chance, 3) == 0 ? static_cast<char>(chance()) : filling;
}

void copy_within(std::string& bytes, const Good&, test::Chance& chance) {
  const std::string piece =
      bytes.substr(test::below(chance, bytes.size() - 512), 1 + test::below(chance, 512));
  bytes.replace(test::below(chance, bytes.size() - piece.size()), piece.size(), piece);
}

void cut(std::string& bytes, const Good&, test::Chance& chance) {
  bytes.resize(test::below(chance, bytes.size()));
}

/// Numbers that readers stumble over, among them places of other structures (circles) and the size of the
/// file.
std::uint64_t awkward_number(const Good& good, test::Chance& chance) {
  const std::array<std::uint64_t, 8> numbers = {
      0,
      1,
      ~std::uint64_t{0},
      good.bytes.size(),
      std::uint64_t{1} << test::below(chance, 64),
      good.structures[test::below(chance, good.structures.size())].offset,
      test::below(chance, good.bytes.size()),
      chance()};
  return numbers[test::below(chance, numbers.size())];
}

void repair(std::string& bytes, const Structure& structure) {
  const std::uint32_t right = checksum_of(bytes, structure.offset, structure.size - 4);
  std::memcpy(bytes.data() + structure.offset + structure.size - 4, &right, sizeof right);
}

void forge(std::string& bytes, const Good& good, test::Chance& chance) {
  const Structure& structure = good.structures[test::below(chance, good.structures.size())];
  for (std::size_t count = 1 + test::below(chance, 3); count > 0; --count) {
    const std::size_t width = std::size_t{1} << test::below(chance, 4);
    if (structure.size < 4 + width) continue;
    const std::size_t at = structure.offset + test::below(chance, structure.size - 3 - width);
    const std::uint64_t number = awkward_number(good, chance);
    std::memcpy(bytes.data() + at, &number, width);
  }
  repair(bytes, structure);
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
  constexpr std::array kChanges = {change_bits, overwrite, copy_within, cut, forge, forge, forge, forge};
  const std::vector<Good> good = good_files();
  const test::TemporaryFolder folder;
  test::Chance chance(seed);
  return test::feed(inputs, [&] {
    const Good& start = good[test::below(chance, good.size())];
    std::string bytes = start.bytes;
    kChanges[test::below(chance, kChanges.size())](bytes, start, chance);
    std::ofstream(folder / "mutant.h5", std::ios::binary | std::ios::trunc) << bytes;
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
  for (const Good& good : good_files()) {
    std::size_t headers = 0;
    for (std::size_t at = good.bytes.find("OHDR"); at != std::string::npos;
         at = good.bytes.find("OHDR", at + 1))
      ++headers;
    CHECK(good.structures.size() > headers);  // the superblock as well
  }
}

}  // namespace voussoir
