#include "core/geometry/curve.h"

#include <utility>

namespace voussoir {

Curve with_mirror_image(double axis, double length, HalfCurve half) {
  Curve curve{.length = length, .point = {}, .has_corner = false};
  curve.point = [axis, half = std::move(half)](const CurvePlace& place, double offset) -> Point {
    const bool right = 2.0 * place.part > place.parts;
    const Point image = half({right ? place.parts - place.part : place.part, place.parts}, offset);
    return {axis + (right ? image.x() : -image.x()), image.y()};
  };
  return curve;
}

}  // namespace voussoir
