#include "core/structure/stage.h"

#include <cmath>

namespace voussoir {
namespace {

/// Zero where there is none.
Field movement_like(const Field& movement, const Field& other) {
  return movement.size() > 0 ? movement : Field(Field::Zero(other.rows(), other.cols()));
}

/// All of it where there is none.
Eigen::ArrayXd shares_like(const Eigen::ArrayXd& shares, const Eigen::ArrayXd& other) {
  return shares.size() > 0 ? shares : Eigen::ArrayXd(Eigen::ArrayXd::Ones(other.size()));
}

Eigen::ArrayXd shares_on_the_way(const Eigen::ArrayXd& from, const Eigen::ArrayXd& to, double share) {
  return shares_like(from, to).binaryExpr(shares_like(to, from), [share](double first, double last) {
    return std::pow(first, 1.0 - share) * std::pow(last, share);
  });
}

/// Zero where there is none.
Eigen::ArrayXd warmth_like(const Eigen::ArrayXd& warmth, const Eigen::ArrayXd& other) {
  return warmth.size() > 0 ? warmth : Eigen::ArrayXd(Eigen::ArrayXd::Zero(other.size()));
}

}  // namespace

double temperature_of(const Stage& stage, std::size_t block) {
  if (stage.uneven_temperature.size() == 0) return stage.temperature;
  return stage.temperature + stage.uneven_temperature[static_cast<Eigen::Index>(block)];
}

Stage on_the_way(const Stage& from, Stage to, double share) {
  to.temperature = std::lerp(from.temperature, to.temperature, share);
  to.uneven_temperature = (1.0 - share) * warmth_like(from.uneven_temperature, to.uneven_temperature) +
                          share * warmth_like(to.uneven_temperature, from.uneven_temperature);
  to.joint_stiffness = shares_on_the_way(from.joint_stiffness, to.joint_stiffness, share);
  to.support_movement = (1.0 - share) * movement_like(from.support_movement, to.support_movement) +
                        share * movement_like(to.support_movement, from.support_movement);
  return to;
}

}  // namespace voussoir
