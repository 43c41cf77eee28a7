#include "core/statics/transposed_solver.h"

#include <algorithm>

namespace voussoir {
namespace {

std::vector<int> transposed_slots(const Eigen::SparseMatrix<double>& pattern) {
  const int* begin = pattern.outerIndexPtr();
  const int* row = pattern.innerIndexPtr();
  std::vector<int> slots(static_cast<std::size_t>(pattern.nonZeros()));
  for (int column = 0; column < pattern.outerSize(); ++column)
    for (int slot = begin[column]; slot < begin[column + 1]; ++slot) {
      const int* mirror = std::lower_bound(row + begin[row[slot]], row + begin[row[slot] + 1], column);
      slots[static_cast<std::size_t>(slot)] = static_cast<int>(mirror - row);
    }
  return slots;
}

}  // namespace

TransposedSolver::TransposedSolver(const EquilibriumSystem& system)
    : system_(system),
      transposed_slot_(transposed_slots(system.pattern)),
      linear_(system.pattern),
      tangent_(static_cast<std::size_t>(system.pattern.nonZeros())),
      lanes_(tangent_.size()),
      right_(static_cast<std::size_t>(system.unknown_count())) {}

bool TransposedSolver::solve(const StageEquations& equations, const Field& displacement,
                             ComponentRows& right_hand_sides) {
  assemble(equations, displacement, 0.0, {tangent_.data()});
  for (std::size_t i = 0; i < tangent_.size(); ++i)
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      lanes_[i].value[lane] = tangent_[static_cast<std::size_t>(transposed_slot_[i])];
  if (!linear_.factorise(lanes_).front()) return false;
  const ComponentRows given = right_hand_sides;
  right_hand_sides.setZero();
  for (Eigen::Index first = 0; first < given.cols(); first += kLanes) {
    const std::size_t count = std::min<std::size_t>(kLanes, static_cast<std::size_t>(given.cols() - first));
    for (std::size_t i = 0; i < right_.size(); ++i)
      for (std::size_t lane = 0; lane < kLanes; ++lane)
        right_[i].value[lane] =
            lane < count ? given(system_.component[i], first + static_cast<Eigen::Index>(lane)) : 0.0;
    linear_.solve(right_);
    for (std::size_t i = 0; i < right_.size(); ++i)
      for (std::size_t lane = 0; lane < count; ++lane)
        right_hand_sides(system_.component[i], first + static_cast<Eigen::Index>(lane)) =
            right_[i].value[lane];
  }
  return right_hand_sides.allFinite();
}

}  // namespace voussoir
