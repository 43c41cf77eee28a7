/// @file benchmark-localisation: how often the truth is found, by the paper's objective and by the posterior.

#include "core/error.h"
#include "lookup/command_line.h"
#include "tools/benchmarks/localisation_options.h"
#include "tools/trials/localisation.h"

using namespace voussoir;

namespace {

struct Options {
  std::optional<std::string> database;
  int trials = 200;
  int scenes = 2000;
  std::uint64_t seed = 1;
  bool irregular = false;
  IrregularOptions bridges;
};

double share(double count, const Success& success) {
  return count / success.trials;
}

std::string generations(const CaseResult& result) {
  if (result.generations.empty()) return "-";
  const auto at = [&](double part) {
    return result
        .generations[static_cast<std::size_t>(part * static_cast<double>(result.generations.size() - 1))];
  };
  return fmt::format("{} ({}..{})", at(0.5), at(0.1), at(0.9));
}

void print_table(const Library& library, const std::string& title, const std::vector<PaperCase>& cases,
                 const Options& options) {
  fmt::print(
      "{}: {} noisy trials a case, uniform relative noise, among the scenes with as many missing blocks\n",
      title, options.trials);
  fmt::print("{:<12} {:>5} | {:>9} | {:>6} {:>6} | {:>6} {:>6} {:>6} | {:>6} {:>6} {:>6} | {:>7} {:>7}  {}\n",
             "scene", "noise", "paper", "Eq. 1", "top 5", "right", "top 5", "95 %", "deflt", "top 5", "95 %",
             "GA true", "GA min", "generations");
  for (const auto& paper_case : cases) {
    const CaseResult r = run_case(library, paper_case, options.trials, options.seed);
    fmt::print(
        "{:<12} {:>4.0f}% | {:>9} | {:>6.3f} {:>6.3f} | {:>6.3f} {:>6.3f} {:>6.3f} | {:>6.3f} {:>6.3f} "
        "{:>6.3f} | "
        "{:>7.3f} {:>7.3f}  {}\n",
        paper_case.scene, 100.0 * paper_case.noise, paper_case.paper,
        share(r.paper_objective.first, r.paper_objective),
        share(r.paper_objective.in_five, r.paper_objective), share(r.right_model.first, r.right_model),
        share(r.right_model.in_five, r.right_model), share(r.right_model.in_credible, r.right_model),
        share(r.default_model.first, r.default_model), share(r.default_model.in_five, r.default_model),
        share(r.default_model.in_credible, r.default_model), share(r.genetic_found, r.paper_objective),
        share(r.genetic_minimum, r.paper_objective), generations(r));
  }
  fmt::print("\n");
}

void print_calibration(const Library& library, const std::string& title, NoiseShape drawn, NoiseShape assumed,
                       bool stated, const Options& options) {
  const Calibration c = calibrate(library, drawn, assumed, stated, options.scenes, options.seed);
  fmt::print("Calibration, {}: {} random scenes, noise 1..20 %\n", title, options.scenes);
  fmt::print(
      "  truth first {:.3f}, in the first five {:.3f}, in the 95 % set {:.3f} (of exactly 95 %: {:.3f}; mean "
      "size {:.0f})\n",
      share(c.success.first, c.success), share(c.success.in_five, c.success),
      share(c.success.in_credible, c.success), share(c.success.in_exact, c.success), c.mean_set_size);
  fmt::print("  {:>9} {:>8} {:>10} {:>10} {:>16}\n", "stated p", "scenes", "mean p", "frequency",
             "standard errors");
  for (std::size_t i = 0; i < c.bins.size(); ++i) {
    const auto& bin = c.bins[i];
    const double off =
        bin.standard_error > 0.0 ? (bin.frequency - bin.mean_probability) / bin.standard_error : 0.0;
    fmt::print("  {:.1f}..{:.1f}  {:>8} {:>10.4f} {:>10.4f} {:>+16.2f}\n", 0.1 * static_cast<double>(i),
               0.1 * static_cast<double>(i + 1), bin.scenes, bin.mean_probability, bin.frequency, off);
  }
  fmt::print("\n");
}

std::string benchmark_paper(const Options& options) {
  const auto database = Database::open(find_database(options.database));
  const PaperCases cases = read_paper_cases(paper_cases_file());
  const Library library = library_of(database);
  fmt::print(
      "Columns: Eq. 1 = the paper's objective; right = posterior with the true noise model; deflt = "
      "posterior "
      "knowing nothing of the noise;\n95 % = truth in the credible set; GA true, GA min = genetic search "
      "ends at "
      "the truth, at the minimum of Eq. 1; generations = median (10..90 %)\n\n");
  print_table(library, "Table 2", cases.one_block, options);
  print_table(library, "Table 3", cases.two_blocks, options);
  print_calibration(library, "uniform noise, model right", NoiseShape::uniform, NoiseShape::uniform, true,
                    options);
  print_calibration(library, "Gaussian noise, model right", NoiseShape::gaussian, NoiseShape::gaussian, true,
                    options);
  print_calibration(library, "uniform noise, default settings", NoiseShape::uniform, NoiseShape::automatic,
                    false, options);
  for (const bool known : {true, false})
    fmt::print("Intact called damaged, noise {}: {} of {} trials\n", known ? "known" : "unknown",
               false_alarms(library, known, options.scenes, options.seed), options.scenes);
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Measures how often noisy readings lead to the truth.", "benchmark-localisation");
  app.footer(
      "Example: benchmark-localisation -d bridge.h5\n"
      "         benchmark-localisation -d bridge.h5 --irregular --page irregular.html");
  Options options;
  add_database_option(app, options.database);
  app.add_option("--trials", options.trials, "noisy trials of each of the paper's cases, default 200")
      ->check(CLI::Range(1, 1000000));
  app.add_option("--scenes", options.scenes, "random scenes of the calibration, default 2000")
      ->check(CLI::Range(1, 1000000));
  add_seed_option(app, options.seed, "default 1");
  app.add_flag(
      "--irregular", options.irregular,
      "instead: bridges that the database does not hold, with the bridge taken as known and as unknown");
  add_irregular_options(app, options.bridges);
  return run_program(app, argc, argv, [&] {
    return options.irregular ? benchmark_irregular(find_database(options.database), options.bridges)
                             : benchmark_paper(options);
  });
}
