#include "core/text.h"

#include <catch2/catch.hpp>

using namespace voussoir;
using Parts = std::vector<std::string_view>;

TEST_CASE("Texts are cut at every separator and lose the blanks at their ends") {
  CHECK(trimmed(" \t a b\r\n") == "a b");
  CHECK(trimmed(" \t ").empty());
  CHECK(split("10, 4", ',') == Parts{"10", "4"});
  CHECK(split("", ',') == Parts{""});
  CHECK(split("+a++", '+') == Parts{"", "a", "", ""});
}

TEST_CASE("Whole numbers are digits and nothing else") {
  CHECK(parse_whole_number("10") == 10);
  CHECK(parse_whole_number("0") == 0);
  for (const char* text : {"", "-1", "+1", "1.0", "1e3", " 1", "1 ", "four", "99999999999"})
    CHECK_FALSE(parse_whole_number(text));
}

TEST_CASE("Numbers fill the text and are finite") {
  CHECK(parse_number("-1.5e2") == -150.0);
  CHECK(parse_number("+.5") == 0.5);
  CHECK(parse_number("1.7976931348623157e308") == 1.7976931348623157e308);
  CHECK(parse_number("4.9e-324") == 4.9e-324);
  for (const char* text :
       {"", "+-1", "1 ", "1,5", "0x10", "nan", "-nan", "inf", "-Infinity", "1.8e308", "e5"})
    CHECK_FALSE(parse_number(text));
}

TEST_CASE("Names that are numbered on are named by the first and the last (written out)") {
  CHECK(names_in_words({"T9", "T10", "T11", "A1", "A2", "N1", "crack"}) == "T9 to T11, A1, A2, N1, crack");
  CHECK(names_in_words({"T1"}) == "T1");
  CHECK(names_in_words({"a", "b", "c", "d", "e", "f", "g", "h"}) == "a, b, c, d, e, f, g, h");
  CHECK(names_in_words({"a", "b", "c", "d", "e", "f", "g", "h", "i"}) == "a, b, c, d, e, f, g, h, ...");
}

TEST_CASE("Quoted texts show Latin letters and name other signs by their numbers (Unicode's tables)") {
  CHECK(in_quotes("H\u00F6he \u0159") == "'H\u00F6he \u0159'");
  CHECK(in_quotes("\u22120,5") == "'<U+2212>0,5'");
  CHECK(in_quotes("1\u00A0000 \U0001F309") == "'1<U+00A0>000 <U+1F309>'");
  CHECK(in_quotes("\xE9t\xE9") == "'<0xE9>t<0xE9>'");            // Latin-1
  CHECK(in_quotes("\x1b[2J\x7f\xC2\x9B") == "'?[2J?<U+009B>'");  // what a terminal would obey
  std::string letters;
  for (int i = 0; i < 41; ++i) letters += "\u00E9";
  CHECK(in_quotes(letters) == "'" + letters.substr(2) + "...'");  // no letter is cut in half
}
