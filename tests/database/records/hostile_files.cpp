/// @file Databases that were changed on purpose. Oracle: the schema, broken in one place at a time.

#include <hdf5.h>
#include <catch2/catch.hpp>
#include <fstream>
#include <limits>

#include "core/error.h"
#include "database/format/hdf5_handle.h"
#include "database/records/database.h"
#include "database/records/schema.h"
#include "database/search/stored_index.h"
#include "tests/support/bridges.h"
#include "tests/support/made_up_database.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/whole_database.h"

namespace voussoir {
namespace {

/// A database with 45 scenes of the small bridge.
std::string small_file() {
  auto scenes = all_scenes(38, 2);
  scenes.resize(45);
  return test::made_up_bytes(test::small_bridge_file(), scenes);
}

/// Changes a good file by means of HDF5 itself, so that its structure is sound and its content is not what it
/// should be.
class Forgery {
 public:
  explicit Forgery(const std::string& good) : path_(folder_ / "forged.h5") {
    std::ofstream(path_, std::ios::binary) << good;
    file_ = Hdf5Handle(H5Fopen(path_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
    REQUIRE(file_);
  }
  hid_t file() const { return file_.get(); }
  void remove(const char* dataset_path) const { REQUIRE(H5Ldelete(file(), dataset_path, H5P_DEFAULT) >= 0); }

  /// Puts a dataset of this type and shape in the place of another, without data.
  void replace(const char* dataset_path, hid_t type, const std::vector<hsize_t>& shape,
               hid_t properties = H5P_DEFAULT) const {
    remove(dataset_path);
    const Hdf5Handle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose);
    const Hdf5Handle made(
        H5Dcreate2(file(), dataset_path, type, space.get(), H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose);
    REQUIRE(made);
  }

  template <class T>
  void fill(const char* dataset_path, hid_t type, const std::vector<T>& values) const {
    const Hdf5Handle opened(H5Dopen2(file(), dataset_path, H5P_DEFAULT), H5Dclose);
    REQUIRE(H5Dwrite(opened.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0);
  }

  std::vector<int> numbers(const char* dataset_path) const {
    const Hdf5Handle opened(H5Dopen2(file(), dataset_path, H5P_DEFAULT), H5Dclose);
    const Hdf5Handle space(H5Dget_space(opened.get()), H5Sclose);
    std::vector<int> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space.get())));
    REQUIRE(H5Dread(opened.get(), H5T_NATIVE_INT, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0);
    return values;
  }

  std::string refusal() {
    file_.close();
    try {
      test::read_all(path_);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

 private:
  test::TemporaryFolder folder_;
  std::filesystem::path path_;
  Hdf5Handle file_;
};

}  // namespace

TEST_CASE("Datasets of another type, rank or size are refused and named") {
  const std::string good = small_file();
  const auto lock = lock_hdf5();
  const auto refusal = [&](const char* path, hid_t type, const std::vector<hsize_t>& shape) {
    Forgery forged(good);
    forged.replace(path, type, shape);
    return forged.refusal();
  };
  for (const char* path : {dataset::kVertical, dataset::kRemoved, dataset::kOutcome, dataset::kResidual,
                           dataset::kNodes, dataset::kBlockIndex, dataset::kTriangles, dataset::kPointName,
                           dataset::kChecksum, dataset::kVariant, dataset::kStates, dataset::kJointBlocks,
                           dataset::kJointEnds, dataset::kYoungModulus, dataset::kFriction}) {
    INFO(path);
    CHECK_THAT(refusal(path, H5T_IEEE_F32LE, {45, 30}), Catch::Contains(path));
    CHECK_THAT(refusal(path, H5T_IEEE_F64BE, {45, 30}), Catch::Contains(path));
    CHECK_THAT(refusal(path, H5T_IEEE_F64LE, {2, 2, 2}), Catch::Contains(path));
    CHECK_THAT(refusal(path, H5T_STD_I32LE, {1}), Catch::Contains(path));
    CHECK_THAT(refusal(path, H5T_STD_I32LE, {0}), Catch::Contains(path));
  }
}

TEST_CASE("Triangles, edges and joints that hang on nodes of other blocks are refused and named") {
  const std::string good = small_file();
  const auto lock = lock_hdf5();
  const auto refusal = [&](const char* path, std::size_t place, std::size_t taken_from) {
    Forgery forged(good);
    std::vector<int> numbers = forged.numbers(path);
    numbers.at(place) = numbers.at(std::min(taken_from, numbers.size() - 1));
    forged.fill(path, H5T_NATIVE_INT, numbers);
    return forged.refusal();
  };
  constexpr std::size_t kLast = std::numeric_limits<std::size_t>::max();
  CHECK_THAT(refusal(dataset::kTriangles, 0, kLast), Catch::Contains("'geometry/triangles' names node"));
  CHECK_THAT(refusal(dataset::kEdges, 0, kLast), Catch::Contains("'geometry/edges' names node"));
  CHECK_THAT(refusal(dataset::kEdges, 0, 1), Catch::Contains("expected edges round each block"));
  CHECK_THAT(refusal(dataset::kJointNodes, 0, kLast), Catch::Contains("'geometry/joint_nodes' names node"));
  CHECK_THAT(refusal(dataset::kJointNodes, 0, 1), Catch::Contains("expected those of a boundary edge"));
  CHECK_THAT(refusal(dataset::kJointBlocks, 0, 1), Catch::Contains("expected two in ascending order"));
}

TEST_CASE("A search index that was taken away is missed where scenes have displacements") {
  Forgery forged(small_file());
  forged.remove("search_built");
  CHECK_THAT(forged.refusal(), Catch::Contains("dataset 'search_built/exponent' is missing"));
}

TEST_CASE("A search index that names a scene twice or has numbers out of range is refused") {
  const std::string good = small_file();
  const auto refusal = [&](const char* name, int number) {
    const std::string path = index_path(kBuiltState, name);
    Forgery forged(good);
    {
      const auto lock = lock_hdf5();
      const std::vector<int> numbers(forged.numbers(path.c_str()).size(), number);
      forged.fill(path.c_str(), H5T_NATIVE_INT, numbers);
    }
    return forged.refusal();
  };
  CHECK_THAT(refusal(index_dataset::kRow, 0), Catch::Contains("search_built/ do not fit together"));
  CHECK_THAT(refusal(index_dataset::kFirst, 0), Catch::Contains("search_built/ do not fit together"));
  CHECK_THAT(refusal(index_dataset::kExponent, 1000),
             Catch::Contains("search_built/ hold numbers out of range"));
  CHECK_THAT(refusal(index_dataset::kCoarseness, -1),
             Catch::Contains("search_built/ hold numbers out of range"));
  CHECK_THAT(refusal(index_dataset::kLeast, 32000),
             Catch::Contains("search_built/ hold numbers out of range"));
  CHECK_THAT(refusal(index_dataset::kBounds, 0x7FFFFFFF),
             Catch::Contains("search_built/ hold numbers out of range"));
}

TEST_CASE("Absurd dimensions are refused without allocating memory for them") {
  const std::string good = small_file();
  const auto lock = lock_hdf5();
  constexpr hsize_t kHuge = hsize_t{1} << 59;
  for (const char* path : {dataset::kVertical, dataset::kNodes, dataset::kResidual}) {
    Forgery forged(good);
    forged.replace(path, H5T_IEEE_F64LE, {kHuge, 2});
    CHECK_THAT(forged.refusal(), Catch::Contains(path));
  }
  Forgery forged(good);
  forged.replace(dataset::kBridgeText, H5T_STD_U8LE, {kHuge, 2});
  CHECK_THAT(forged.refusal(), Catch::Contains(dataset::kBridgeText));
}

TEST_CASE("Links that lead round in circles, nowhere or out of the file are refused") {
  const std::string good = small_file();
  const auto lock = lock_hdf5();
  Forgery circle(good);
  circle.remove(dataset::kVertical);
  H5Lcreate_soft("/control/vertical_displacement", circle.file(), dataset::kVertical, H5P_DEFAULT,
                 H5P_DEFAULT);
  CHECK_THAT(circle.refusal(), Catch::Contains("'control/vertical_displacement' is missing"));
  Forgery outside(good);
  outside.remove(dataset::kVertical);
  H5Lcreate_external("/etc/passwd", "/", outside.file(), dataset::kVertical, H5P_DEFAULT, H5P_DEFAULT);
  CHECK_THAT(outside.refusal(), Catch::Contains("'control/vertical_displacement' is missing"));
  Forgery group(good);
  group.remove(dataset::kVertical);
  H5Lcreate_hard(group.file(), "/control", group.file(), dataset::kVertical, H5P_DEFAULT, H5P_DEFAULT);
  CHECK_THAT(group.refusal(), Catch::Contains("'control/vertical_displacement' has not the expected type"));
}

TEST_CASE(
    "Datasets that are compressed, compact or in other files are refused where the schema has them plain") {
  const std::string good = small_file();
  const auto lock = lock_hdf5();
  const Hdf5Handle chunked(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  const std::array<hsize_t, 2> chunk = {1, 2};
  H5Pset_chunk(chunked.get(), 2, chunk.data());
  const Hdf5Handle compact(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_layout(compact.get(), H5D_COMPACT);
  const Hdf5Handle external(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_external(external.get(), "/etc/passwd", 0, 32);
  for (const hid_t properties : {chunked.get(), compact.get(), external.get()}) {
    Forgery forged(good);
    forged.replace(dataset::kVertical, H5T_IEEE_F64LE, {2, 2}, properties);
    CHECK_THAT(forged.refusal(), Catch::Contains(dataset::kVertical));
  }
}

TEST_CASE("Attributes of another kind are refused and named") {
  const std::string good = small_file();
  const auto lock = lock_hdf5();
  for (const char* name : {attribute::kFormat, attribute::kDigest, attribute::kSchemaVersion}) {
    Forgery forged(good);
    H5Adelete(forged.file(), name);
    const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type.get(), H5T_VARIABLE);
    const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const char* text = "text";
    {
      const Hdf5Handle made(
          H5Acreate2(forged.file(), name, type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
      H5Awrite(made.get(), type.get(), &text);
    }
    CHECK_THAT(forged.refusal(), Catch::Contains(name));
  }
}

TEST_CASE("Another schema version is refused with both versions and with what to do") {
  const std::string good = small_file();
  const auto lock = lock_hdf5();
  Forgery forged(good);
  {
    const Hdf5Handle version(H5Aopen(forged.file(), attribute::kSchemaVersion, H5P_DEFAULT), H5Aclose);
    const std::int32_t earlier = 3;
    H5Awrite(version.get(), H5T_STD_I32LE, &earlier);
  }
  CHECK_THAT(forged.refusal(),
             Catch::Contains("schema version 3 where 7 was expected: build the database again with this "
                             "program's build-database [BRIDGE.toml] -o ") &&
                 Catch::Contains("forged.h5"));
}

TEST_CASE("Indices that point outside of their tables are refused") {
  const std::string good = small_file();
  const auto lock = lock_hdf5();
  const auto refusal = [&](const char* path, std::size_t count, std::int32_t number) {
    Forgery forged(good);
    forged.fill(path, H5T_STD_I32LE, std::vector<std::int32_t>(count, number));
    return forged.refusal();
  };
  const Model bridge = make_model(test::small_bridge_file().description);
  for (const std::int32_t number : {-2, -1000000, 1000000, std::numeric_limits<std::int32_t>::max()}) {
    CHECK_THAT(refusal(dataset::kTriangles, 3 * bridge.mesh.triangles.size(), number),
               Catch::Contains(dataset::kTriangles));
    CHECK_THAT(refusal(dataset::kEdges, 2 * bridge.mesh.edges.size(), number),
               Catch::Contains(dataset::kEdges));
    CHECK_THAT(refusal(dataset::kBlockNodes, 2 * bridge.layout.size(), number),
               Catch::Contains(dataset::kBlockNodes));
    CHECK_THAT(refusal(dataset::kBlockCorners, 2 * bridge.layout.size(), number),
               Catch::Contains(dataset::kBlockCorners));
    CHECK_THAT(refusal(dataset::kRemoved, 2 * 45, number), Catch::Contains(dataset::kRemoved));
    CHECK_THAT(refusal(dataset::kVariant, 45, number), Catch::Contains(dataset::kVariant));
    CHECK_THAT(refusal(dataset::kJointBlocks, 2 * bridge.joints.size(), number),
               Catch::Contains(dataset::kJointBlocks));
    CHECK_THAT(refusal(dataset::kJointNodes, 4 * bridge.joints.size(), number),
               Catch::Contains(dataset::kJointNodes));
    CHECK_THAT(refusal(dataset::kPointBlock, bridge.control_points.size(), number),
               Catch::Contains("does not exist"));
  }
}

TEST_CASE("What sensors read is refused if it is of another block, of no point or of no number") {
  auto scenes = all_scenes(38, 1);
  const BridgeFile sensed = test::small_file_with_sensors();
  const Model bridge = make_model(sensed.description);
  const std::string good = test::made_up_bytes(sensed, scenes);
  const std::size_t count = test::weight_count(bridge), points = bridge.control_points.size();
  const auto lock = lock_hdf5();
  const auto refusal = [&](const char* path, hid_t type, const auto& values) {
    Forgery forged(good);
    forged.fill(path, type, values);
    return forged.refusal();
  };
  const auto ints = [](std::size_t size, std::int32_t number) {
    return std::vector<std::int32_t>(size, number);
  };
  for (const std::int32_t number : {-2, 1000000}) {
    CHECK_THAT(refusal(dataset::kWeightPoint, H5T_STD_I32LE, ints(count, number)),
               Catch::Contains(dataset::kWeightPoint));
    CHECK_THAT(refusal(dataset::kWeightNode, H5T_STD_I32LE, ints(count, number)),
               Catch::Contains(dataset::kWeightNode));
    CHECK_THAT(refusal(dataset::kPointOtherBlock, H5T_STD_I32LE, ints(points, number)),
               Catch::Contains("does not exist"));
  }
  CHECK_THAT(refusal(dataset::kWeightNode, H5T_STD_I32LE, ints(count, 0)),
             Catch::Contains("expected one of a block of sensor V1"));
  CHECK_THAT(
      refusal(dataset::kWeightPoint, H5T_STD_I32LE, ints(count, static_cast<std::int32_t>(points) - 1)),
      Catch::Contains("of a block of sensor G1") || Catch::Contains("has no weights of sensor"));
  CHECK_THAT(refusal(dataset::kPointQuantity, H5T_STD_U8LE, std::vector<std::uint8_t>(points, 4)),
             Catch::Contains(dataset::kPointQuantity));
  CHECK_THAT(refusal(dataset::kWeight, H5T_NATIVE_DOUBLE, std::vector<double>(2 * count, std::nan(""))),
             Catch::Contains(dataset::kWeight));
}

TEST_CASE("A field that would swell to far more than a field when decompressed is refused") {
  const std::string good = small_file();
  const auto lock = lock_hdf5();
  Forgery forged(good);
  {
    const Hdf5Handle fields(H5Dopen2(forged.file(), dataset::kField, H5P_DEFAULT), H5Dclose);
    const Bytes bomb = pack_field(Field::Zero(2, 1'000'000));
    const std::array<hsize_t, 4> offset = {0, 3, 0, 0};
    REQUIRE(H5Dwrite_chunk(fields.get(), H5P_DEFAULT, 0, offset.data(), bomb.size(), bomb.data()) >= 0);
  }
  CHECK_THAT(forged.refusal(), Catch::Contains("field"));
}

}  // namespace voussoir
