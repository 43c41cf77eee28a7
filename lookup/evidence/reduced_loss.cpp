#include "lookup/evidence/reduced_loss.h"

#include <algorithm>

namespace voussoir {
namespace {

template <class To, class From>
void copy_numbers(const From& from, To& to) {
  std::copy(from.begin(), from.end(), to.begin());
}

}  // namespace

LossInDirections<float> rounded(const LossInDirections<double>& loss) {
  LossInDirections<float> result;
  copy_numbers(loss.signal, result.signal);
  copy_numbers(loss.first, result.first);
  copy_numbers(loss.epoch, result.epoch);
  copy_numbers(loss.of_bridge.crossed, result.of_bridge.crossed);
  copy_numbers(loss.of_bridge.own, result.of_bridge.own);
  copy_numbers(loss.of_epoch.crossed, result.of_epoch.crossed);
  copy_numbers(loss.of_epoch.own, result.of_epoch.own);
  copy_numbers(loss.model_error, result.model_error);
  return result;
}

}  // namespace voussoir
