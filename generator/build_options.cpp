#include "generator/build_options.h"

#include <fmt/ranges.h>

#include "core/error.h"
#include "core/program/command_line.h"
#include "core/random.h"
#include "core/solve/state_name.h"
#include "core/text.h"
#include "generator/build_switches.h"

namespace voussoir {
namespace {

constexpr int kMostVariants = 10000;

constexpr const char* kFooter =
    "Examples: build-database examples/bridges/small.toml -o small.h5 --scenes 'singles;4,2+5,1..3'\n"
    "          build-database -o irregular.h5 --variants 20 --scenes singles --history built,lost\n"
    "          build-database my-bridge.toml -o my-bridge.h5 --history built,lost --loads all\n"
    "          build-database my-bridge.toml --draw my-bridge.svg\n\n"
    "--scenes takes all (up to pairs), singles, pairs, triples (three missing blocks, with what they are\n"
    "made of: intact, singles and pairs), or items separated by ';': intact, a scene (10,4 or 10,4+6,4 or\n"
    "0,1+0,2+3,4), or a scene with ranges (10,1..20  0,*  10,4+2..4,*). A scene of three or more missing\n"
    "blocks in which limit analysis proves that a single or pair falls is not solved: it inherits that\n"
    "collapse and has no displacements. An interrupted build goes on when the same command is run again; a\n"
    "file that is up to date is left alone, and where only the points that are measured have changed its\n"
    "scenes with up to two missing blocks are kept.\n\n"
    "--without takes the names above, separated by ','. They save time only: the database stays the same "
    "but\n"
    "for round-off. Alone 'composed' and 'early-motions' have errors of their own, the first of which is\n"
    "bounded and the other below half a percent of a fall, and what is 'inherited' has no displacements.\n"
    "Friction may leave several answers: in bridges where much falls up to two scenes in a hundred that are\n"
    "said to fall, or left open, stand without a skip, or the reverse, the more so where joints are stiffer\n"
    "along than across (tangential over normal stiffness above 1).\n"
    "tools/benchmark accuracy shows what each gains.\n\n"
    "Exit codes: 0 done, 1 could not be done, 2 bad usage or bad bridge file. With --format json the last\n"
    "line of stdout is one JSON object, {\"ok\": true, ...} or {\"ok\": false, \"error\": ...}.";

std::vector<std::string> switch_names() {
  std::vector<std::string> names;
  for (const BuildSwitch& each : build_switches()) names.emplace_back(each.name);
  return names;
}

/// An option's check: a number that is more than `least`, or that if allowed. CLI11's own let NaN pass.
CLI::Validator number_above(double least, bool least_allowed) {
  const std::string name =
      fmt::format("NUMBER {} {:g}", least_allowed ? "of at least" : "greater than", least);
  return {[=](std::string& text) {
            const std::optional<double> number = parse_number(text);
            const bool right = number && (*number > least || (least_allowed && *number == least));
            return right ? std::string() : fmt::format("is {}: expected a {}", in_quotes(text), name);
          },
          name};
}

void add_motion_options(CLI::App& app, DynamicSettings& motion) {
  add_choice<Integrator>(
      app, "--integrator", motion.integrator,
      {{"implicit", Integrator::implicit_blocks}, {"explicit", Integrator::central_differences}},
      "of scenes in motion: implicit in the blocks (default), or explicit: central differences with tiny "
      "steps (slow)");
  app.add_option("--step", motion.step, "time step [s] of scenes in motion; default: 0.9 of the critical one")
      ->check(number_above(0.0, false))
      ->option_text("S");
  app.add_option("--ramp", motion.ramp, "gravity grows over this time [s], default 0.3; 0: at once")
      ->check(number_above(0.0, true))
      ->option_text("S");
  app.add_option("--damping", motion.damping,
                 "force per mass and velocity [1/s]; default: half-critical of the bridge's lowest frequency")
      ->check(number_above(0.0, true))
      ->option_text("RATE");
  app.add_option("--patience", motion.decision.latest_decision,
                 "a scene that neither rests nor falls within this time [s] is unresolved, default 1")
      ->check(number_above(0.0, false))
      ->option_text("S");
  app.add_option("--rest", motion.decision.standing_unbalance,
                 "a scene in motion stands when its unbalanced forces are this share of the bridge's weight, "
                 "default 0.00023")
      ->check(number_above(0.0, false))
      ->option_text("SHARE");
}

void add_uncertainty_options(CLI::App& app, BuildOptions& options) {
  app.add_option(
         "--variants", options.variants,
         "also solve so many bridges with parameters drawn from the bridge file's [uncertainty]: their "
         "singles, or the scenes that --scenes names; default 0")
      ->check(CLI::Range(0, kMostVariants))
      ->option_text("N");
  app.add_option("--variant-seed", options.variant_seed, "other seeds draw other bridges; default 1")
      ->check(CLI::Range(std::uint64_t{0}, kLargestSeed))
      ->option_text("N");
  app.add_flag("--known-bridge", options.request.known_bridge,
               "leave out how displacements change with what is uncertain of the bridge: for readings of "
               "bridges that are just as the file says");
}

void add_shard_option(CLI::App& app, BuildOptions& options) {
  app.add_option_function<std::string>(
         "--shard", [&options](const std::string& text) { options.request.shard = parse_shard(text); },
         "compute part I of N only, such as 3/16, for merge-databases; --fields none acts when parts are "
         "merged")
      ->check(CLI::Validator(
          [](std::string& text) {
            return parse_shard(text) ? std::string()
                                     : fmt::format("is {}: expected a part such as 3/16", in_quotes(text));
          },
          "PART/PARTS"))
      ->option_text("I/N");
}

void add_drawing_option(CLI::App& app, BuildOptions& options) {
  app.add_option(
         "--draw", options.drawing,
         "draw what the bridge file says into this file (SVG): blocks, joints, labels, supports, control "
         "points, loads. Nothing is computed")
      ->option_text("FILE.svg");
}

/// What is kept of scenes.
void add_kept_options(CLI::App& app, BuildOptions& options) {
  add_choice<KeepField>(app, "--fields", options.request.fields,
                        {{"all", KeepField::yes}, {"none", KeepField::no}},
                        "displacements of all nodes are kept of all scenes (default) or of none");
  add_choice<std::optional<bool>>(
      app, "--collapses", options.collapse_fields,
      {{"auto", std::nullopt}, {"field", true}, {"outcome", false}},
      "field: scenes that fall are followed in motion and have the field at a stated moment; outcome: only "
      "whether and what falls is found, without motion where it can be proved, in motions of fewer blocks "
      "where that will do (faster); auto (default): as the bridge file says (key collapses; outcome if it "
      "does not), and outcome where joints are so stiff that motion follows softer ones");
}

/// What is computed, and where to.
void add_database_options(CLI::App& app, BuildOptions& options) {
  app.add_flag("--version", options.version,
               "print versions, compiler, flags, settings and bridge as the database would state them");
  app.add_option("bridge", options.bridge, "bridge file (TOML); default: the reference bridge")
      ->option_text("BRIDGE.toml");
  app.add_option("-o,--output", options.request.output, "database to write, default bridge.h5")
      ->option_text("FILE");
  app.add_option("--scenes", options.scenes, "which scenes, default all, see below")->option_text("SCENES");
  app.add_option(
         "--history", options.request.histories,
         "built: the blocks were missing from the start; lost: they went when the bridge carried its weight; "
         "or built,lost; default built")
      ->option_text("LIST");
  app.add_option("--loads", options.request.loads,
                 "all, none (default), or names of the bridge's load cases, which act after each history")
      ->option_text("LIST");
}

}  // namespace

void add_options(CLI::App& app, BuildOptions& options) {
  app.footer(kFooter);
  add_database_options(app, options);
  add_drawing_option(app, options);
  add_uncertainty_options(app, options);
  add_threads_option(app, options.request.threads);
  add_choice<SolverKind>(
      app, "--solver", options.solver,
      {{"quasi-static", SolverKind::quasi_static}, {"dynamic", SolverKind::dynamic}},
      "quasi-static (default): Newton for scenes that stand, motion for the others; dynamic: motion for all");
  add_motion_options(app, options.motion);
  add_kept_options(app, options);
  add_format_option(app, options.json, "of the summary");
  app.add_option("--xdmf", options.request.xdmf_scenes,
                 "also write an index (.xdmf, .views.h5) with which ParaView opens these scenes")
      ->option_text("SCENES");
  app.add_option("--without", options.without,
                 "what is normally skipped or shared is done for every scene, see below")
      ->delimiter(',')
      ->check(CLI::IsMember(switch_names()))
      ->option_text("{" + fmt::format("{}", fmt::join(switch_names(), ",")) + "}");
  app.add_flag("--force", options.request.force, "build anew even if the file is up to date");
  app.add_flag("--drop", options.request.drop,
               "let scenes, states, fields and sensitivities of an existing file go that are still valid and "
               "not asked for");
  app.add_flag("--quiet", options.quiet, "no progress; of messages the summary and errors only");
  add_shard_option(app, options);
}

BuildOptions finished(BuildOptions options) {
  BuildRequest& request = options.request;
  if (options.scenes) request.scenes = *options.scenes;
  if (options.variants > 0 && !options.scenes) request.scenes_of_variants = "singles";
  for (const std::string& name : options.without)
    build_switch(name).switch_off(request.rules, options.motion.skips);
  if (options.solver == SolverKind::dynamic && (request.histories != kBuiltState || request.loads != "none"))
    throw InputError(
        "--solver dynamic solves the history built without loads only: expected --history built and --loads "
        "none");
  return options;
}

SolverChoice settle_collapses(const Model& bridge, BuildOptions& options) {
  const bool fields = options.collapse_fields
                          ? *options.collapse_fields
                          : keeps_collapse_fields(options.request.bridge.description, bridge, options.motion);
  options.request.rules.collapse_fields = fields;
  if (options.solver == SolverKind::dynamic) return dynamic(options.motion);
  return quasi_static_with(fields, options.motion);
}

}  // namespace voussoir
