/// @file locate-damage --evidence variants on sampled bridges that the real solver solved. Oracle: the first
/// order, which is exact for a scatter that is small.

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>

#include "tests/support/answer.h"
#include "tests/support/bridges.h"
#include "tests/support/file_text.h"

using Catch::Matchers::Contains;
using nlohmann::json;
namespace test = voussoir::test;

namespace {

constexpr int kVariants = 60;

/// The small bridge, of which only the joints are uncertain, and little.
class Workshop {
 public:
  Workshop() {
    std::ofstream(folder_ / "scattered.toml")
        << test::text_of(test::example_bridge("small"))
        << "[uncertainty]\njoint_stiffness_cv = 0.05\nregional_stiffness_cv = 0.0\ncommon_stiffness_cv = "
           "0.0\nstiffness_ratio_cv = 0.0\n"
           "friction_cv = 0.0\nyoung_modulus_cv = 0.0\ndensity_cv = 0.0\ntemperature_K = 0.0\n"
           "foot_movement_m = 0.0\nfoot_rotation_rad = 0.0\nside_movement_m = 0.0\n"
           "epoch_stiffness_cv = 0.0\nepoch_unevenness_cv = 0.0\nuneven_temperature_K = 0.0\n";
    build("first.h5", {});
    build("alone.h5", {"--variants", std::to_string(kVariants), "--variant-seed", "7", "--known-bridge"});
    build("both.h5", {"--variants", "10", "--variant-seed", "7"});
    std::ofstream(folder_ / "readings.csv") << readings();
  }

  test::ProgramResult locate(const std::string& database, std::vector<std::string> more) const {
    more.insert(more.begin(), {(folder_ / "readings.csv").string(), "-d", (folder_ / database).string(),
                               "--missing", "1", "--top", "40"});
    return test::run("locate-damage", more);
  }
  json answer(const std::string& database, std::vector<std::string> more) const {
    more.insert(more.end(), {"--conditions", "known", "--format", "json"});
    return test::json_of(locate(database, more));
  }

 private:
  void build(const std::string& name, std::vector<std::string> more) const {
    more.insert(more.begin(), {(folder_ / "scattered.toml").string(), "-o", (folder_ / name).string(),
                               "--scenes", "singles", "--fields", "none", "--quiet"});
    const test::ProgramResult built = test::run("build-database", more);
    if (built.exit_code != 0) throw std::runtime_error(built.err);
  }
  /// A change that lies between those of 5,4 and 5,5, which the scatter of the joints alone keeps possible.
  static std::string readings() { return "point,change_mm,sigma_mm\nT1,0.005,0.0003\nT3,0.01,0.0003\n"; }

  test::TemporaryFolder folder_;
};

const Workshop& workshop() {
  static const Workshop shared;
  return shared;
}

/// By how much 5,5 is likelier than 5,4: the logarithm of their odds.
double log_odds(const json& answer) {
  const auto log = [&](const std::string& scene) {
    for (const json& candidate : answer.at("candidates"))
      if (candidate.at("scene") == scene) return std::log(candidate.at("posterior").get<double>());
    throw std::runtime_error("no candidate " + scene);
  };
  return log("5,5") - log("5,4");
}

}  // namespace

TEST_CASE("Many sampled bridges that scatter little answer as the first order does", "[whole-build]") {
  const json order = workshop().answer("first.h5", {}),
             variants = workshop().answer("alone.h5", {"--evidence", "variants"});
  CHECK(order.at("bridge").at("evidence") == json({{"from", "first-order"}}));
  CHECK(variants.at("bridge").at("evidence") ==
        json({{"from", "variants"}, {"bridges", kVariants}, {"beside_first_order", false}}));
  // A variance of 60 samples has a standard error of 18 %, and with it the odds' logarithm, nearly.
  const double expected = log_odds(order);
  CHECK(log_odds(variants) == Approx(expected).epsilon(0.36));
  CHECK(log_odds(workshop().answer("first.h5", {"--known-bridge"})) > 2.0 * expected);
}

TEST_CASE("The answer says which evidence spoke, from how many bridges, and what they cannot know",
          "[whole-build]") {
  const test::ProgramResult both = workshop().locate("both.h5", {"--evidence", "variants"});
  CHECK(both.exit_code == 0);
  CHECK_THAT(both.out, Contains("Evidence:     derivatives") && Contains("leave of 10 sampled bridges"));
  const json answer = workshop().answer("both.h5", {"--evidence", "variants"});
  CHECK(answer.at("bridge").at("evidence").at("beside_first_order") == true);
  CHECK(answer.at("bridge").at("parameters").size() ==
        workshop().answer("both.h5", {}).at("bridge").at("parameters").size());
  const test::ProgramResult alone =
      workshop().locate("alone.h5", {"--evidence", "variants", "--conditions", "known"});
  CHECK_THAT(alone.out, Contains("60 sampled bridges") && Contains("alone") && Contains("exactly known"));
}

TEST_CASE("Evidence from variants that is not there is refused with what to do", "[whole-build]") {
  const auto error = [](const std::string& database, const std::vector<std::string>& more) {
    const test::ProgramResult result = workshop().locate(database, more);
    CHECK(result.exit_code != 0);
    CHECK(result.out.empty());
    CHECK(test::is_one_line(result.err));
    return result.err;
  };
  CHECK_THAT(error("first.h5", {"--evidence", "variants"}),
             Contains("first.h5") && Contains("no sampled bridge") && Contains("build-database --variants"));
  CHECK_THAT(error("alone.h5", {"--evidence", "variants"}), Contains("--conditions known"));
  CHECK_THAT(error("both.h5", {"--evidence", "variants", "--known-bridge"}), Contains("--known-bridge"));
  CHECK_THAT(error("both.h5", {"--evidence", "variants", "--objective", "paper"}),
             Contains("--objective paper"));
}
