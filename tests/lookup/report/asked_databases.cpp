/// @file Databases that are asked about the same readings. Oracle: Bayes' rule by hand.

#include "lookup/report/asked_databases.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

using namespace voussoir;

namespace {

AskedDatabase asked(const std::string& file, Verdict verdict, const std::string& first, double log_evidence) {
  return {.file = file,
          .bridge = "bridge",
          .digest = "0123456789abcdef",
          .verdict = verdict,
          .first = first,
          .log_evidence = log_evidence};
}

}  // namespace

TEST_CASE("Assumptions are as likely as they make the readings, however unlikely these are (by hand)") {
  for (const double shift : {0.0, -2000.0, 2000.0}) {
    std::vector<AskedDatabase> databases = {asked("a", Verdict::intact, "intact", shift + std::log(1.0)),
                                            asked("b", Verdict::intact, "intact", shift + std::log(6.0)),
                                            asked("c", Verdict::intact, "intact", shift + std::log(3.0))};
    weigh(databases);
    CHECK(databases[0].file == "b");
    CHECK(databases[1].file == "c");
    CHECK(databases[0].probability == Approx(0.6));
    CHECK(databases[1].probability == Approx(0.3));
    CHECK(databases[2].probability == Approx(0.1));
  }
}

TEST_CASE("A database in which no scene is possible is excluded, unless none has one") {
  constexpr double kNever = -std::numeric_limits<double>::infinity();
  std::vector<AskedDatabase> databases = {asked("a", Verdict::unexplained, "", kNever),
                                          asked("b", Verdict::intact, "intact", -5.0)};
  weigh(databases);
  CHECK(databases[0].file == "b");
  CHECK(databases[0].probability == 1.0);
  CHECK(databases[1].probability == 0.0);
  databases[0].log_evidence = kNever;
  weigh(databases);
  CHECK(databases[0].probability == 0.5);
  CHECK(databases[1].probability == 0.5);
}

TEST_CASE("An answer is contested by a database that counts and says anything else") {
  const auto contested = [](Verdict one, const std::string& its, Verdict other, const std::string& others,
                            double odds) {
    std::vector<AskedDatabase> databases = {asked("a", one, its, 0.0),
                                            asked("b", other, others, -std::log(odds))};
    weigh(databases);
    return is_contested(databases);
  };
  CHECK(contested(Verdict::intact, "intact", Verdict::located, "4,2", 18.9));        // 1 in 19.9
  CHECK_FALSE(contested(Verdict::intact, "intact", Verdict::located, "4,2", 19.1));  // less than 1 in 20
  CHECK(contested(Verdict::located, "4,2", Verdict::located, "4,3", 2.0));
  CHECK_FALSE(contested(Verdict::located, "4,2", Verdict::located, "4,2", 2.0));
  CHECK_FALSE(contested(Verdict::damaged_unlocated, "4,2", Verdict::damaged_unlocated, "4,3", 2.0));
  CHECK(contested(Verdict::intact, "intact", Verdict::cannot_tell, "intact", 2.0));
  CHECK(contested(Verdict::damaged_unlocated, "4,2", Verdict::unexplained, "4,2", 2.0));
  CHECK(in_words(asked("a.h5", Verdict::located, "4,2", 0.0)) ==
        "     0 %  a.h5 (digest 0123456789ab): located, first 4,2");
}
