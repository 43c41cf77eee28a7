#include "generator/start_field.h"

namespace voussoir {
namespace {

Field zero_for_nan(const Field& field) {
  return field.array().isNaN().select(Field::Zero(2, field.cols()), field);
}

}  // namespace

void StartingFields::add(const Scene& scene, Outcome outcome, const Field& displacement) {
  if (outcome != Outcome::standing) return;
  if (scene.missing() == 0) intact_ = displacement;
  if (scene.missing() == 1) standing_singles_[scene] = displacement;
}

std::optional<Field> StartingFields::start_for(const Scene& scene) const {
  if (scene.removed.empty() || !intact_) return std::nullopt;
  Field start = *intact_;
  if (scene.missing() == 1) return start;
  for (const BlockId block : scene.removed) {
    const auto single = standing_singles_.find(Scene{{block}});
    if (single != standing_singles_.end()) start += single->second - *intact_;
  }
  return zero_for_nan(start);
}

}  // namespace voussoir
