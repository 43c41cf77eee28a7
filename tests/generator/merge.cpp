/// @file Parts of a database put together. Oracle: the digest of one build of the whole.

#include "generator/merge.h"

#include <catch2/catch.hpp>
#include <fstream>
#include <random>

#include "core/error.h"
#include "core/structure/mirror_symmetry.h"
#include "database/records/journal.h"
#include "generator/scenes/variants.h"
#include "tests/support/file_text.h"
#include "tests/support/made_up_solver.h"
#include "tests/support/temporary_folder.h"

namespace voussoir {
namespace {

using Catch::Contains;

SolverChoice made_up(const std::string&) {
  return test::made_up_solver();
}

struct MergeSite {
  test::TemporaryFolder folder;
  BuildRequest request;
  MergeRequest merging;

  MergeSite() {
    request.bridge = test::small_bridge_file();
    request.threads = 2;
    merging.threads = 2;
    merging.output = folder / "merged.h5";
  }
  BuildSummary build(const std::string& name, std::optional<Shard> shard = std::nullopt) {
    BuildRequest one = request;
    one.output = folder / name;
    one.shard = shard;
    Progress quiet(Progress::Mode::quiet);
    return build_database(one, test::made_up_solver(), quiet);
  }
  void build_parts(int count) {
    for (int number = 1; number <= count; ++number) {
      const std::string name = fmt::format("part{}.h5", number);
      build(name, Shard{number, count});
      merging.parts.push_back(folder / name);
    }
  }
  BuildSummary merge() const {
    Progress quiet(Progress::Mode::quiet);
    return merge_databases(merging, made_up, quiet);
  }
  void refuses(const std::string& why) const {
    CHECK_THROWS_WITH(merge(), Contains(why));
    CHECK_FALSE(std::filesystem::exists(merging.output));
    CHECK_FALSE(std::filesystem::exists(Journal::path_for(merging.output)));
  }
};

}  // namespace

TEST_CASE("Sixteen parts in any order, two of them lost and redone, give the digest of one build") {
  MergeSite site;
  site.request.histories = "built,lost";
  const BuildSummary whole = site.build("whole.h5");
  site.build_parts(16);
  for (const int lost : {3, 11}) {
    std::filesystem::remove(site.merging.parts[static_cast<std::size_t>(lost - 1)]);
    site.build(fmt::format("part{}.h5", lost), Shard{lost, 16});
  }
  std::mt19937 generator(1);
  std::ranges::shuffle(site.merging.parts, generator);
  const BuildSummary merged = site.merge();
  CHECK(merged.digest == whole.digest);
  CHECK(merged.computed == 0);
  CHECK(merged.outcomes.scenes == whole.outcomes.scenes);
  CHECK_FALSE(Database::open(merged.output).shard().has_value());
  CHECK(site.merge().up_to_date);
}

TEST_CASE("Every scene is in one part, the intact bridge in all, and mirror images stay together") {
  MergeSite site;
  site.build_parts(4);
  const Database whole = Database::open(site.build("whole.h5").output);
  const Model bridge = make_model(site.request.bridge.description);
  std::map<Scene, int> parts_with;
  std::vector<std::size_t> rows;
  for (const auto& path : site.merging.parts) {
    const Database part = Database::open(path);
    rows.push_back(part.rows());
    for (std::size_t row = 0; row < part.rows(); ++row) {
      ++parts_with[part.key(row).scene];
      CHECK(part.find(mirrored(part.key(row).scene, *bridge.symmetry)).has_value());
    }
  }
  CHECK(parts_with.size() == whole.rows());
  for (const auto& [scene, parts] : parts_with) CHECK(parts == (scene.removed.empty() ? 4 : 1));
  // Scenes that are their own mirror images make a part smaller; few are.
  CHECK(static_cast<double>(std::ranges::min(rows)) > 0.9 * static_cast<double>(std::ranges::max(rows)));
}

TEST_CASE("Parts of a build with variants, without fields or of few scenes give its digest") {
  MergeSite site;
  SECTION("variants") {
    const Model bridge = make_model(site.request.bridge.description);
    site.request.other_variants = sampled_variants(bridge, site.request.bridge.description.uncertainty, 2, 5);
    site.request.scenes = "intact;4,*";
    site.request.scenes_of_variants = "singles";
  }
  SECTION("no fields, a known bridge") {
    site.request.fields = KeepField::no;
    site.request.known_bridge = true;
  }
  SECTION("no intact bridge") {
    site.request.scenes = "4,*+5,*";
  }
  SECTION("blocks lost only") {
    site.request.histories = "lost";
  }
  const BuildSummary whole = site.build("whole.h5");
  site.build_parts(3);
  CHECK(site.merge().digest == whole.digest);
}

TEST_CASE("Parts that do not fit together are named and refused") {
  MergeSite site;
  site.request.scenes = "singles;4,*+5,1..2";
  SECTION("one is missing") {
    site.build_parts(3);
    site.merging.parts.erase(site.merging.parts.begin() + 1);
    site.refuses("of 3 parts these are not among the files: 2");
  }
  SECTION("one is there twice") {
    site.build_parts(2);
    std::filesystem::copy_file(site.merging.parts[0], site.folder / "copy.h5");
    site.merging.parts.push_back(site.folder / "copy.h5");
    site.refuses("part1.h5");
  }
  SECTION("another bridge") {
    site.build_parts(1);
    site.request.bridge.text += "\n# another one\n";
    site.build("part2.h5", Shard{2, 2});
    site.merging.parts.push_back(site.folder / "part2.h5");
    site.refuses("the bridge file");
  }
  SECTION("other scenes") {
    site.build("part1.h5", Shard{1, 2});
    site.request.scenes = "singles";
    site.build("part2.h5", Shard{2, 2});
    site.merging.parts = {site.folder / "part1.h5", site.folder / "part2.h5"};
    site.refuses("part of another whole");
  }
  SECTION("a whole database") {
    site.build("whole.h5");
    site.merging.parts = {site.folder / "whole.h5"};
    site.refuses("is a whole database");
  }
}

TEST_CASE("Parts that another version of the program made are refused") {
  MergeSite site;
  site.request.scenes = "singles";
  site.build_parts(2);
  Progress quiet(Progress::Mode::quiet);
  const auto other = [](const std::string&) { return quasi_static(); };
  CHECK_THROWS_WITH(merge_databases(site.merging, other, quiet), Contains("another version of the program"));
}

TEST_CASE("Merging leaves the scenes of an interrupted build of the same file alone") {
  MergeSite site;
  site.request.scenes = "singles;4,*+5,1..2";
  site.build_parts(2);
  BuildRequest interrupted = site.request;
  interrupted.output = site.merging.output;
  SECTION("another build's: refused") {
    interrupted.histories = "lost";
    Progress quiet(Progress::Mode::quiet);
    REQUIRE_THROWS_AS(build_database(interrupted, test::failing_solver(20), quiet), Failure);
    const std::string journal = test::text_of(Journal::path_for(site.merging.output));
    CHECK_THROWS_WITH(site.merge(),
                      Contains("merged.h5.partial: holds scenes of an interrupted build-database"));
    CHECK(test::text_of(Journal::path_for(site.merging.output)) == journal);
  }
  SECTION("the same build's, and a part has lost a scene: kept") {
    interrupted.scenes = "intact;4,1";
    Progress quiet(Progress::Mode::quiet);
    REQUIRE_THROWS_AS(build_database(interrupted, test::failing_solver(2), quiet), Failure);
    const auto journal = std::filesystem::file_size(Journal::path_for(site.merging.output));
    std::string bytes = test::text_of(site.merging.parts[0]);
    bytes[bytes.size() / 2] ^= 4;  // amid the fields
    std::ofstream(site.merging.parts[0], std::ios::binary) << bytes;
    CHECK_THROWS_WITH(site.merge(), Contains("part 1/2 lacks scene"));
    CHECK(std::filesystem::file_size(Journal::path_for(site.merging.output)) == journal);
  }
}

TEST_CASE("Merging drops valid scenes of the file that the parts do not have only if it may") {
  MergeSite site;
  site.request.scenes = "singles;4,*+5,1..2";
  site.build("merged.h5");
  site.request.scenes = "singles";
  site.build_parts(2);
  CHECK_THROWS_WITH(site.merge(), Contains("would be lost") && Contains("--drop"));
  site.merging.drop = true;
  CHECK(site.merge().digest == site.build("whole.h5").digest);
}

TEST_CASE("A part whose list of scenes was given with blanks and lines is up to date, and merges") {
  MergeSite site;
  site.request.scenes = "  singles ;\n4,*+5,1..2 ";
  site.build_parts(2);
  CHECK(site.build("part1.h5", Shard{1, 2}).up_to_date);
  CHECK(site.merge().digest == site.build("whole.h5").digest);
}

TEST_CASE("What a part says of itself comes back, and nothing else is taken for it") {
  const ShardStatement statement{{3, 16}, "singles;4,1", "", "built,lost", "all", false, true};
  CHECK(parse_shard_statement(to_text(statement)) == statement);
  CHECK_FALSE(parse_shard_statement("").has_value());
  CHECK_FALSE(parse_shard_statement("shard = 3/16\n").has_value());
  for (const char* text : {"", "3", "0/4", "5/4", "1/0", "-1/4", "1/4/4", "a/b", "1/99999999999"})
    CHECK_FALSE(parse_shard(text).has_value());
  CHECK(parse_shard("4/4") == Shard{4, 4});
}

}  // namespace voussoir
