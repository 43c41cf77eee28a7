#include "core/motion/pace.h"

#include <algorithm>

namespace voussoir {
namespace {

/// Work that is hardly less is not worth the parts.
constexpr double kWorthIt = 0.8;

/// Joints at blocks that are quick, of all.
double share_of_joints(const Model& model, const std::vector<bool>& quick) {
  const auto at_quick = [&](const Joint& joint) {
    return quick[static_cast<std::size_t>(value(joint.first))] ||
           quick[static_cast<std::size_t>(value(joint.second))];
  };
  return static_cast<double>(std::ranges::count_if(model.joints, at_quick)) /
         static_cast<double>(std::max<std::size_t>(model.joints.size(), 1));
}

}  // namespace

Pace best_pace(const Model& model, const std::vector<BlockBody>& bodies, double contact_damping,
               double critical, double share, int most_parts) {
  const double quick_step = share * critical;
  const std::vector<double> frequencies = block_frequencies(model, bodies, most_parts * quick_step);
  const double highest = *std::ranges::max_element(frequencies);
  Pace best{.step = quick_step};
  double least_work = kWorthIt;  // of a time `quick_step`
  for (int parts = 2; parts <= most_parts; ++parts) {
    std::vector<bool> quick;
    for (const double frequency : frequencies) quick.push_back(frequency > highest / parts);
    const double at_quick = share_of_joints(model, quick);
    const double work = (1.0 - at_quick) / parts + at_quick;
    if (work >= least_work) continue;
    least_work = work;
    best = {.step = parts * quick_step, .parts = parts, .quick = std::move(quick)};
  }
  if (best.parts == 1) return best;
  const double others =
      critical_step(model, bodies, Integrator::implicit_blocks, contact_damping, best.quick);
  best.step = std::min(best.step, share * others);
  return best;
}

}  // namespace voussoir
