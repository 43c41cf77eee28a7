#include "core/structure/stage.h"

#include <cmath>

namespace voussoir {
namespace {

/// As it is, or, where it is empty, this value in the shape of the other.
template <class Array>
Array filled(const Array& array, double value, const Array& other) {
  return array.size() > 0 ? array : Array(Array::Constant(other.rows(), other.cols(), value));
}

/// Zero where there is none.
template <class Array>
Array mixed(const Array& from, const Array& to, double share) {
  return (1.0 - share) * filled(from, 0.0, to) + share * filled(to, 0.0, from);
}

/// All of it where there is none.
Eigen::ArrayXd mixed_shares(const Eigen::ArrayXd& from, const Eigen::ArrayXd& to, double share) {
  return filled(from, 1.0, to).binaryExpr(filled(to, 1.0, from), [share](double first, double last) {
    return std::pow(first, 1.0 - share) * std::pow(last, share);
  });
}

}  // namespace

double temperature_of(const Stage& stage, std::size_t block) {
  if (stage.uneven_temperature.size() == 0) return stage.temperature;
  return stage.temperature + stage.uneven_temperature[static_cast<Eigen::Index>(block)];
}

Stage on_the_way(const Stage& from, Stage to, double share) {
  to.gravity_share = std::lerp(from.gravity_share, to.gravity_share, share);
  to.load = mixed(from.load, to.load, share);
  to.temperature = std::lerp(from.temperature, to.temperature, share);
  to.uneven_temperature = mixed(from.uneven_temperature, to.uneven_temperature, share);
  to.joint_stiffness = mixed_shares(from.joint_stiffness, to.joint_stiffness, share);
  to.support_movement = mixed(from.support_movement, to.support_movement, share);
  return to;
}

}  // namespace voussoir
