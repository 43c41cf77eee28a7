#include "core/text_file.h"

#include <catch2/catch.hpp>

#include "core/error.h"
#include "tests/support/temporary_folder.h"

using Catch::Matchers::Contains;

namespace voussoir {

TEST_CASE("What a program reads, databases and bridge files are not written over") {
  const test::TemporaryFolder folder;
  write_file(folder / "readings.csv", "point,uy_mm\n");
  write_file(folder / "bridge.toml", "");
  write_file(folder / "other.h5", std::string("\x89HDF\r\n\x1a\n") + "and so on");
  const std::vector<std::filesystem::path> read = {folder / "readings.csv"};
  CHECK_THROWS_WITH(check_output("-o", folder / "readings.csv", {}, read),
                    Contains("-o:") && Contains("readings.csv") && Contains("is read by this very command"));
  CHECK_THROWS_WITH(check_output("-o", folder / "bridge.toml", {}), Contains("is a bridge file"));
  CHECK_THROWS_WITH(check_output("-o", folder / "other.h5", {}), Contains("is a database"));
  CHECK_THROWS_WITH(check_output("-o", folder / "page.pdf", {".html", ".svg"}),
                    Contains("page.pdf: expected a file that ends in .html or .svg"));
  CHECK_NOTHROW(check_output("-o", folder / "readings.csv", {}));
  CHECK_NOTHROW(check_output("-o", folder / "new.toml", {}));
  CHECK_NOTHROW(check_output("-o", "/dev/null", {".svg"}));
}

TEST_CASE("A file that cannot be written is named with the reason, and keeps what it had") {
  const test::TemporaryFolder folder;
  CHECK_THROWS_WITH(write_file("/nowhere/page.html", "x"),
                    Contains("/nowhere/page.html: cannot be written: No such file"));
  CHECK_THROWS_WITH(write_file("/dev/full", "x"), Contains("No space left"));
  const std::filesystem::path page = folder / (std::string(250, 'p') + ".html");
  write_file(page, "old");  // what would be written beside it has too long a name
  CHECK_THROWS_WITH(write_file(page, "new"), Contains("cannot be written: File name too long"));
  CHECK(read_text(page, 100, "a page") == "old");
}

TEST_CASE("A file that is written anew keeps its mode, links stay, and other files are not touched") {
  namespace fs = std::filesystem;
  const test::TemporaryFolder folder;
  const fs::path page = folder / "page.html", beside = folder / "page.html.new", link = folder / "link.html";
  write_file(page, "old");
  write_file(beside, "somebody's");
  fs::permissions(page, fs::perms::owner_read | fs::perms::owner_write);
  write_file(page, "new");
  CHECK(read_text(page, 100, "a page") == "new");
  CHECK(fs::status(page).permissions() == (fs::perms::owner_read | fs::perms::owner_write));
  CHECK(read_text(beside, 100, "a page") == "somebody's");
  fs::create_symlink(folder / "nowhere" / "page.html", link);
  CHECK_THROWS_AS(write_file(link, "x"), Failure);
  CHECK(fs::is_symlink(link));
  CHECK(std::distance(fs::directory_iterator(folder.path()), {}) == 3);
}

}  // namespace voussoir
