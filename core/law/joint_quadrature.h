#pragma once
/// @file The joint law at points of a stretch, to be compared with its exact integral.

#include <array>
#include <string_view>

#include "core/law/joint_law.h"

namespace voussoir {

/// How the law is integrated over a stretch. All but `exact` are there to be compared with it.
enum class JointRule {
  exact,      ///< joint_law.h
  lobatto_3,  ///< at both ends and the middle: 0.2 % off in displacements, many per cent in a removal's
              ///< signal
  gauss_16    ///< at 16 Gauss points
};

/// In the order of the rules.
inline constexpr std::array<std::string_view, 3> kJointRuleNames = {"exact", "lobatto-3", "gauss-16"};
constexpr std::string_view to_string(JointRule rule) {
  return kJointRuleNames.at(static_cast<std::size_t>(rule));
}

/// integrate_joint by a rule: every point is open, sticking or slipping.
JointResponse integrate_joint(const JointStiffness& joint, const JointMemory& memory, const JointState& state,
                              JointRule rule);

}  // namespace voussoir
