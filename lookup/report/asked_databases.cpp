#include "lookup/report/asked_databases.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lookup/report/words.h"

namespace voussoir {

void weigh(std::vector<AskedDatabase>& databases) {
  std::ranges::stable_sort(databases, std::ranges::greater{}, &AskedDatabase::log_evidence);
  const double most = databases.front().log_evidence;
  double total = 0.0;
  for (AskedDatabase& one : databases) {
    // Where none has a possible scene, none is more likely than the others.
    one.probability = one.log_evidence == most ? 1.0 : std::exp(one.log_evidence - most);
    total += one.probability;
  }
  for (AskedDatabase& one : databases) one.probability /= total;
}

bool is_contested(std::span<const AskedDatabase> databases) {
  const AskedDatabase& first = databases.front();
  return std::ranges::any_of(databases.subspan(1), [&](const AskedDatabase& other) {
    if (other.probability < kCounting) return false;
    return other.verdict != first.verdict ||
           (first.verdict == Verdict::located && other.first != first.first);
  });
}

std::string in_words(const AskedDatabase& database) {
  return fmt::format("{:>8}  {} (digest {}): {}{}", percent(database.probability), database.file,
                     database.digest.substr(0, kDigestShown), to_string(database.verdict),
                     database.first.empty() ? "" : fmt::format(", first {}", database.first));
}

}  // namespace voussoir
