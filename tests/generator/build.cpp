/// @file Builds of one file, again and interrupted, by a made-up solver (made_up_solver.h) and the real one.
/// Oracle: the digest of a build from nothing.

#include <catch2/catch.hpp>
#include <cstring>
#include <fstream>

#include "core/structure/mirror_symmetry.h"
#include "database/records/database.h"
#include "database/records/journal.h"
#include "database/records/schema.h"
#include "generator/build.h"
#include "generator/scenes/start_field.h"
#include "tests/support/damaged_database.h"
#include "tests/support/file_text.h"
#include "tests/support/made_up_solver.h"
#include "tests/support/same_bits.h"
#include "tests/support/temporary_folder.h"

namespace voussoir {
namespace {

/// A folder to build in and the request for the small bridge.
struct Site {
  test::TemporaryFolder folder;
  BuildRequest request;

  Site() {
    request.bridge = test::small_bridge_file();
    request.output = folder / "small.h5";
    request.threads = 2;
  }
  BuildSummary build(const SolverChoice& solver = test::made_up_solver()) const {
    Progress quiet(Progress::Mode::quiet);
    return build_database(request, solver, quiet);
  }
  Database open() const { return Database::open(request.output); }
};

std::string digest_of_reference() {
  static const std::string digest = Site().build().digest;
  return digest;
}

}  // namespace

TEST_CASE("A build holds all scenes and leaves nothing but the database behind") {
  const Site site;
  const BuildSummary summary = site.build();
  CHECK(summary.outcomes.scenes == 1 + 38 + 38 * 37 / 2);
  REQUIRE(summary.outcomes.states.size() == 1);
  const StateOutcomes& outcomes = summary.outcomes.states.front();
  CHECK(outcomes.standing + outcomes.collapsed + outcomes.unresolved.size() == summary.outcomes.scenes);
  CHECK(summary.computed == summary.outcomes.scenes);
  CHECK(std::distance(std::filesystem::directory_iterator(site.folder.path()), {}) == 1);
  CHECK(site.open().digest() == summary.digest);
  CHECK(site.open().table().rows == summary.outcomes.scenes);
}

TEST_CASE("The digest is the same for 1, 2 and 5 threads", "[threads]") {
  for (const int threads : {1, 2, 5}) {
    Site site;
    site.request.threads = threads;
    CHECK(site.build().digest == digest_of_reference());
  }
}

TEST_CASE("The digest of real scenes is the same for 1 and for 4 threads") {
  std::string expected;
  for (const int threads : {1, 4}) {
    Site site;
    site.request.threads = threads;
    site.request.scenes = "singles;4,*+5,1..2";
    const std::string digest = site.build(quasi_static()).digest;
    if (threads > 1) CHECK(digest == expected);
    expected = digest;
  }
}

TEST_CASE("A build interrupted at any scene goes on where it stopped and ends with the same digest",
          "[threads]") {
  for (const int scenes : {1, 2, 5, 20, 40, 100, 350}) {
    const Site site;
    REQUIRE_THROWS_AS(site.build(test::failing_solver(scenes)), Failure);
    CHECK_FALSE(std::filesystem::exists(site.request.output));
    const BuildSummary summary = site.build();
    CHECK(summary.resumed + summary.computed == summary.outcomes.scenes);
    // Both threads lose no more than their batches, a quarter of the pairs' solutions; these are half as many
    // as pairs, but for a few pairs that are their own images.
    CHECK(summary.resumed + 38 * 37 / 2 / 2 / 4 + 10 >= static_cast<std::size_t>(scenes));
    CHECK(summary.digest == digest_of_reference());
  }
}

TEST_CASE("A build interrupted again and again ends with the same digest") {
  const Site site;
  int interruptions = 0;
  for (bool done = false; !done; ++interruptions) try {
      site.build(test::failing_solver(150));  // of 742 scenes
      done = true;
    } catch (const Failure&) {
    }
  CHECK(interruptions > 2);
  CHECK(site.open().digest() == digest_of_reference());
}

TEST_CASE("Mirror images are recorded with mirrored fields, bit by bit") {
  const Site site;
  site.build();
  const Database database = site.open();
  const Model bridge = make_model(site.request.bridge.description);
  std::size_t own_images = 0;
  for (std::size_t row = 0; row < database.table().rows; ++row) {
    const Scene scene = database.table().scene(row);
    const Scene image = mirrored(scene, *bridge.symmetry);
    own_images += image == scene ? 1 : 0;
    if (image == scene) continue;
    const Field expected = to_storage_precision(mirrored(database.field(row), *bridge.symmetry));
    REQUIRE(test::same_bits(database.field(*database.find(image)), expected));
  }
  CHECK(own_images < database.table().rows / 10);
}

TEST_CASE("Without mirror images every scene is solved and the digest says so") {
  Site site;
  site.request.rules.mirror_images = false;
  CHECK(site.build().digest != digest_of_reference());
  const Database database = site.open();
  const Model bridge = make_model(site.request.bridge.description);
  const Scene last = database.table().scene(database.table().rows - 1);
  StartingFields starts;
  starts.add(Scene{}, 0, database.solution(0));
  for (const BlockId block : last.removed)
    starts.add(Scene{{block}}, 0, database.solution(*database.find(Scene{{block}})));
  const Field expected =
      to_storage_precision(test::answer_from(bridge, last, starts.start_for(last)).displacement);
  CHECK(test::same_bits(database.field(database.table().rows - 1), expected));
}

TEST_CASE("A scene's record does not depend on which other scenes are built") {
  Site whole;
  whole.build();
  const Database all = whole.open();
  for (const char* list : {"5,4", "5,4+1,1", "0,3+0,4;2,2"}) {
    Site site;
    site.request.scenes = list;
    site.build();
    const Database some = site.open();
    for (std::size_t row = 0; row < some.table().rows; ++row) {
      const Record expected = all.record(*all.find(some.table().scene(row)));
      CHECK(some.record(row).checksum == expected.checksum);
      CHECK(test::same_bits(some.field(row), all.field(*all.find(some.table().scene(row)))));
    }
  }
}

TEST_CASE("Building without fields keeps the same control displacements") {
  Site site;
  site.request.fields = KeepField::no;
  site.build();
  Site whole;
  whole.build();
  const Database lean = site.open();
  const Database full = whole.open();
  CHECK_FALSE(lean.has_fields());
  CHECK(std::memcmp(lean.table().vertical.data(), full.table().vertical.data(),
                    full.table().vertical.size_bytes()) == 0);
}

TEST_CASE("A file that is up to date is left alone") {
  const Site site;
  site.build();
  const std::string before = test::text_of(site.request.output);
  const BuildSummary summary = site.build(test::failing_solver(1));
  CHECK(summary.up_to_date);
  CHECK(summary.digest == digest_of_reference());
  CHECK(test::text_of(site.request.output) == before);
}

TEST_CASE("Forced, a build computes everything anew") {
  Site site;
  site.build();
  site.request.force = true;
  const BuildSummary summary = site.build();
  CHECK(summary.computed == summary.outcomes.scenes);
  CHECK(summary.reused == 0);
  CHECK(summary.digest == digest_of_reference());
}

TEST_CASE("When only remarks of the bridge file change every record is kept and the new text is stored") {
  Site site;
  site.build();
  site.request.bridge.text += "# a remark\n";
  const BuildSummary summary = site.build(test::failing_solver(1));
  CHECK(summary.changes == std::vector<std::string>{"the bridge file"});
  CHECK(summary.reused == summary.outcomes.scenes);
  CHECK(summary.computed == 0);
  CHECK(site.open().bridge_text() == site.request.bridge.text);
  CHECK(summary.digest != digest_of_reference());
}

TEST_CASE("When the material changes everything is computed anew") {
  // Expansion decides what settles (settling.h).
  for (const std::string text :
       {"[material]\ndensity_kg_m3 = 2500\n", "[material]\nthermal_expansion_per_K = 1e-5\n"}) {
    INFO(text);
    Site site;
    site.build();
    site.request.bridge = parse_bridge_file(site.request.bridge.text + text, "small.toml");
    const BuildSummary summary = site.build();
    CHECK(summary.computed == summary.outcomes.scenes);
    CHECK(summary.reused == 0);
  }
}

TEST_CASE("When the list of scenes grows only new scenes are computed") {
  Site site;
  site.request.scenes = "singles";
  site.build();
  site.request.scenes = "all";
  const BuildSummary summary = site.build();
  CHECK(summary.reused == 39);
  CHECK(summary.computed == summary.outcomes.scenes - 39);
  CHECK(summary.digest == digest_of_reference());
}

TEST_CASE("Damaged records of the old file are computed anew") {
  Site site;
  site.build();
  std::string bytes = test::text_of(site.request.output);
  bytes[bytes.size() / 2] ^= 4;  // amid the fields
  std::ofstream(site.request.output, std::ios::binary) << bytes;
  site.request.bridge.text += "# a remark\n";
  const BuildSummary summary = site.build();
  CHECK(summary.computed >= 1);
  CHECK(summary.computed <= 2);
  Site direct;
  direct.request.bridge = site.request.bridge;
  CHECK(direct.build().digest == summary.digest);
}

TEST_CASE("A build does not replace a file that is no database unless forced") {
  Site site;
  std::ofstream(site.request.output) << "point,uy_mm\nT1,-1\n";
  CHECK_THROWS_WITH(site.build(), Catch::Contains("no database"));
  CHECK(test::text_of(site.request.output) == "point,uy_mm\nT1,-1\n");
  site.request.force = true;
  CHECK(site.build().digest == digest_of_reference());
}

TEST_CASE("A build does not replace an HDF5 file of another program unless forced") {
  Site site;
  site.build();
  std::string bytes = test::text_of(site.request.output);
  SECTION("another format") {
    bytes = test::forged_at(test::good_database(bytes), bytes.find(kFormatName), 'V');
  }
  SECTION("of which we cannot read even the superblock") {
    bytes[8] = 0;
    const std::size_t at = bytes.find(kBridgeTextMeaning);
    REQUIRE(at < 4096);
    bytes[at] = 'T';
  }
  std::ofstream(site.request.output, std::ios::binary) << bytes;
  CHECK_THROWS_WITH(site.build(), Catch::Contains("no database; give another file with -o, or --force"));
  CHECK(test::text_of(site.request.output) == bytes);
  site.request.force = true;
  CHECK(site.build().digest == digest_of_reference());
}

TEST_CASE("A file whose bridge text is damaged gives no records and is built anew") {
  const Site site;
  site.build();
  std::string bytes = test::text_of(site.request.output);
  bytes.at(bytes.find("[wall]")) = '"';
  std::ofstream(site.request.output, std::ios::binary) << bytes;
  const BuildSummary summary = site.build();
  CHECK(summary.reused == 0);
  CHECK(summary.digest == digest_of_reference());
}

TEST_CASE("A build writes through symbolic links, to where they lead") {
  Site site;
  const std::filesystem::path target = site.folder / "elsewhere" / "small.h5", link = site.folder / "link.h5";
  std::filesystem::create_directory(target.parent_path());
  std::filesystem::create_symlink("elsewhere/small.h5", site.folder / "nearer.h5");
  std::filesystem::create_symlink("nearer.h5", link);
  site.request.output = link;
  site.request.scenes = "intact";
  CHECK(site.build().computed == 1);  // the link leads to no file yet
  site.request.scenes = "intact;4,1";
  CHECK(site.build().computed == 1);
  CHECK(std::filesystem::is_symlink(link));
  CHECK(std::filesystem::is_regular_file(target));
  CHECK(Database::open(target).rows() == 2);
  site.request.output = site.folder / "circle.h5";
  std::filesystem::create_symlink("circle.h5", site.request.output);
  CHECK_THROWS_WITH(site.build(), Catch::Contains("circle.h5: more than 40 symbolic links"));
}

TEST_CASE("An index for ParaView goes with the file that it showed, and never takes the database's place") {
  Site site;
  site.request.scenes = "singles";
  site.request.xdmf_scenes = "4,1";
  site.build();
  site.request.xdmf_scenes.clear();
  CHECK(site.build().up_to_date);
  CHECK(std::filesystem::exists(site.folder / "small.xdmf"));
  site.request.scenes = "4,*";  // the scene has another row
  site.request.drop = true;
  site.build();
  CHECK_FALSE(std::filesystem::exists(site.folder / "small.xdmf"));
  CHECK_FALSE(std::filesystem::exists(site.folder / "small.views.h5"));
  site.request.output = site.folder / "small.xdmf";
  site.request.xdmf_scenes = "4,1";
  CHECK_THROWS_WITH(site.build(), Catch::Contains("would be both database and index"));
}

TEST_CASE("A damaged database is replaced and the reason is told") {
  const Site site;
  site.build();
  std::filesystem::resize_file(site.request.output, std::filesystem::file_size(site.request.output) / 2);
  const BuildSummary summary = site.build();
  REQUIRE(summary.changes.size() == 1);
  CHECK_THAT(summary.changes[0], Catch::Contains("cannot be used"));
  CHECK(summary.digest == digest_of_reference());
}

TEST_CASE("An interrupted build of another bridge is not mixed in") {
  Site site;
  REQUIRE_THROWS_AS(site.build(test::failing_solver(150)), Failure);
  site.request.bridge.description.material.density = 2500.0;
  site.request.bridge.text += "[material]\ndensity_kg_m3 = 2500\n";
  const BuildSummary summary = site.build();
  CHECK(summary.resumed == 0);
  CHECK(summary.computed == summary.outcomes.scenes);
}

TEST_CASE("A second builder of the same file is told that there is one already") {
  const Site site;
  const Journal held =
      Journal::open(site.request.output, test::made_up_provenance(site.request.bridge), "any");
  CHECK_THROWS_WITH(site.build(), Catch::Contains("another build-database"));
}

}  // namespace voussoir
