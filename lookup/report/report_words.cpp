#include "lookup/report/report_words.h"

#include <fmt/format.h>

#include <algorithm>

#include "lookup/report/words.h"

namespace voussoir {

std::vector<std::string> verdict(const Answer& answer, const Library& library) {
  const Candidate& best = answer.candidates.front();
  const bool unexplained = answer.fit && !answer.fit->explained;
  std::vector<std::string> sentences;
  if (unexplained)
    sentences.push_back(
        fmt::format("No scene in this database explains these measurements: {}.", answer.fit->reason));
  const std::string_view opening = unexplained ? "Closest" : "Most likely";
  sentences.push_back(fmt::format("{}: {} ({})", answer.posterior ? opening : "Best match",
                                  to_string(best.scene, library.layout),
                                  place_in_words(best.scene, library.layout)));
  if (best.posterior) sentences.push_back(fmt::format("Probability:  {}", percent(*best.posterior)));
  if (best.outcome == Outcome::collapsed)
    sentences.push_back("This scene collapses: its displacements are a snapshot, not an equilibrium.");
  return sentences;
}

std::string noise_in_words(const NoiseEstimate& noise) {
  if (noise.estimated && noise.level <= 2.0 * kSmallestLevel) return "none that could be seen";
  const std::string_view meaning = noise.shape == NoiseShape::uniform ? "at most" : "a standard deviation of";
  return fmt::format("{} {:.2g} % of the displacement ({} noise, {})", meaning, 100.0 * noise.level,
                     to_string(noise.shape), noise.estimated ? "estimated" : "as stated");
}

std::string behind(const Candidate& candidate, const Candidate& best) {
  if (!best.posterior) return fmt::format("{:+.4f}", candidate.misfit - best.misfit);
  if (*candidate.posterior == 0.0) return "negligible";
  const double odds = *best.posterior / *candidate.posterior;
  return odds < 1e6 ? fmt::format("1 : {:.4g}", odds) : "1 : > 10^6";
}

std::string missing_in_words(const Posterior& posterior) {
  std::string numbers;
  for (std::size_t missing = 0; missing < posterior.missing_probability.size(); ++missing)
    numbers += fmt::format("{}{}: {}", missing == 0 ? "" : ", ", missing,
                           percent(posterior.missing_probability[missing]));
  return numbers;
}

std::vector<BlockId> likely_blocks(const Posterior& posterior, double least) {
  const auto probability = [&](BlockId id) {
    return posterior.block_probability[static_cast<std::size_t>(value(id))];
  };
  std::vector<BlockId> blocks;
  for (std::size_t i = 0; i < posterior.block_probability.size(); ++i)
    if (posterior.block_probability[i] >= least) blocks.push_back(BlockId{static_cast<std::int32_t>(i)});
  std::stable_sort(blocks.begin(), blocks.end(),
                   [&](BlockId a, BlockId b) { return probability(a) > probability(b); });
  return blocks;
}

}  // namespace voussoir
