/// @file benchmark-readings: what can be told from readings that the database did not make.

#include "core/error.h"
#include "lookup/command_line.h"
#include "tools/benchmarks/readings.h"
#include "tools/trials/paper_cases.h"

using namespace voussoir;

namespace {

struct Options {
  std::optional<std::string> database;
  std::vector<std::string> truths;
  std::string state = kBuiltState;
  int trials = 100;
  std::optional<double> model_error;
  Prior prior;
};

double share(double count, const Rates& rates) {
  return count / std::max(1, rates.success.trials);
}

/// Share of the predictive checks that reject at this level.
double rejected(const Rates& rates, double level) {
  const auto count = std::ranges::count_if(rates.chances, [&](double p) { return p < level; });
  return share(static_cast<double>(count), rates);
}

void print_rates(const std::string& what, const Rates& rates) {
  fmt::print(
      "  {:<34} {:>6} trials: first {:.3f}, in the 95 % set {:.3f} (of exactly 95 %: {:.3f}), called damaged "
      "{:.3f}, check below 5 % {:.3f}, below 0.1 % {:.4f}\n",
      what, rates.success.trials, share(rates.success.first, rates), share(rates.success.in_credible, rates),
      share(rates.success.in_exact, rates), share(rates.damaged, rates), rejected(rates, 0.05),
      rejected(rates, 0.001));
}

void absolute_noise(const TwoBridges& bridges, const Options& options) {
  const auto cases = read_paper_cases(paper_cases_file());
  for (const bool told : {true, false})
    for (const auto& each : cases.one_block) {
      Instrument instrument{ReadingKind::absolute, {NoiseShape::uniform, each.noise}, told};
      instrument.noise.silence = 0.0;
      const Scene scene = parse_scene(each.scene, bridges.library.layout);
      print_rates(fmt::format("{} {:.0f} % uniform, level {}", each.scene, 100.0 * each.noise,
                              told ? "stated" : "unknown"),
                  find_again(bridges, {scene}, {{1}, {}}, instrument, options.trials, 1));
    }
}

void changes(const TwoBridges& bridges, const Options& options) {
  const std::vector<Scene> singles = standing_singles(bridges);
  const int times = std::max(1, 1000 / static_cast<int>(std::max<std::size_t>(1, singles.size())) + 1);
  for (const double sigma : {1e-5, 3e-5, 1e-4, 2e-4}) {
    const Instrument gauge{ReadingKind::change, {NoiseShape::gaussian, std::nullopt, sigma}};
    const std::string name = fmt::format("change, {:g} mm,", 1e3 * sigma);
    print_rates(name + " among singles", find_again(bridges, singles, {{1}, {}}, gauge, times, 1));
    print_rates(name + " among all", find_again(bridges, singles, options.prior, gauge, times, 2));
    print_rates(name + " intact, among all",
                find_again(bridges, {Scene{}}, options.prior, gauge, 10 * options.trials, 3));
  }
}

std::string benchmark(const Options& options) {
  const auto database = Database::open(find_database(options.database));
  const auto state = [&](const Database& of) {
    const auto found = of.find_state(options.state);
    if (!found) throw Failure(fmt::format("{}: has no state {}", of.path().string(), options.state));
    return *found;
  };
  const Library library = library_of(database, state(database));
  ModelError error = database.model_errors()[state(database)];
  if (options.model_error) error = {*options.model_error, 0.0, {}};
  std::vector<std::string> truths = options.truths;
  truths.insert(truths.begin(), database.path().string());
  for (const std::string& path : truths) {
    const auto other = Database::open(path);
    const Library truth = library_of(other, state(other));
    fmt::print("Readings from {}, state {}{}\n", path, options.state,
               path == truths.front() ? ": the database's own rows (known bridge)" : "");
    const TwoBridges bridges{library, error, truth};
    absolute_noise(bridges, options);
    changes(bridges, options);
  }
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Measures how often readings of other databases lead to the truth.", "benchmark-readings");
  app.footer("Example: benchmark-readings -d bridge.h5 --truth finer.h5 --truth stiffer.h5");
  Options options;
  add_database_option(app, options.database);
  app.add_option("--truth", options.truths, "a database of the same bridge, made otherwise");
  app.add_option("--state", options.state, "of both, default built");
  app.add_option("--trials", options.trials, "of each of the paper's cases, default 100")
      ->check(CLI::Range(1, 1000000));
  app.add_option("--model-error", options.model_error,
                 "in the place of the database's: a share of the signal");
  app.add_option("--prior", options.prior.weight, "weights of 0, 1 and 2 missing blocks")->delimiter(',');
  return run_program(app, argc, argv, [&] { return benchmark(options); });
}
