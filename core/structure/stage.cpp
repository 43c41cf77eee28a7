#include "core/structure/stage.h"

#include <cmath>

namespace voussoir {
namespace {

/// Zero where there is none.
Field movement_like(const Field& movement, const Field& other) {
  return movement.size() > 0 ? movement : Field(Field::Zero(other.rows(), other.cols()));
}

}  // namespace

Stage on_the_way(const Stage& from, Stage to, double share) {
  to.temperature = std::lerp(from.temperature, to.temperature, share);
  to.joint_stiffness = std::pow(from.joint_stiffness, 1.0 - share) * std::pow(to.joint_stiffness, share);
  to.support_movement = (1.0 - share) * movement_like(from.support_movement, to.support_movement) +
                        share * movement_like(to.support_movement, from.support_movement);
  return to;
}

}  // namespace voussoir
