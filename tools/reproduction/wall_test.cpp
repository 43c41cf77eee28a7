#include "tools/reproduction/wall_test.h"

#include <algorithm>
#include <future>

#include "core/error.h"
#include "core/structure/halved_blocks.h"

namespace voussoir {
namespace {

constexpr double kKilo = 1e-3;
constexpr double kWorn = 0.5;  ///< share of the bond that is left where a joint counts as cracked

CrackPlace place_of(const BridgeDescription& description, const Model& model, const Joint& joint) {
  const Block& first = model.layout[joint.first];
  const Block& second = model.layout[joint.second];
  if (are_halves(first, second, description.wall)) return CrackPlace::brick;
  if (first.index.course == second.index.course) return CrackPlace::head;
  const int lower = std::min(first.index.course, second.index.course);
  const int embedded = description.supports.embedded_courses;
  const bool at_beam = lower <= embedded || lower >= description.wall.courses - embedded;
  return at_beam ? CrackPlace::beam : CrackPlace::bed;
}

/// Fills in what has cracked.
void find_cracks(const WallTest& test, const Coefficients& coefficients, const State& state, WallStep& step) {
  for (std::size_t j = 0; j < state.memory.size(); ++j) {
    if (coefficients.mortar.empty() || !coefficients.mortar[j] || state.memory[j].bond.empty()) continue;
    const CohesiveStiffness& mortar = *coefficients.mortar[j];
    double left = 0.0, opened = 0.0, slid = 0.0;
    for (std::size_t i = 0; i < kBondPoints; ++i) {
      const double weight = bond_points()[i].weight;
      const BondMemory& point = state.memory[j].bond[i];
      left += weight * bond_left(mortar, point);
      opened += weight * point.opening / mortar.opening_length;
      slid += weight * point.slipped / mortar.slip_length;
    }
    if (left > kWorn) continue;
    const Joint& joint = test.model.joints[j];
    step.cracked.at(static_cast<std::size_t>(place_of(test.description, test.model, joint))) += joint.length;
    step.cracks.push_back({j, opened > slid});
  }
}

/// What decides how strong the wall is once its joints have cracked.
struct VariedQuantity {
  const char* name;
  bool of_bricks;  ///< of the mortar in the middle of blocks, else of the joints'
  double Mortar::*value;
};

constexpr std::array<VariedQuantity, 4> kVaried = {
    {{"joints: compressive strength [Pa]", false, &Mortar::compressive_strength},
     {"joints: crushing energy [J/m2]", false, &Mortar::crushing_energy},
     {"bricks: tensile strength [Pa]", true, &Mortar::tensile_strength},
     {"bricks: opening energy [J/m2]", true, &Mortar::opening_energy}}};

WallTest run(const BridgeDescription& description) {
  WallTest test{.description = description, .model = {}, .moved = {}, .steps = {}};
  if (test.description.movements.empty())
    throw InputError(description.name + ": no [[movements]]: expected what is done to the wall");
  test.model = make_model(test.description);
  test.moved = validation::follow_movements(test.model, test.description.movements);
  const EquilibriumSystem system(test.model);
  const Coefficients coefficients(system, test.model.parameters);
  for (const validation::MovedPoint& point : test.moved.points) {
    if (point.movement + 1 != test.description.movements.size()) continue;
    WallStep& step = test.steps.emplace_back();
    step.millimetres = point.moved.x() / kKilo;
    step.kilonewtons = kKilo * point.force.x();
    step.vertical_kilonewtons = -kKilo * point.force.y();
    step.dissipated = point.at.dissipated;
    step.snapped = point.at.snapped;
    find_cracks(test, coefficients, point.at.state, step);
  }
  if (test.steps.empty())
    throw InputError(description.name + ": the wall gives way before the last movement");
  const auto strongest = std::ranges::max_element(test.steps, {}, &WallStep::kilonewtons);
  test.peak = static_cast<std::size_t>(strongest - test.steps.begin());
  return test;
}

WallVariation vary(BridgeDescription wall, const VariedQuantity& quantity) {
  WallVariation variation{.quantity = quantity.name, .strongest = {}};
  for (MortarRegion& region : wall.mortar) {
    if (region.within_blocks != quantity.of_bricks) continue;
    double& value = region.mortar.*quantity.value;
    variation.value = value;
    value *= kVariedShare;
    variation.varied = value;
  }
  const WallTest test = run(wall);
  variation.strongest = test.steps[test.peak];
  return variation;
}

}  // namespace

WallTest run_wall_test(const std::filesystem::path& bridge_file) {
  return run(read_bridge_file(bridge_file).description);
}

std::vector<WallVariation> vary_wall(const BridgeDescription& wall) {
  std::vector<std::future<WallVariation>> runs;
  for (const VariedQuantity& quantity : kVaried)
    runs.push_back(std::async(std::launch::async, [&wall, quantity] { return vary(wall, quantity); }));
  std::vector<WallVariation> variations;
  for (std::future<WallVariation>& each : runs) variations.push_back(each.get());
  return variations;
}

}  // namespace voussoir
