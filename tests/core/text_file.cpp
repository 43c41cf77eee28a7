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
  const std::filesystem::path page = folder / "page.html";
  write_file(page, "old");
  write_file(page, "new");
  CHECK(read_text(page, 100, "a page") == "new");
  std::filesystem::create_directory(page.string() + ".new");  // what is written first has no place
  CHECK_THROWS_AS(write_file(page, "newer"), Failure);
  CHECK(read_text(page, 100, "a page") == "new");
}

}  // namespace voussoir
