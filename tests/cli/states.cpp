/// @file Histories and load cases through the real programs.

#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/statics/joint_forces.h"
#include "core/structure/loads.h"
#include "database/records/database.h"
#include "tests/support/bridges.h"
#include "tests/support/file_text.h"
#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"
#include "tools/validation/history.h"

namespace voussoir {
namespace {

/// The small bridge with a lorry that passes in two steps.
struct LoadedSite {
  test::TemporaryFolder folder;
  std::string bridge = (folder / "loaded.toml").string();
  std::string database = (folder / "loaded.h5").string();

  LoadedSite() {
    std::ofstream(bridge)
        << test::text_of(test::example_bridge("small"))
        << "[[loads]]\nname = \"lorry\"\naxles = [{at_m = 0, force_N = 1e4}]\nfrom_m = 2\nto_m = "
           "4\nsteps = 2\n";
  }
  test::ProgramResult build(std::vector<std::string> options) const {
    options.insert(options.begin(), {bridge, "-o", database, "--scenes", "singles;4,1+4,2", "--quiet"});
    return test::run("build-database", options);
  }
};

}  // namespace

TEST_CASE("Programs build, verify and show states, and Python finds their checksums right by itself",
          "[many-solutions]") {
  const LoadedSite site;
  const test::ProgramResult built =
      site.build({"--history", "built,lost", "--loads", "all", "--format", "json"});
  REQUIRE(built.exit_code == 0);
  const auto summary = nlohmann::json::parse(built.out);
  const std::vector<std::string> names = {"built",         "lost",         "built:lorry@1",
                                          "built:lorry@2", "lost:lorry@1", "lost:lorry@2"};
  REQUIRE(summary["states"].size() == names.size());
  for (std::size_t i = 0; i < names.size(); ++i) CHECK(summary["states"][i]["state"] == names[i]);
  CHECK(summary["standing"] == summary["states"][0]["standing"]);
  const auto verified = nlohmann::json::parse(
      test::run("verify-database", {site.database, "--recompute", "5", "--format", "json"}).out);
  CHECK(verified["ok"] == true);
  CHECK(verified["fields"] == 40 * names.size());
  const std::string example = std::string(VOUSSOIR_SOURCE_DIR) + "/examples/h5py/read_database.py";
  const test::ProgramResult python = test::run("/usr/bin/python3", {example, site.database});
  INFO(python.out << python.err);
  CHECK(python.exit_code == 0);
  CHECK_THAT(python.out,
             Catch::Contains("40 of 40 right; content digest right") && Catch::Contains("lost:lorry@2: "));
}

TEST_CASE("query-field shows the field of the state that is asked for (compared with the file)",
          "[many-solutions]") {
  const LoadedSite site;
  REQUIRE(site.build({"--history", "lost,built", "--loads", "lorry"}).exit_code == 0);
  const Database database = Database::open(site.database);
  const auto crown = [&](const std::vector<std::string>& options) {
    std::vector<std::string> all = {"4,2", "-d", site.database, "--at", "T6", "--format", "json"};
    all.insert(all.end(), options.begin(), options.end());
    return nlohmann::json::parse(test::run("query-field", all).out)[0]["uy_m"].get<double>();
  };
  const auto stored = [&](const char* state) {
    const SceneTable table = database.table(kNominalVariant, *database.find_state(state));
    return table.row(*database.find(parse_scene("4,2", database.layout())))[5];
  };
  CHECK(crown({}) == stored("built"));
  CHECK(crown({"--history", "lost"}) == stored("lost"));
  CHECK(crown({"--load", "lorry@2"}) == stored("built:lorry@2"));
  CHECK(crown({"--history", "lost", "--load", "lorry@1"}) == stored("lost:lorry@1"));
  const test::ProgramResult picture =
      test::run("query-field", {"4,2", "-d", site.database, "--history", "lost", "--format", "svg"});
  CHECK_THAT(picture.out, Catch::Contains("without 4,2 as lost, standing"));
  const test::ProgramResult unknown =
      test::run("query-field", {"4,2", "-d", site.database, "--load", "lorry"});
  CHECK(unknown.exit_code == 2);
  CHECK_THAT(unknown.err, Catch::Contains("for --history built --load 'lorry',") &&
                              Catch::Contains("--history built --load 'lorry@1'"));
}

TEST_CASE("query-field shows joints as the solver leaves them that remembers every step") {
  const LoadedSite site;
  REQUIRE(site.build({"--history", "lost", "--loads", "lorry"}).exit_code == 0);
  const BridgeDescription description = read_bridge_file(site.bridge).description;
  const Model bridge = make_model(description);
  const EquilibriumSystem system(bridge);
  const Coefficients coefficients(system, bridge.parameters);
  QuasiStaticSolver solver(bridge);
  const std::vector<LoadStage> stages =
      load_stages(description.loads.front(), bridge, description.material.thickness);
  int looked_at = 0;
  for (int block = 0; block < bridge.block_count(); block += 3) {
    const Scene scene{{BlockId{block}}};
    const validation::History history =
        validation::followed_by(validation::lost(scene), "lorry@1", stages.front().force);
    const std::vector<Solution> solved = validation::solve_history(solver, history);
    if (solved.size() < 3 || !stands(solved.back())) continue;
    ++looked_at;
    const StageEquations equations(system, coefficients, history.stages.back().stage, solved[1].memory);
    const std::vector<JointForces> expected =
        joint_forces(equations, bridge.parameters, without_nan(solved.back().displacement));
    const auto shown = nlohmann::json::parse(
        test::run("query-field", {to_string(scene, bridge.layout), "-d", site.database, "--load", "lorry@1",
                                  "--show", "joints", "--format", "json"})
            .out);
    REQUIRE(shown.size() == expected.size());
    double largest = 0.0;
    for (const JointForces& joint : expected) largest = std::max(largest, joint.normal);
    for (std::size_t i = 0; i < expected.size(); ++i) {  // the database rounds displacements
      CHECK(std::abs(shown[i]["normal_N"].get<double>() - expected[i].normal) < 1e-3 * largest);
      CHECK(std::abs(shown[i]["shear_N"].get<double>() - expected[i].shear) < 1e-3 * largest);
    }
  }
  CHECK(looked_at > 3);
}

TEST_CASE("query-field shows stresses, joints and thrust lines in every format, of scenes that stand") {
  const LoadedSite site;
  REQUIRE(site.build({"--history", "built,lost", "--collapses", "field"}).exit_code == 0);
  const auto show = [&](const char* what, const char* format, const char* scene = "4,2") {
    return test::run("query-field",
                     {scene, "-d", site.database, "--history", "lost", "--show", what, "--format", format});
  };
  CHECK_THAT(show("stresses", "csv").out, Catch::StartsWith("block,x_m,y_m,stress_xx_Pa"));
  CHECK_THAT(show("stresses", "svg").out, Catch::Contains("Tresca stress [MPa]"));
  CHECK_THAT(show("joints", "csv").out, Catch::StartsWith("first,second,x0_m"));
  CHECK_THAT(show("joints", "svg").out, Catch::Contains("joint-sticking") && Catch::Contains("thrust line"));
  CHECK_THAT(show("joints", "vtu").out, Catch::Contains("normal_N"));
  CHECK_THAT(show("thrust", "vtu").out, Catch::Contains("<VTKFile"));
  const std::string thrust_picture = show("thrust", "svg").out;
  CHECK_THAT(thrust_picture, Catch::Contains("middle third") && !Catch::Contains("joint-sticking\" d="));
  CHECK_THAT(show("displacements", "svg").out, Catch::Contains(", standing"));
  CHECK_THAT(show("displacements", "svg", "0,4").out,
             Catch::Contains("falling, moment 0.3 s, not in equilibrium") && !Catch::Contains("collapsed"));
  const auto thrust = nlohmann::json::parse(show("thrust", "json").out);
  CHECK(thrust.size() > 5);
  CHECK(thrust[0]["ring"] == 1);
  const test::ProgramResult fallen = show("joints", "csv", "0,4");
  CHECK(fallen.exit_code == 1);
  CHECK_THAT(fallen.err, Catch::Contains("expected one that stands"));
  const test::ProgramResult mixed =
      test::run("query-field", {"4,2", "-d", site.database, "--show", "joints", "--at", "T1"});
  CHECK(mixed.exit_code == 2);
}

TEST_CASE("Of scenes that fall a database may keep only that: nothing is shown or measured of them") {
  const LoadedSite site;
  REQUIRE(site.build({"--collapses", "outcome"}).exit_code == 0);
  for (const std::string option : {"--at=control", "--format=svg"}) {
    const test::ProgramResult field = test::run("query-field", {"-d", site.database, "0,4", option});
    CHECK(field.exit_code == 1);
    CHECK(field.out.empty());
    CHECK(field.err.find("scene 0,4 falls as built, and the database keeps only that") != std::string::npos);
  }
  const test::ProgramResult readings = test::run("make-measurements", {"-d", site.database, "0,4"});
  CHECK(readings.exit_code == 1);
  CHECK(readings.err.find("without displacements to read") != std::string::npos);
  CHECK(test::run("query-field", {"-d", site.database, "2,1"}).exit_code == 0);
}

TEST_CASE(
    "Fields of what falls are kept by default where the file wants them and motion follows the joints as "
    "they are") {
  const test::TemporaryFolder folder;
  const char* const soft = "normal_stiffness_Pa_per_m = 1e9\ntangential_stiffness_Pa_per_m = 1e8\n";
  const char* const stiff = "normal_stiffness_Pa_per_m = 1e11\ntangential_stiffness_Pa_per_m = 1e10\n";
  const char* const wants_fields = "collapses = \"field\"\n";
  const auto built = [&](const char* wish, const char* joints, const std::vector<std::string>& options) {
    std::ofstream(folder / "bridge.toml")
        << wish << std::ifstream(test::example_bridge("small")).rdbuf() << "\n[joints]\n"
        << joints;
    std::vector<std::string> arguments = {(folder / "bridge.toml").string(),
                                          "-o",
                                          (folder / "b.h5").string(),
                                          "--scenes",
                                          "intact;0,4",
                                          "--known-bridge",
                                          "--loads",
                                          "none"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return test::run("build-database", arguments);
  };
  const auto of_what_falls = [&] {
    return test::run("query-field", {"-d", (folder / "b.h5").string(), "0,4", "--at", "control"}).exit_code;
  };
  REQUIRE(built("", soft, {}).exit_code == 0);
  CHECK(of_what_falls() == 1);
  REQUIRE(built(wants_fields, soft, {}).exit_code == 0);
  CHECK(of_what_falls() == 0);
  const test::ProgramResult by_default = built(wants_fields, stiff, {});
  INFO(by_default.err);
  REQUIRE(by_default.exit_code == 0);
  CHECK_THAT(by_default.err, Catch::Contains("--collapses field keeps them"));
  CHECK(of_what_falls() == 1);
  REQUIRE(built("", stiff, {"--collapses", "field"}).exit_code == 0);
  CHECK(of_what_falls() == 0);
}

TEST_CASE("States and numbers that cannot be are bad usage") {
  const LoadedSite site;
  const auto refused = [&](const std::vector<std::string>& options, const char* why) {
    const test::ProgramResult result = site.build(options);
    INFO(result.err);
    CHECK(result.exit_code == 2);
    CHECK_THAT(result.err, Catch::Contains(why));
  };
  refused({"--history", "gone"}, "expected built, lost or built,lost");
  refused({"--loads", "bus"}, "expected all, none or names of its load cases (lorry)");
  refused({"--solver", "dynamic", "--history", "lost"}, "expected --history built and --loads none");
  refused({"--solver", "dynamic", "--loads", "all"}, "expected --history built and --loads none");
  for (const char* option : {"--step", "--ramp", "--damping", "--patience", "--rest"})
    for (const char* number : {"nan", "-1", "inf", "fast"}) refused({option, number}, number);
  CHECK_FALSE(std::filesystem::exists(site.database));
  for (const char* option : {"--recompute", "--seed", "--threads"})
    for (const char* number : {"nan", "-1", "inf"})
      CHECK(test::run("verify-database", {site.database, option, number}).exit_code == 2);
}

TEST_CASE(
    "build-database draws variants by their seed and solves their singles; verify-database finds them "
    "right",
    "[many-solutions]") {
  const test::TemporaryFolder folder;
  const std::string bridge = test::example_bridge("small").string();
  const auto build = [&](const std::string& name, std::vector<std::string> options) {
    options.insert(options.begin(), {bridge, "-o", (folder / name).string(), "--format", "json", "--quiet",
                                     "--variants", "2", "--history", "built,lost"});
    return nlohmann::json::parse(test::run("build-database", options).out);
  };
  const std::vector<std::string> few = {"--scenes", "intact;4,2..3;4,2+4,3"};
  auto other = few, threads = few;
  other.insert(other.end(), {"--variant-seed", "2"});
  threads.insert(threads.end(), {"--threads", "1"});
  const auto summary = build("few.h5", few);
  CHECK(summary["scenes"] == 3 * 4);
  CHECK(build("threads.h5", threads)["digest"] == summary["digest"]);
  CHECK(build("other.h5", other)["digest"] != summary["digest"]);
  const Database database = Database::open(folder / "few.h5");
  CHECK(database.variant_count() == 3);
  CHECK(Database::open(folder / "other.h5").variants()[1] != database.variants()[1]);
  const auto verified = nlohmann::json::parse(
      test::run("verify-database", {(folder / "few.h5").string(), "--recompute", "12", "--format", "json"})
          .out);
  CHECK(verified["ok"] == true);
  CHECK(verified["recomputed"] == 12);
}

TEST_CASE("A ring carries a load as far as limit analysis lets it, nearly (Heyman's mechanism: 71.6 kN)") {
  const test::TemporaryFolder folder;
  const auto outcome = [&](double force) {
    const std::string bridge = (folder / "ring.toml").string();
    std::ofstream(bridge)
        << "wall.courses = 0\nwall.length_m = 10\n[[spans]]\nshape = \"segmental\"\ncentre_x_m = 5\n"
           "springing_m = 1\nspan_m = 4.71223751492422\nrise_m = 1.2871535435692085\n"
           "ring_thickness_m = 0.4\nvoussoirs = 24\nskewback_m = 1\n"
           "[material]\nyoung_modulus_Pa = 2.5e12\n[joints]\nnormal_stiffness_Pa_per_m = 1e12\n"
           "tangential_stiffness_Pa_per_m = 1e12\nfriction_angle_deg = 75\n[supports]\nsides = \"free\"\n"
           "[[loads]]\nname = \"p\"\npoints = [{x_m = 3.8, force_N = "
        << force << "}]\n";
    return test::run("build-database", {bridge, "-o", (folder / "ring.h5").string(), "--scenes", "intact",
                                        "--loads", "all", "--known-bridge", "--quiet", "--force"})
        .out;
  };
  CHECK_THAT(outcome(60e3), Catch::Contains("built:p: 1 standing"));
  CHECK_THAT(outcome(75e3), Catch::Contains("built:p: 0 standing"));
}

}  // namespace voussoir
