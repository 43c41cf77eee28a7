#include "generator/build_options.h"

#include <CLI/CLI.hpp>

#include "database/provenance.h"

namespace voussoir {
namespace {

constexpr int kMostThreads = 4096;
constexpr int kBadUsage = 2;

constexpr const char* kFooter =
    "Example: build-database examples/bridges/small.toml -o small.h5 --scenes 'singles;4,2+5,1..3'\n\n"
    "--scenes takes all, singles, pairs, or items separated by ';': intact, a scene (10,4 or 10,4+6,4), or a "
    "scene with\n"
    "ranges (10,1..20  0,*  10,4+2..4,*). An interrupted build goes on when the same command is run again; a "
    "file that is\n"
    "up to date is left alone. Exit codes: 0 done, 1 could not be done, 2 bad usage or bad bridge file.";

}  // namespace

BuildOptions parse_build_options(int argc, char** argv) {
  BuildOptions options;
  CLI::App app("Computes the database of a bridge: the displacements of every scene with missing blocks.",
               "build-database");
  app.footer(kFooter);
  app.set_version_flag("--version", version_text("build-database"));
  std::string solver = "quasi-static";
  std::string integrator = "implicit";
  std::string fields = "all";
  std::string format = "text";
  bool no_mirror = false;
  app.add_option("bridge", options.bridge, "bridge file (TOML); default: the reference bridge");
  app.add_option("-o,--output", options.request.output, "database to write")->capture_default_str();
  app.add_option("--scenes", options.request.scenes, "which scenes, see below")->capture_default_str();
  app.add_option("--threads", options.request.threads, "threads, 0: one for each core")
      ->check(CLI::Range(0, kMostThreads))
      ->capture_default_str();
  app.add_option("--solver", solver,
                 "quasi-static: Newton for scenes that stand, motion for the others; dynamic: motion for all")
      ->check(CLI::IsMember({"quasi-static", "dynamic"}))
      ->capture_default_str();
  app.add_option(
         "--integrator", integrator,
         "with --solver dynamic: implicit in the blocks, or central differences with tiny steps (slow)")
      ->check(CLI::IsMember({"implicit", "explicit"}))
      ->capture_default_str();
  app.add_option("--fields", fields, "displacements of all nodes are kept of all scenes or of none")
      ->check(CLI::IsMember({"all", "none"}))
      ->capture_default_str();
  app.add_option("--format", format, "of the summary")
      ->check(CLI::IsMember({"text", "json"}))
      ->capture_default_str();
  app.add_option("--xdmf", options.request.xdmf_scenes,
                 "also write an index (.xdmf, .views.h5) with which ParaView opens these scenes");
  app.add_flag("--no-mirror", no_mirror, "solve every scene, even if its mirror image is solved");
  app.add_flag("--force", options.request.force, "build anew even if the file is up to date");
  app.add_flag("--quiet", options.quiet, "no progress and no messages");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    options.exit_code = app.exit(error) == 0 ? 0 : kBadUsage;
  }
  options.json = format == "json";
  options.request.fields = fields == "all" ? KeepField::yes : KeepField::no;
  DynamicSettings motion;
  if (integrator == "explicit") motion.integrator = Integrator::central_differences;
  options.solver = solver == "dynamic" ? dynamic(motion) : quasi_static();
  options.request.mirror = no_mirror ? UseMirror::no : UseMirror::yes;
  return options;
}

}  // namespace voussoir
