#pragma once
/// @file What the readings say of a bridge that is not exactly known, as tables for text, JSON and page.

#include <string>
#include <vector>

#include "lookup/answer/answer.h"

namespace voussoir {

/// Something that moved the sensors, as far as the answer believes in it: means over the likeliest scenes.
struct Cause {
  std::string name;  ///< "missing blocks", "the bridge itself", "temperature", "supports", "joint stiffness"
                     ///< of an epoch, "uneven warmth and stiffness", "what is left"
  double share = 0.0;  ///< [-] of the sum of squares of the readings less what the nominal intact bridge
                       ///< shows: their product with this part. Shares sum up to one; a part that works
                       ///< against the others has a negative one
  double size = 0.0;   ///< [m] root mean square of the part
};

/// Of changes and of what loads add the readings are those; the first epoch's own do not count.
std::vector<Cause> causes_of(const BridgeAnswer& bridge, const ReadingFactors& factors);

/// A parameter in its own unit, or the logarithm of a factor on what the bridge file states.
struct KnownParameter {
  std::string name;
  std::string unit;               ///< "1" of logarithms
  double deviation_before = 0.0;  ///< of what lookups believe beforehand (mean 0): as the file
                                  ///< states, widened by kappa and the sizes of conditions
  double mean = 0.0;
  double deviation = 0.0;

  /// How far the readings moved or narrowed what was believed, to choose what is worth showing.
  double news() const;
};

/// The parameters that the whole bridge shares, and of the joints' own those that the readings move farthest.
std::vector<KnownParameter> known_of_bridge(const BridgeAnswer& bridge, const ReadingFactors& factors,
                                            std::size_t most_joints);

/// All parameters of epochs: of two epochs how they changed.
std::vector<KnownParameter> known_of_epochs(const BridgeAnswer& bridge, const ReadingFactors& factors);

/// What is believed beforehand, one standard deviation to each side: "-14 to +16 %", "+- 20 K".
std::string before_in_words(const KnownParameter& parameter);
/// And afterwards: "-4 % (-7 to -1 %)", "+0.3 +- 1.2 K".
std::string after_in_words(const KnownParameter& parameter);

/// "young modulus: -4 % (-7 to -1 %), before -14 to +16 %"
std::string in_words(const KnownParameter& parameter);

/// "missing blocks 97 %, the bridge itself 1 %, .."
std::string causes_in_words(const std::vector<Cause>& causes);

}  // namespace voussoir
