#include "tools/benchmarks/questions.h"

#include <chrono>

#include "lookup/prepared_questions.h"
#include "lookup/readings/simulate.h"
#include "tools/trials/random_truth.h"

namespace voussoir {
namespace {

constexpr double kLevel = 0.05;  // of relative noise
constexpr double kSigma = 2e-5;  // [m] of changes
constexpr Nuisance kLevelled = {.scale = 0.0, .datum = 1e-3, .tilt = 1e-4};

/// What is measured, and what the lookup is told of it.
struct Question {
  std::string name;
  ReadingKind kind;
  NoiseModel told;
  Nuisance nuisance{};
  bool known_bridge = true;
  std::vector<int> missing = {};  // how many blocks may be; empty: as many as the database holds
};

const std::vector<Question>& questions() {
  using enum NoiseShape;
  using enum ReadingKind;
  static const std::vector<Question> all = {
      {"changes, sigma stated", change, {}},
      {"changes, sigma, datum and tilt", change, {}, kLevelled},
      {"absolute, bounded, stated", absolute, {uniform, kLevel}},
      {"absolute, nothing stated (default)", absolute, {}},
      {"absolute, nothing stated, floor", absolute, {.floor = 1e-6}},
      {"absolute, bounded, unknown level", absolute, {uniform}},
      {"absolute, gaussian, stated", absolute, {gaussian, kLevel}},
      {"absolute, gaussian, unknown level", absolute, {gaussian}},
      {"absolute, gaussian, unknown level, datum and tilt", absolute, {gaussian}, kLevelled},
      {"absolute, laplace, unknown level", absolute, {laplace}},
      {"absolute, student, stated", absolute, {student, kLevel}},
      {"absolute, student, unknown level", absolute, {student}},
      {"unknown bridge, changes, singles", change, {}, {}, false, {0, 1}},
      {"unknown bridge, changes, sigma stated", change, {}, {}, false},
      {"unknown bridge, changes, sigma, datum and tilt", change, {}, kLevelled, false},
      {"unknown bridge, absolute, gaussian, stated", absolute, {gaussian, kLevel}, {}, false},
      {"unknown bridge, absolute, nothing stated", absolute, {}, {}, false},
  };
  return all;
}

using Factors = std::shared_ptr<const ReadingFactors>;

/// Of all control points; null if the database has none.
Factors factors_of(const Database& database) {
  const Sensitivities* const sensitivities = database.sensitivities();
  if (sensitivities == nullptr) return nullptr;
  std::vector<Channel> channels(database.control_points().size());
  for (std::size_t i = 0; i < channels.size(); ++i) channels[i].point = i;
  return reading_factors(*sensitivities, 0, channels, database.layout().size());
}

/// What a bridge shows otherwise whose parameters are drawn at random, to first order.
void add_scatter(const ReadingFactors& factors, const Scene& scene, bool is_change, Random& random,
                 Measurements& measured) {
  Eigen::MatrixXd columns = factors.of(scene).bridge;
  if (is_change) columns -= factors.intact.bridge;
  Eigen::VectorXd drawn(columns.cols());
  for (double& one : drawn) one = random.gaussian();
  const Eigen::VectorXd shown = columns * drawn;
  for (std::size_t i = 0; i < measured.displacement.size(); ++i)
    measured.displacement[i] += shown[static_cast<Eigen::Index>(i)];
}

Comparison readings_of(const Library& library, const ModelError& error, const Factors& factors,
                       std::size_t row, const Question& question, Random& random) {
  const bool is_change = question.kind == ReadingKind::change;
  NoiseModel noise = question.told;
  if (noise.shape == NoiseShape::automatic) noise.shape = NoiseShape::gaussian;
  noise.relative = is_change ? 0.0 : kLevel;
  noise.floor = is_change ? kSigma : 0.0;
  noise.silence = 0.0;
  Measurements measured = simulate_readings(library.table.row(row), noise, random);
  if (is_change) measured.sigma.assign(measured.displacement.size(), kSigma);
  if (!question.known_bridge) add_scatter(*factors, library.table.scene(row), is_change, random, measured);
  Comparison comparison{
      .kind = question.kind, .library = library, .measured = std::move(measured), .model_error = error};
  if (!question.known_bridge) comparison.factors = factors;
  return comparison;
}

QuestionTiming time_question(const Library& library, const ModelError& error, const Factors& factors,
                             const Question& question, int queries, std::uint64_t seed) {
  Random random(seed);
  PreparedQuestions preparations;
  std::vector<double> milliseconds, of_processors;
  std::vector<int> numbers = question.missing.empty() ? numbers_of_missing(library.table) : question.missing;
  std::erase_if(numbers, [&](int number) { return eligible_rows(library.table, {number}).rows.empty(); });
  for (std::size_t i = 0; i < static_cast<std::size_t>(queries); ++i) {
    const Eligible rows = eligible_rows(library.table, {numbers[i % numbers.size()]});
    const std::size_t truth = random_truth(rows, random);
    const Comparison comparison = readings_of(library, error, factors, truth, question, random);
    const LookupSettings settings{.prior = {numbers}, .noise = question.told, .nuisance = question.nuisance};
    const double used = processor_seconds();
    const auto start = std::chrono::steady_clock::now();
    preparations.ask(comparison, settings);
    milliseconds.push_back(
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
    of_processors.push_back(1e3 * (processor_seconds() - used));
  }
  return {timing_of(question.name, std::move(milliseconds)),
          timing_of(question.name, std::move(of_processors))};
}

}  // namespace

std::vector<QuestionTiming> time_questions(const Database& database, const Library& library, int queries,
                                           std::uint64_t seed, const std::string& only) {
  const Factors factors = factors_of(database);
  std::vector<QuestionTiming> timings;
  for (const Question& question : questions())
    if (question.name.find(only) != std::string::npos && (question.known_bridge || factors != nullptr))
      timings.push_back(
          time_question(library, database.model_errors().front(), factors, question, queries, seed));
  return timings;
}

}  // namespace voussoir
