#include "core/motion/softening.h"

#include <algorithm>

#include "core/motion/critical_step.h"

namespace voussoir {

std::vector<double> softening(const Model& model, const std::vector<BlockBody>& bodies,
                              double contact_damping, double step) {
  // critical_step's condition, solved for the square of the frequency.
  const double allowed = 4.0 / (step * (step + 2.0 * contact_damping));
  std::vector<double> shares;
  for (const double frequency : block_frequencies(model, bodies, step))
    shares.push_back(std::min(1.0, allowed / (frequency * frequency)));
  return shares;
}

Model softened(Model model, const std::vector<double>& share_of_block) {
  const auto share = [&](BlockId block) { return share_of_block[static_cast<std::size_t>(block)]; };
  for (std::size_t j = 0; j < model.joints.size(); ++j)
    model.parameters.joints[j] = softened(
        model.parameters.joints[j], std::min(share(model.joints[j].first), share(model.joints[j].second)));
  model.parameters.contact_share = share_of_block;
  return model;
}

}  // namespace voussoir
