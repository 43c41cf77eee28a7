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
      transposed_(tangent_.size()),
      right_(static_cast<std::size_t>(system.unknown_count())) {}

bool TransposedSolver::solve(const StageEquations& equations, const Field& displacement,
                             ComponentRows& right_hand_sides) {
  assemble(equations, displacement, 0.0, {tangent_.data()});
  for (std::size_t i = 0; i < tangent_.size(); ++i)
    transposed_[i].value = tangent_[static_cast<std::size_t>(transposed_slot_[i])];
  if (!linear_.factorise(transposed_).front()) return false;
  for (Eigen::Index component = 0; component < right_hand_sides.rows(); ++component)
    if (system_.unknown[static_cast<std::size_t>(component)] < 0) right_hand_sides.row(component).setZero();
  const auto sides = static_cast<std::size_t>(right_hand_sides.cols());
  for (std::size_t first = 0; first < sides; first += kLanes) {
    const std::size_t count = std::min(kLanes, sides - first);
    const auto place = [&](std::size_t i) {
      return right_hand_sides.data() + static_cast<std::size_t>(system_.component[i]) * sides + first;
    };
    for (std::size_t i = 0; i < right_.size(); ++i)
      right_[i].value = load_some<DoubleLanes>(place(i), count, 0.0);
    linear_.solve(right_);
    for (std::size_t i = 0; i < right_.size(); ++i) store_some(right_[i].value, count, place(i));
  }
  return right_hand_sides.allFinite();
}

}  // namespace voussoir
