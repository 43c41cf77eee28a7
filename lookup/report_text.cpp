#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "lookup/report.h"
#include "lookup/words.h"

namespace voussoir {
namespace {

constexpr double kMillimetres = 1e3;
constexpr std::size_t kMostBlocksListed = 5;
constexpr std::size_t kMostSensorsListed = 5;
constexpr double kBlockWorthListing = 0.01;
constexpr std::size_t kDigestShown = 12;

/// Collects lines.
class Text {
 public:
  template <typename... Arguments>
  void line(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Arguments>(arguments)...);
    text_ += '\n';
  }
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

std::string noise_in_words(const NoiseEstimate& noise) {
  if (noise.estimated && noise.level <= 2.0 * kSmallestLevel) return "none that could be seen";
  const std::string_view meaning = noise.shape == NoiseShape::uniform ? "at most" : "a standard deviation of";
  return fmt::format("{} {:.2g} % of the displacement ({} noise, {})", meaning, 100.0 * noise.level,
                     to_string(noise.shape), noise.estimated ? "estimated" : "as stated");
}

void write_heading(Text& text, const Answer& answer, const Library& library, const Source& source) {
  text.line("Measurements: {}, {} of {} control points have a reading", source.measurements, answer.readings,
            library.points.size());
  text.line("Database:     {} (bridge '{}', digest {})", source.database, source.bridge,
            source.digest.substr(0, kDigestShown));
  text.line("Searched:     {} scenes{}", answer.searched,
            answer.unresolved == 0
                ? ""
                : fmt::format("; {} more have no solution and were left out", answer.unresolved));
}

void write_verdict(Text& text, const Answer& answer, const Library& library) {
  const Candidate& best = answer.candidates.front();
  if (answer.fit && !answer.fit->explained)
    text.line("No scene in this database explains these measurements: {}.", answer.fit->reason);
  const std::string_view opening = answer.fit && !answer.fit->explained ? "Closest" : "Most likely";
  text.line("{}: {} ({})", answer.posterior ? opening : "Best match", to_string(best.scene, library.layout),
            place_in_words(best.scene, library.layout));
  if (best.posterior) text.line("Probability:  {}", percent(*best.posterior));
  if (best.outcome == Outcome::collapsed)
    text.line("This scene collapses: its displacements are a snapshot, not an equilibrium.");
}

std::string behind(const Candidate& candidate, const Candidate& best) {
  if (!best.posterior) return fmt::format("{:+.4f}", candidate.misfit - best.misfit);
  if (*candidate.posterior == 0.0) return "negligible";
  const double odds = *best.posterior / *candidate.posterior;
  return odds < 1e6 ? fmt::format("1 : {:.4g}", odds) : "1 : > 10^6";
}

void write_table(Text& text, const Answer& answer, const Library& library) {
  std::size_t width = 5;
  for (const Candidate& candidate : answer.candidates)
    width = std::max(width, to_string(candidate.scene, library.layout).size());
  text.line("{:>4}  {:<{}}  {:>11}  {:>10}  {:>11}  {}", "rank", "scene", width, "probability", "misfit",
            "behind", "where");
  for (std::size_t i = 0; i < answer.candidates.size(); ++i) {
    const Candidate& candidate = answer.candidates[i];
    text.line("{:>4}  {:<{}}  {:>11}  {:>10.4f}  {:>11}  {}", i + 1,
              to_string(candidate.scene, library.layout), width,
              candidate.posterior ? percent(*candidate.posterior) : "-", candidate.misfit,
              i == 0 ? "-" : behind(candidate, answer.candidates.front()),
              place_in_words(candidate.scene, library.layout));
  }
}

void write_groups(Text& text, const Answer& answer, const Library& library) {
  const Candidate& best = answer.candidates.front();
  if (best.same_readings.empty()) return;
  std::string names;
  for (const Scene& scene : best.same_readings)
    names += (names.empty() ? "" : "; ") + to_string(scene, library.layout);
  text.line("These sensors cannot tell {} from: {}", to_string(best.scene, library.layout), names);
}

void write_probabilities(Text& text, const Answer& answer, const Library& library) {
  const Posterior& posterior = *answer.posterior;
  std::string numbers;
  for (std::size_t missing = 0; missing < posterior.missing_probability.size(); ++missing)
    numbers += fmt::format("{}{}: {}", missing == 0 ? "" : ", ", missing,
                           percent(posterior.missing_probability[missing]));
  text.line("Number of missing blocks: {}", numbers);
  std::vector<std::size_t> blocks;
  for (std::size_t id = 0; id < posterior.block_probability.size(); ++id)
    if (posterior.block_probability[id] >= kBlockWorthListing) blocks.push_back(id);
  std::stable_sort(blocks.begin(), blocks.end(), [&](std::size_t a, std::size_t b) {
    return posterior.block_probability[a] > posterior.block_probability[b];
  });
  blocks.resize(std::min(blocks.size(), kMostBlocksListed));
  std::string names;
  for (const std::size_t id : blocks)
    names += fmt::format("{}{}: {}", names.empty() ? "" : "; ", to_string(library.layout.blocks[id].index),
                         percent(posterior.block_probability[id]));
  text.line("Blocks most likely missing: {}", names.empty() ? "none" : names);
  text.line("{:.0f} % of the probability is held by {} scene{}", 100.0 * kCredibleShare,
            posterior.credible.size(), posterior.credible.size() == 1 ? "" : "s");
}

void write_sensors(Text& text, const Answer& answer, const Library& library) {
  std::vector<SensorResidual> odd;
  std::copy_if(answer.residuals.begin(), answer.residuals.end(), std::back_inserter(odd),
               [](const SensorResidual& sensor) { return sensor.disagrees; });
  std::stable_sort(odd.begin(), odd.end(), [](const SensorResidual& a, const SensorResidual& b) {
    return std::abs(a.error) > std::abs(b.error);
  });
  if (odd.empty()) text.line("Sensors: none disagrees with the rest");
  odd.resize(std::min(odd.size(), kMostSensorsListed));
  for (const SensorResidual& sensor : odd)
    text.line("Sensor {} disagrees: it reads {:.4g} mm where {:.4g} mm would be expected",
              library.points[sensor.point].name, kMillimetres * sensor.reading,
              kMillimetres * sensor.predicted);
}

void write_genetic(Text& text, const Answer& answer) {
  for (const GeneticResult& run : answer.genetic)
    text.line("Genetic search: {} generations, the best appeared in generation {}, {} scenes scored",
              run.generations, run.converged, run.evaluations);
}

}  // namespace

std::string text_report(const Answer& answer, const Library& library, const Source& source) {
  Text text;
  write_heading(text, answer, library, source);
  write_genetic(text, answer);
  text.line("");
  if (answer.candidates.empty()) {
    text.line(
        "No scene in this database explains these measurements: every scene lacks a block that has a "
        "reading.");
    return text.take();
  }
  write_verdict(text, answer, library);
  if (answer.noise) text.line("Noise:        {}", noise_in_words(*answer.noise));
  text.line("");
  write_table(text, answer, library);
  text.line("");
  write_groups(text, answer, library);
  if (answer.posterior && !answer.posterior->credible.empty()) write_probabilities(text, answer, library);
  if (answer.posterior) write_sensors(text, answer, library);
  return text.take();
}

}  // namespace voussoir
