#include "lookup/unknown/reduced_loss.h"

#include <algorithm>

namespace voussoir {
namespace {

template <class To, class From>
void copy_numbers(const From& from, To& to) {
  std::copy(from.begin(), from.end(), to.begin());
}

}  // namespace

ReducedPart<double> reduced_part(const DirectionTriangle& crossed, const DirectionTriangle& own) {
  ReducedPart<double> part;
  for (std::size_t losses = 0; losses < part.size(); ++losses)
    for (std::size_t at = 0; at < own.size(); ++at)
      part[losses][at] = crossed[at] + static_cast<double>(losses + 1) * own[at];
  return part;
}

LossInDirections<float> rounded(const LossInDirections<double>& loss) {
  LossInDirections<float> result;
  copy_numbers(loss.signal, result.signal);
  copy_numbers(loss.first, result.first);
  copy_numbers(loss.epoch, result.epoch);
  for (std::size_t losses = 0; losses < kMostLosses; ++losses) {
    copy_numbers(loss.of_bridge[losses], result.of_bridge[losses]);
    copy_numbers(loss.of_epoch[losses], result.of_epoch[losses]);
  }
  copy_numbers(loss.model_error, result.model_error);
  return result;
}

}  // namespace voussoir
