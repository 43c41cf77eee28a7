#pragma once
/// @file The paper's own check of its model (Fig. 3): a wall with mortar, pressed and pushed sideways until
/// it cracks.

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/bridge_file/bridge_file.h"
#include "tools/validation/movements.h"

namespace voussoir {

/// Where mortar breaks.
enum class CrackPlace : std::size_t {
  beam,  ///< bed joints beside the embedded courses
  bed,   ///< other bed joints
  head,  ///< upright joints
  brick  ///< the middle of blocks
};

inline constexpr std::array<std::string_view, 4> kCrackPlaces = {"bed joints at the beams",
                                                                 "other bed joints", "head joints", "bricks"};

/// A stretch of joint more than half of whose bond is worn away.
struct Crack {
  std::size_t joint;
  bool opened;  ///< by opening rather than by slip
};

/// The end of a step of the push.
struct WallStep {
  double millimetres = 0.0;           ///< of the top, sideways
  double kilonewtons = 0.0;           ///< sideways
  double vertical_kilonewtons = 0.0;  ///< pressing down
  double dissipated = 0.0;            ///< [J] by mortar
  bool snapped = false;
  std::array<double, 4> cracked{};  ///< [m] length of cracks by CrackPlace
  std::vector<Crack> cracks;
};

struct WallTest {
  BridgeDescription description;
  Model model;
  validation::MovedStructure moved;
  std::vector<WallStep> steps;  ///< of the last movement; as many as its points
  std::size_t peak = 0;         ///< the step with the greatest force

  /// The last point of the last movement but `steps.size()`.
  std::size_t first_point() const { return moved.points.size() - steps.size(); }
};

/// Runs the file's movements. Throws InputError as reading the file and moving the supports do.
WallTest run_wall_test(const std::filesystem::path& bridge_file);

inline constexpr double kVariedShare = 0.9;  ///< what is left of a quantity that is varied

/// The greatest force if one of the quantities that break bricks and crush mortar is lower by a tenth.
struct WallVariation {
  std::string quantity;  ///< with its unit
  double value = 0.0;    ///< in the bridge file
  double varied = 0.0;
  WallStep strongest;
};

/// One quantity at a time, each a run of its own. Throws as run_wall_test.
std::vector<WallVariation> vary_wall(const BridgeDescription& wall);

}  // namespace voussoir
