#pragma once
/// @file May the best answer be believed? What its candidates leave of the readings, and what speaks against
/// them.

#include <optional>
#include <vector>

#include "lookup/answer/answer.h"
#include "lookup/checks/asked_readings.h"
#include "lookup/unknown/unknown_question.h"

namespace voussoir {

/// As in Answer.
struct Judgement {
  NoiseEstimate noise;
  Fit fit;
  std::vector<SensorResidual> residuals{};
  std::optional<BridgeAnswer> bridge{};
};

/// Of a bridge that counts as known, if the scene in row `best` is the truth.
Judgement judge_known_bridge(const AskedReadings& asked, std::size_t best);

/// The same of a bridge that is not exactly known, and what the readings say of it, averaged over the
/// likeliest scenes. `likeliest`: of the question's evidence.
Judgement judge_unknown_bridge(const AskedReadings& asked, const UnknownBridgeQuestion& question,
                               const UnknownSettings& settings, const UnknownCase& likeliest);

}  // namespace voussoir
