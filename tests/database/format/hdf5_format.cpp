/// @file Our own reading of HDF5's structures. Oracle: the HDF5 library.

#include <hdf5.h>
#include <array>
#include <catch2/catch.hpp>

#include "core/error.h"
#include "database/format/hdf5_file.h"
#include "database/format/hdf5_handle.h"
#include "database/records/schema.h"
#include "tests/support/hdf5_datasets.h"
#include "tests/support/whole_database.h"

namespace voussoir {
namespace {

/// A database on the disk, opened by HDF5 and by us.
struct Pair {
  test::TemporaryFolder folder;
  std::filesystem::path path = folder / "pair.h5";
  Hdf5Handle theirs;
  std::optional<Hdf5File> ours;

  Pair(std::size_t scenes, KeepField fields, std::size_t variants = 1, std::size_t states = 1) {
    auto wanted = all_scenes(38, 3);
    wanted.resize(scenes);
    test::write_made_up_database(path, test::small_bridge_file(), wanted, fields, variants, states);
    const auto lock = lock_hdf5();
    theirs = Hdf5Handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
    REQUIRE(theirs);
    ours.emplace(path);
  }
};

std::vector<std::uint64_t> shape_of(hid_t dataset) {
  const Hdf5Handle space(H5Dget_space(dataset), H5Sclose);
  std::array<hsize_t, 4> extent{};
  const int rank = H5Sget_simple_extent_dims(space.get(), extent.data(), nullptr);
  return {extent.begin(), extent.begin() + rank};
}

}  // namespace

TEST_CASE("Every contiguous dataset has the type, the shape and the bytes that HDF5 finds") {
  const Pair pair(45, KeepField::yes, 2, 3);
  const auto lock = lock_hdf5();
  int compared = 0;
  for (const std::string& path : test::dataset_paths(pair.theirs.get())) {
    if (path == dataset::kField || path == dataset::kSlipped) continue;
    INFO(path);
    const Hdf5Handle theirs(H5Dopen2(pair.theirs.get(), path.c_str(), H5P_DEFAULT), H5Dclose);
    const DatasetView ours = pair.ours->view(path.c_str());
    CHECK(ours.shape == shape_of(theirs.get()));
    const Hdf5Handle type(H5Dget_type(theirs.get()), H5Tclose);
    std::size_t elements = 1;
    for (const std::uint64_t extent : ours.shape) elements *= extent;
    Bytes content(elements * H5Tget_size(type.get()));
    REQUIRE(H5Dread(theirs.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, content.data()) >= 0);
    CHECK(std::equal(content.begin(), content.end(), ours.bytes.begin(), ours.bytes.end()));
    const bool is_text = H5Tget_class(type.get()) == H5T_STRING;
    CHECK((ours.type == ElementType::text) == is_text);
    ++compared;
  }
  CHECK(compared > 25);
}

TEST_CASE(
    "Every chunk has the bytes that HDF5 finds, for one scene, for some and for an index of several pages") {
  struct Counts {
    std::size_t scenes, variants, states;
  };
  for (const auto& [scenes, variants, states] : {Counts{1, 1, 1}, Counts{45, 1, 1}, Counts{1024, 1, 1},
                                                 Counts{1025, 1, 1}, Counts{1, 1, 2}, Counts{500, 2, 3}}) {
    const Pair pair(scenes, KeepField::yes, variants, states);
    const auto lock = lock_hdf5();
    const Hdf5Handle theirs(H5Dopen2(pair.theirs.get(), dataset::kField, H5P_DEFAULT), H5Dclose);
    const auto shape = shape_of(theirs.get());
    const ChunkedDataset ours = pair.ours->open_chunked(dataset::kField, shape);
    const std::size_t rows = scenes * variants;
    REQUIRE(ours.chunks.size() == states * rows);
    for (std::size_t i = 0; i < ours.chunks.size(); ++i) {
      const std::array<hsize_t, 4> offset = {i / rows, i % rows, 0, 0};
      hsize_t size = 0;
      REQUIRE(H5Dget_chunk_storage_size(theirs.get(), offset.data(), &size) >= 0);
      Bytes content(size);
      std::uint32_t filters = 0;
      REQUIRE(H5Dread_chunk(theirs.get(), H5P_DEFAULT, offset.data(), &filters, content.data()) >= 0);
      REQUIRE(std::equal(content.begin(), content.end(), ours.chunks[i].begin(), ours.chunks[i].end()));
    }
  }
}

TEST_CASE("Attributes have the values that HDF5 finds") {
  const Pair pair(3, KeepField::no);
  const auto lock = lock_hdf5();
  for (const char* name : {attribute::kFormat, attribute::kDigest, attribute::kBridgeName,
                           attribute::kBridgeSha256, attribute::kProgramVersion, attribute::kCompiler,
                           attribute::kCompileFlags, attribute::kSolverRevision, attribute::kResultsKey}) {
    const Hdf5Handle theirs(H5Aopen(pair.theirs.get(), name, H5P_DEFAULT), H5Aclose);
    const Hdf5Handle type(H5Aget_type(theirs.get()), H5Tclose);
    std::string value(H5Tget_size(type.get()), '\0');
    REQUIRE(H5Aread(theirs.get(), type.get(), value.data()) >= 0);
    CHECK(pair.ours->text_attribute(name) == std::string(value.c_str()));
  }
  CHECK(pair.ours->int_attribute(attribute::kSchemaVersion) == kSchemaVersion);
}

TEST_CASE("A file that another program added an attribute and a dataset to is still read") {
  Pair pair(3, KeepField::yes);
  pair.ours.reset();
  const auto lock = lock_hdf5();
  pair.theirs.close();
  {
    const Hdf5Handle file(H5Fopen(pair.path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
    const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const Hdf5Handle note(
        H5Acreate2(file.get(), "note", H5T_STD_I32LE, space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    const Hdf5Handle more(H5Dcreate2(file.get(), "scenes/remark", H5T_STD_I32LE, space.get(), H5P_DEFAULT,
                                     H5P_DEFAULT, H5P_DEFAULT),
                          H5Dclose);
    REQUIRE(note);
    REQUIRE(more);
  }
  CHECK_NOTHROW(test::read_all(pair.path));
}

TEST_CASE("A file that the program that wrote it has not closed is refused, as by HDF5") {
  Pair pair(3, KeepField::yes);
  pair.ours.reset();
  const auto lock = lock_hdf5();
  pair.theirs.close();
  const auto copy = pair.folder / "open.h5";
  {
    const Hdf5Handle file(H5Fopen(pair.path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
    REQUIRE(H5Fflush(file.get(), H5F_SCOPE_GLOBAL) >= 0);
    std::filesystem::copy_file(pair.path, copy);
  }
  CHECK_NOTHROW(test::read_all(pair.path));
  const Hdf5Handle theirs(H5Fopen(copy.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  REQUIRE_FALSE(theirs);
  CHECK_THROWS_AS(Hdf5File(copy), InputError);
  CHECK_THROWS_WITH(Hdf5File(copy), Catch::Contains("open.h5: damaged or incomplete HDF5 file: it was not "
                                                    "closed by the program that wrote it"));
}

TEST_CASE("The checksum of the author's own example is right") {
  const std::string text = "Four score and seven years ago";  // from lookup3.c, by Bob Jenkins
  CHECK(hdf5_format::lookup3(std::as_bytes(std::span(text))) == 0x17770551);
}

}  // namespace voussoir
