/// @file What test programs leave out when they are called without arguments.

#include <catch2/catch.hpp>
#include <filesystem>

#include "tests/support/file_text.h"

using namespace voussoir;

TEST_CASE(
    "Every long test is hidden, so that a program called without arguments leaves it out (all sources)") {
  const std::string not_hidden = std::string("[") + "long]";  // in two parts, or this file would be found
  int hidden = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(VOUSSOIR_SOURCE_DIR "/tests")) {
    if (entry.path().extension() != ".cpp") continue;
    const std::string text = test::text_of(entry.path());
    INFO(entry.path());
    CHECK(text.find(not_hidden) == std::string::npos);
    hidden += text.find("[.long]") != std::string::npos ? 1 : 0;
  }
  CHECK(hidden > 1);  // files that hold long tests, and this one
}
