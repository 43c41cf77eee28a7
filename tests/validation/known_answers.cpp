#include <catch2/catch.hpp>
#include <functional>
#include <set>

#include "core/error.h"
#include "tools/validation/bisection.h"
#include "tools/validation/report.h"

using namespace voussoir;
using namespace voussoir::validation;

namespace {

void check(const StudyResult& result) {
  INFO(result.title);
  CHECK(result.failure.empty());
  CHECK(!(result.findings.cases.empty() && result.findings.hard_cases.empty()));
  for (const Case& known : result.findings.cases) {
    INFO(known.name << ", " << known.quantity << ": expected " << known.expected << ", computed "
                    << known.computed << ", error " << known.error);
    CHECK(known.within());
  }
  for (const HardCase& hard : result.findings.hard_cases) {
    INFO(hard.sweep << ", " << hard.setting << ", " << hard.scene << ": " << hard.verdict);
    CHECK(hard.correct);
  }
}

bool solves_many_scenes(const Study& study) {
  static const std::set<std::string> names = {"arch-statics", "bridge-steps", "bridge-joints"};
  return names.contains(study.name);
}

void run_and_check(const std::vector<Study>& studies) {
  REQUIRE(!studies.empty());
  for (const StudyResult& result : run_studies(studies, 2, [](const StudyResult&) {})) check(result);
}

}  // namespace

TEST_CASE("The quick studies' known answers are within tolerance and their hard cases correct",
          "[validation]") {
  std::vector<Study> few = chosen_studies({}, true);
  std::erase_if(few, solves_many_scenes);
  run_and_check(few);
}

TEST_CASE("Quick studies of many scenes, too, have answers within tolerance and correct hard cases",
          "[validation][many-solutions]") {
  std::vector<Study> many = chosen_studies({}, true);
  std::erase_if(many, std::not_fn(solves_many_scenes));
  run_and_check(many);
}

TEST_CASE("All studies' known answers are within tolerance and their hard cases correct",
          "[validation][.long]") {
  run_and_check(chosen_studies({}, false));
}

TEST_CASE("An answer outside its tolerance, or NaN, is marked and counted (made-up results)",
          "[validation]") {
  const Case right = relative_case(
      {.name = "a", .quantity = "q", .expected = 2.0, .source = "s", .computed = 2.01}, 0.01, "why");
  const Case wrong = relative_case(
      {.name = "a", .quantity = "q", .expected = 2.0, .source = "s", .computed = 2.1}, 0.01, "why");
  const Case not_a_number = absolute_case(
      {.name = "a", .quantity = "q", .expected = 2.0, .source = "s", .computed = std::nan("")}, 1.0, "");
  const Case compared =
      comparison({.name = "a", .quantity = "q", .expected = 2.0, .source = "s", .computed = 4.0}, "");
  CHECK(right.error == Approx(0.005));
  CHECK(right.within());
  CHECK_FALSE(wrong.within());
  CHECK_FALSE(not_a_number.within());
  CHECK(compared.within());
  StudyResult result;
  result.findings.cases = {right, wrong, not_a_number, compared};
  result.findings.hard_cases = {HardCase{.correct = false}};
  const Tally sum = tally({result});
  CHECK(sum.cases == 3);
  CHECK(sum.within == 1);
  CHECK(sum.comparisons == 1);
  CHECK(sum.correct == 0);
  CHECK_FALSE(sum.all_good());
  CHECK(to_text({result}).find("OUTSIDE") != std::string::npos);
}

TEST_CASE("The page holds every case and plot and fetches nothing (made-up results)", "[validation]") {
  StudyResult result;
  result.findings.cases = {
      absolute_case({.name = "a & b", .quantity = "q", .expected = 1.0, .computed = 1.0}, 1.0, "why")};
  result.findings.hard_cases = {HardCase{.sweep = "sweep of sweeps", .verdict = "standing"}};
  result.findings.notes = {"a limit"};
  result.findings.plots = {{.title = "a plot",
                            .x_label = "x",
                            .y_label = "y",
                            .series = {{.label = "line", .points = {{1.0, 2.0}, {2.0, 3.0}}}}}};
  const std::string page = to_page({result});
  for (const char* text : {"a &amp; b", "sweep of sweeps", "a limit", "a plot", "<svg"})
    CHECK(page.find(text) != std::string::npos);
  for (const char* text : {"src=", "=\"http", "@import"}) CHECK(page.find(text) == std::string::npos);
  CHECK(to_markdown({result}).find("| a & b | q |") != std::string::npos);
}

TEST_CASE("Extrapolation to zero is exact for the polynomials that it is made for (closed form)",
          "[validation]") {
  const std::vector<double> x = {2.0, 1.0, 0.5, 0.25};
  std::vector<double> y;
  for (const double at : x) y.push_back(3.0 - 2.0 * at + 0.5 * at * at);
  CHECK(extrapolated(x, y, 3) == Approx(3.0).epsilon(1e-12));
  CHECK(extrapolated(x, y, 4) == Approx(3.0).epsilon(1e-12));
  CHECK(extrapolated(x, y, 2) != Approx(3.0).epsilon(1e-3));
}

TEST_CASE("A study that throws is reported and does not stop the others", "[validation]") {
  const Study broken{.name = "broken", .title = "t", .run = []() -> Findings { throw Failure("no luck"); }};
  const Study sound{.name = "sound", .title = "t", .run = [] { return Findings{}; }};
  const std::vector<StudyResult> results = run_studies({broken, sound}, 1, [](const StudyResult&) {});
  CHECK(results[0].failure == "no luck");
  CHECK(results[1].failure.empty());
  CHECK(tally(results).failures == 1);
}

TEST_CASE("A filter that fits no study is refused with the studies' names", "[validation]") {
  CHECK_THROWS_WITH(chosen_studies({"nonsense"}, false),
                    Catch::Contains("nonsense") && Catch::Contains("patch"));
}
