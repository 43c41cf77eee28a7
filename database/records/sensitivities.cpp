#include "database/records/sensitivities.h"

#include <algorithm>

#include "database/records/record_key.h"

namespace voussoir {

bool precedes(const Scene& first, const Scene& second) {
  return row_order(kNominalVariant, first.removed, kNominalVariant, second.removed) < 0;
}

void Sensitivities::make_room(std::size_t states, Eigen::Index points, Eigen::Index samples) {
  const std::size_t count = states * scenes.size();
  known.assign(count, FactorsKnown::no);
  bridge = StackedMatrices(count, points, basis.cols());
  epoch = StackedMatrices(count, points, of_epoch());
  left = StackedMatrices(count, points, samples);
  standing_share.clear();
  if_standing = {};
  residuals.resize(states);
}

void Sensitivities::set(std::size_t state, std::size_t scene, const SceneFactors& factors) {
  const std::size_t place = state * scenes.size() + scene;
  known[place] = factors.known() ? FactorsKnown::yes : FactorsKnown::no;
  if (!factors.known()) return;
  bridge.own(place) = factors.bridge;
  epoch.own(place) = factors.epoch;
  if (factors.left.size() > 0) left.own(place) = factors.left;
}

void Sensitivities::set_fall(std::size_t state, std::size_t scene, const UncertainFall& fall) {
  if (standing_share.empty()) {
    standing_share.assign(known.size(), 0.0);
    if_standing = StackedMatrices(known.size(), fall.if_standing.size(), 1);
  }
  const std::size_t place = state * scenes.size() + scene;
  known[place] = FactorsKnown::of_uncertain_fall;
  standing_share[place] = fall.standing_share;
  if_standing.own(place) = fall.if_standing;
}

std::optional<std::size_t> Sensitivities::place_of(std::size_t state, const Scene& scene) const {
  const auto found = std::lower_bound(scenes.begin(), scenes.end(), scene, precedes);
  if (found == scenes.end() || *found != scene) return std::nullopt;
  const std::size_t place = state * scenes.size() + static_cast<std::size_t>(found - scenes.begin());
  return is_known(place) ? std::optional(place) : std::nullopt;
}

std::optional<FactorsView> Sensitivities::find(std::size_t state, const Scene& scene) const {
  const auto place = place_of(state, scene);
  if (!place) return std::nullopt;
  return FactorsView{bridge[*place], epoch[*place], left[*place]};
}

std::optional<UncertainFall> Sensitivities::find_fall(std::size_t state, const Scene& scene) const {
  const auto place = place_of(state, scene);
  if (!place || known[*place] != FactorsKnown::of_uncertain_fall) return std::nullopt;
  return UncertainFall{standing_share[*place], if_standing[*place]};
}

bool are_factors_sound(const Sensitivities& sensitivities) {
  for (std::size_t place = 0; place < sensitivities.known.size(); ++place) {
    const FactorsView factors{sensitivities.bridge[place], sensitivities.epoch[place],
                              sensitivities.left[place]};
    const bool is_known = sensitivities.is_known(place);
    if (!is_known && !(factors.bridge.isZero(0.0) && factors.epoch.isZero(0.0))) return false;
    const bool is_fall = sensitivities.known[place] == FactorsKnown::of_uncertain_fall;
    if (!sensitivities.standing_share.empty() && !is_fall && !sensitivities.if_standing[place].isZero(0.0))
      return false;
    const bool is_loss = place % sensitivities.scenes.size() != 0;
    if (!(is_known && is_loss) && !factors.left.isZero(0.0)) return false;
  }
  return true;
}

}  // namespace voussoir
