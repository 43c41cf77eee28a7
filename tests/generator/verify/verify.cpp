#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "database/records/columns.h"
#include "database/search/stored_index.h"
#include "tests/support/few_scenes.h"
#include "tests/support/made_up_solver.h"

namespace voussoir {
namespace {

/// Part of a file that belongs to scenes. A report has to name the scene or, where the damage is such that
/// the file is not read at all, the dataset.
struct Stretch {
  std::string scene;
  std::string dataset;
  std::size_t offset;
  std::size_t size;
};

/// Rows of the scenes' datasets and stored chunks, one stretch a scene each. A report names the scene, or the
/// dataset if it cannot be read at all. A scene whose removed blocks are changed has another name.
std::vector<Stretch> scene_stretches(const Database& database, const std::string& bytes) {
  std::vector<Stretch> stretches;
  const auto scene = [&](std::size_t row) {
    return "scene " + to_string(database.key(row), database.layout());
  };
  for (const Column& column : record_columns()) {
    if (column.form == Form::packed || column.optional) continue;  // here all scenes are solved
    const std::string path = column.path;
    const bool is_key = path == dataset::kRemoved || path == dataset::kVariant;  // it becomes another scene
    const ByteView whole = database.dataset_bytes(column.path);
    const std::size_t width = whole.size() / database.rows();
    for (std::size_t row = 0; row < database.rows(); ++row)
      stretches.push_back({is_key ? "scene " : scene(row) + ":", path,
                           test::place_of(bytes, database, column.path) + row * width, width});
  }
  for (std::size_t row = 0; row < database.rows(); ++row) {
    const Bytes chunk = database.record(row).states.at(0).packed_field;
    stretches.push_back({scene(row) + ":", dataset::kField, test::place_of(bytes, chunk), chunk.size()});
  }
  for (const char* name : {index_dataset::kCentre, index_dataset::kLeast, index_dataset::kMost,
                           index_dataset::kRow, index_dataset::kBounds, index_dataset::kSketch}) {
    const std::string path = index_path(kBuiltState, name);
    stretches.push_back({"no scene", path, test::place_of(bytes, database, path.c_str()),
                         database.dataset_bytes(path.c_str()).size()});
  }
  return stretches;
}

/// A bit, chosen evenly over all stretches or, every other time, over the small datasets only.
std::pair<const Stretch*, std::size_t> choose_bit(const std::vector<Stretch>& stretches, bool small,
                                                  std::mt19937_64& random) {
  std::vector<const Stretch*> choices;
  std::vector<std::size_t> weights;
  for (const Stretch& stretch : stretches) {
    choices.push_back(&stretch);
    weights.push_back(small ? std::min<std::size_t>(stretch.size, 100) : stretch.size);
  }
  const Stretch* chosen =
      choices[std::discrete_distribution<std::size_t>(weights.begin(), weights.end())(random)];
  return {chosen, random() % (8 * chosen->size)};
}

/// Whole files, each with one bit changed.
void flip_bits_and_verify(int trials) {
  const test::FewScenes few;
  std::vector<Stretch> stretches;
  {
    const Database database = Database::open(few.path);
    stretches = scene_stretches(database, few.bytes);
  }
  std::mt19937_64 random(static_cast<std::uint64_t>(trials));
  for (int trial = 0; trial < trials; ++trial) {
    const auto [stretch, bit] = choose_bit(stretches, trial % 2 == 0, random);
    std::string changed = few.bytes;
    changed[stretch->offset + bit / 8] =
        static_cast<char>(changed[stretch->offset + bit / 8] ^ (1 << (bit % 8)));
    const VerifyReport report = few.verify_with(changed);
    INFO("trial " << trial << ", byte " << stretch->offset + bit / 8 << ", " << stretch->scene << ", "
                  << stretch->dataset);
    REQUIRE_FALSE(report.ok());
    REQUIRE((test::names(report, stretch->scene) || test::names(report, "'" + stretch->dataset + "'")));
  }
}

/// Of the intact bridge and all singles, with answers that are made up.
VerifyReport report_of_made_up() {
  const test::TemporaryFolder folder;
  Progress quiet(Progress::Mode::quiet);
  BuildRequest request;
  request.bridge = test::small_bridge_file();
  request.output = folder / "made-up.h5";
  request.scenes = "singles";
  request.rules.mirror_images = false;
  request.known_bridge = true;
  build_database(request, test::made_up_solver(), quiet);
  return verify_database({request.output});
}

}  // namespace

TEST_CASE("A database just built is in order and its scenes come out the same when solved anew",
          "[threads]") {
  const test::FewScenes few;
  const VerifyReport report = few.verify_with(few.bytes, 6);
  CHECK(report.problems == std::vector<std::string>{});
  CHECK(report.outcomes.scenes == 6);
  CHECK(report.fields == 6);
  CHECK(report.recomputed == 6);
  CHECK(report.largest_recomputed_difference == 0.0);
  CHECK(report.largest_unbalance > 0.0);
  CHECK(report.largest_unbalance <= report.most_unbalance);
}

TEST_CASE("100 single bits flipped in scene data are all found, and the scene or dataset is named") {
  flip_bits_and_verify(100);
}

TEST_CASE("1,000 single bits flipped in scene data are all found, and the scene or dataset is named",
          "[many-solutions]") {
  flip_bits_and_verify(1000);
}

TEST_CASE("A flipped bit in the geometry is found and its dataset named, in the bridge's text the digest") {
  const test::FewScenes few;
  for (const char* path :
       {dataset::kCorners, dataset::kNodes, dataset::kPointPosition, dataset::kBridgeText,
        dataset::kJointLength, dataset::kStates, dataset::kDensity, dataset::kTangentialStiffness}) {
    std::size_t place = 0;
    {
      const Database database = Database::open(few.path);
      place = test::place_of(few.bytes, database, path) + 6;
    }
    std::string changed = few.bytes;
    changed[place] = static_cast<char>(changed[place] ^ 1);
    const VerifyReport report = few.verify_with(changed);
    INFO(path);
    CHECK_FALSE(report.ok());
    CHECK(test::names(report, fmt::format("dataset '{}'", path)));
    few.verify_with(few.bytes);
  }
}

TEST_CASE("Fields that are out of equilibrium are found although every checksum is right") {
  const VerifyReport report = report_of_made_up();
  CHECK(report.outcomes.scenes == 39);
  REQUIRE(report.problems.size() >= report.outcomes.states.front().standing);
  CHECK_THAT(report.problems.front(),
             Catch::Contains("scene intact: stands, but its field is out of equilibrium"));
}

TEST_CASE("Mirror images whose fields are not mirrored are found") {
  const VerifyReport report = report_of_made_up();
  CHECK(report.mirror_pairs > 10);
  CHECK(std::any_of(report.problems.begin(), report.problems.end(), [](const std::string& problem) {
    return problem.find("differs from its mirror image") != std::string::npos;
  }));
}

}  // namespace voussoir
