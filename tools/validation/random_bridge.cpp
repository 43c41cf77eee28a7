#include "tools/validation/random_bridge.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/random.h"

namespace voussoir {
namespace {

/// Uniform numbers from a seed.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}
  double between(double least, double most) { return least + (most - least) * random_.uniform(); }
  double even_in_logarithm(double least, double most) {
    return std::exp(between(std::log(least), std::log(most)));
  }
  int whole(int least, int most) {
    return least + static_cast<int>(random_.below(static_cast<std::uint32_t>(most - least + 1)));
  }

 private:
  Random random_;
};

}  // namespace

BridgeDescription random_bridge(std::uint64_t seed) {
  Draw draw(seed);
  BridgeDescription bridge;
  bridge.name = fmt::format("random {}", seed);
  bridge.collapse_fields = false;
  const int spans = draw.whole(1, 3);
  SpanDescription span;
  span.intrados_radius = draw.between(1.0, 5.0);
  span.ring_thickness = draw.between(0.08, 0.25) * span.intrados_radius;
  span.centre_y = draw.between(0.0, 1.5);
  span.voussoirs = draw.whole(9, 41);
  WallDescription& wall = bridge.wall;
  wall.course_height = draw.between(0.2, 0.6);
  wall.block_length = draw.between(0.4, 1.5);
  wall.bond = draw.whole(0, 1) == 0 ? Bond::running : Bond::stack;
  wall.smallest_block = kSmallestBlock;
  const double abutment = draw.between(0.5, 2.0) * span.intrados_radius;
  const double pier = draw.between(0.0, 0.5) * span.intrados_radius;
  const double cover = draw.between(0.2, 1.0) * span.intrados_radius;
  const double pitch = 2.0 * span.extrados_radius() + pier;
  wall.length = 2.0 * abutment + spans * pitch - pier;
  wall.courses =
      static_cast<int>(std::ceil((span.centre_y + span.extrados_radius() + cover) / wall.course_height));
  bridge.spans.clear();
  for (int i = 0; i < spans; ++i) {
    span.centre_x = abutment + span.extrados_radius() + i * pitch;
    bridge.spans.push_back(span);
  }
  bridge.material.young_modulus = draw.even_in_logarithm(2e9, 6e10);
  bridge.joints.normal_stiffness = draw.even_in_logarithm(1e8, 3e10);
  bridge.joints.tangential_stiffness = draw.even_in_logarithm(2e7, 3e9);
  bridge.joints.friction_angle = draw.between(25.0, 45.0) * std::numbers::pi / 180.0;
  return bridge;
}

std::string bridge_file_text(const BridgeDescription& bridge) {
  const WallDescription& wall = bridge.wall;
  std::string text = fmt::format(
      "# Drawn at random: benchmark-bridges --write. What is left out has the default of a bridge file.\n"
      "name = \"{}\"\n\n"
      "[wall]\nlength_m = {}\ncourses = {}\ncourse_height_m = {}\nblock_length_m = {}\nbond = \"{}\"\n\n"
      "[material]\nyoung_modulus_Pa = {}\n\n"
      "[joints]\nnormal_stiffness_Pa_per_m = {}\ntangential_stiffness_Pa_per_m = {}\n"
      "friction_angle_deg = {}\n",
      bridge.name, wall.length, wall.courses, wall.course_height, wall.block_length,
      wall.bond == Bond::running ? "running" : "stack", bridge.material.young_modulus,
      bridge.joints.normal_stiffness, bridge.joints.tangential_stiffness,
      bridge.joints.friction_angle * 180.0 / std::numbers::pi);
  for (const SpanDescription& span : bridge.spans)
    text += fmt::format(
        "\n[[spans]]\ncentre_x_m = {}\ncentre_y_m = {}\nintrados_radius_m = {}\nring_thickness_m = {}\n"
        "voussoirs = {}\n",
        span.centre_x, span.centre_y, span.intrados_radius, span.ring_thickness, span.voussoirs);
  return text;
}

}  // namespace voussoir
