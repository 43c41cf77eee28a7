#pragma once
/// @file Databases of one bridge under different assumptions (supports, shape), asked about the same
/// readings.

#include <span>
#include <string>
#include <vector>

#include "lookup/answer/verdict.h"

namespace voussoir {

/// What one of them says, if its assumptions hold.
struct AskedDatabase {
  std::string file, bridge, digest;
  Verdict verdict = Verdict::unexplained;
  std::string first{};        ///< its first candidate; empty: no scene is possible
  double intact = 0.0;        ///< probability that no block is missing
  double log_evidence = 0.0;  ///< Posterior::log_evidence
  double probability = 0.0;   ///< that its assumptions hold: see weigh
};

/// A database that is less likely than this does not contest what another one says.
inline constexpr double kCounting = 0.05;

/// Fills in the probabilities, if all assumptions are as likely beforehand and one of them holds; the
/// likeliest comes first. Precondition: the same readings with the same errors were asked about.
void weigh(std::vector<AskedDatabase>& databases);

/// Does a database that counts say anything else than the first: another verdict, or another scene where both
/// name one?
bool is_contested(std::span<const AskedDatabase> databases);

/// "99.1 %  clamped.h5 (digest 0123456789ab): intact, first intact"
std::string in_words(const AskedDatabase& database);

}  // namespace voussoir
