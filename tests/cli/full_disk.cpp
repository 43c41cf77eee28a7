/// @file build-database on a disk that is really full: a small tmpfs, mounted for the test.

#include <sys/mount.h>

#include <catch2/catch.hpp>
#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>

#include "database/records/database.h"
#include "database/records/writer.h"
#include "tests/support/answer.h"
#include "tests/support/bridges.h"
#include "tests/support/program.h"

namespace voussoir {
namespace {

/// A folder on a file system of its own.
class SmallDisk {
 public:
  explicit SmallDisk(std::size_t bytes) {
    mounted_ = ::mount("tmpfs", folder_.path().c_str(), "tmpfs", 0, size_option(bytes).c_str()) == 0;
    if (!mounted_) WARN("skipped: no file system can be mounted here: " << std::strerror(errno));
  }
  ~SmallDisk() {
    if (mounted_) ::umount2(folder_.path().c_str(), MNT_DETACH);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  bool is_there() const { return mounted_; }
  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }
  void resize(std::size_t bytes) const {
    REQUIRE(::mount("tmpfs", folder_.path().c_str(), "tmpfs", MS_REMOUNT, size_option(bytes).c_str()) == 0);
  }

 private:
  static std::string size_option(std::size_t bytes) { return "size=" + std::to_string(bytes); }

  test::TemporaryFolder folder_;
  bool mounted_ = false;
};

constexpr std::size_t kPlenty = std::size_t{64} << 20;

test::ProgramResult build(const std::filesystem::path& output, const std::string& scenes = "all") {
  return test::run("build-database", {test::example_bridge("small").string(), "-o", output.string(),
                                      "--scenes", scenes, "--format", "json"});
}

/// Digest and size of the small bridge's database, built where there is room.
nlohmann::json undisturbed() {
  static const nlohmann::json summary = [] {
    const test::TemporaryFolder folder;
    return test::json_of(build(folder / "small.h5"));
  }();
  return summary;
}

}  // namespace

TEST_CASE("On a full disk the build says so, keeps what is done and goes on when there is room",
          "[whole-build]") {
  const SmallDisk disk(std::size_t{512} << 10);
  if (!disk.is_there()) return;
  const test::ProgramResult full = build(disk / "small.h5");
  CHECK(full.exit_code == 1);
  CHECK_THAT(full.err,
             Catch::Contains("No space left on device") && Catch::Contains("run the same command again"));
  CHECK(nlohmann::json::parse(full.out).at("ok") == false);
  const std::string error = nlohmann::json::parse(full.out).at("error");
  CHECK_THAT(full.err, Catch::EndsWith("build-database: " + error + "\n"));
  CHECK_FALSE(std::filesystem::exists(disk / "small.h5"));
  CHECK(build(disk / "small.h5").exit_code == 1);  // the disk is as full as before

  disk.resize(kPlenty);
  const auto json = test::json_of(build(disk / "small.h5"));
  CHECK(json.at("resumed") > 20);
  CHECK(json.at("digest") == undisturbed().at("digest"));
}

TEST_CASE("On a disk with room for the scenes but not for the finished file every scene is kept",
          "[whole-build]") {
  const SmallDisk disk(undisturbed().at("bytes"));  // the journal is smaller than the database
  if (!disk.is_there()) return;
  const test::ProgramResult full = build(disk / "small.h5");
  CHECK(full.exit_code == 1);
  CHECK_THAT(full.err, Catch::Contains("No space left on device") && Catch::Contains("all scenes are kept"));
  CHECK_FALSE(std::filesystem::exists(disk / "small.h5"));
  CHECK_FALSE(std::filesystem::exists(unfinished_path(disk / "small.h5")));

  disk.resize(kPlenty);
  const auto json = test::json_of(build(disk / "small.h5"));
  CHECK(json.at("resumed") == 742);
  CHECK(json.at("computed") == 0);
  CHECK(json.at("digest") == undisturbed().at("digest"));
}

TEST_CASE("On a full disk the old database stays as it was", "[whole-build]") {
  const SmallDisk disk(undisturbed().at("bytes"));
  if (!disk.is_there()) return;
  const std::string before = test::json_of(build(disk / "small.h5", "singles")).at("digest");
  CHECK(build(disk / "small.h5").exit_code == 1);
  CHECK(Database::open(disk / "small.h5").digest() == before);
}

}  // namespace voussoir
