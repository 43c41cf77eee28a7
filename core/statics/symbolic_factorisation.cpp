#include "core/statics/symbolic_factorisation.h"

#include <amd.h>

#include <algorithm>

#include "core/error.h"

namespace voussoir {
namespace {

/// Widest supernode: its factors and one row's values fit the sixteen AVX registers.
constexpr int kWidest = 8;

void order(const Eigen::SparseMatrix<double>& pattern, SymbolicFactorisation& f) {
  f.permutation.resize(static_cast<std::size_t>(f.n));
  if (amd_order(f.n, pattern.outerIndexPtr(), pattern.innerIndexPtr(), f.permutation.data(), nullptr,
                nullptr) < AMD_OK)
    throw Failure("the ordering of the stiffness matrix failed: out of memory");
}

/// Old position -> new.
std::vector<int> inverse(const std::vector<int>& permutation) {
  std::vector<int> position(permutation.size());
  for (std::size_t k = 0; k < permutation.size(); ++k)
    position[static_cast<std::size_t>(permutation[k])] = static_cast<int>(k);
  return position;
}

/// Column k of L holds the lower part of column k of A and whatever its children in the elimination tree hold
/// below k.
std::vector<std::vector<int>> find_fill(const Eigen::SparseMatrix<double>& pattern,
                                        SymbolicFactorisation& f) {
  const auto n = static_cast<std::size_t>(f.n);
  std::vector<std::vector<int>> lower(n);
  std::vector<std::vector<int>> children(n);
  const std::vector<int> position = inverse(f.permutation);
  f.a_begin = {0};
  for (std::size_t k = 0; k < n; ++k) {
    const int old = f.permutation[k];
    for (int p = pattern.outerIndexPtr()[old]; p < pattern.outerIndexPtr()[old + 1]; ++p) {
      const int row = position[static_cast<std::size_t>(pattern.innerIndexPtr()[p])];
      f.a_row.push_back(row);
      f.a_slot.push_back(p);
      if (row > static_cast<int>(k)) lower[k].push_back(row);
    }
    f.a_begin.push_back(static_cast<int>(f.a_row.size()));
    for (const int child : children[k])
      for (const int row : lower[static_cast<std::size_t>(child)])
        if (row > static_cast<int>(k)) lower[k].push_back(row);
    std::sort(lower[k].begin(), lower[k].end());
    lower[k].erase(std::unique(lower[k].begin(), lower[k].end()), lower[k].end());
    if (!lower[k].empty())
      children[static_cast<std::size_t>(lower[k].front())].push_back(static_cast<int>(k));
  }
  return lower;
}

/// Column k + 1 joins column k if it is k's parent and holds all else that k holds.
void form_supernodes(const std::vector<std::vector<int>>& lower, SymbolicFactorisation& f) {
  for (int k = 0; k < f.n;) {
    int end = k + 1;
    while (end < f.n && end - k < kWidest &&
           lower[static_cast<std::size_t>(end - 1)].size() ==
               lower[static_cast<std::size_t>(end)].size() + 1 &&
           lower[static_cast<std::size_t>(end - 1)].front() == end)
      ++end;
    const std::vector<int>& below = lower[static_cast<std::size_t>(end - 1)];
    const Supernode s{k, end - k, static_cast<int>(f.row.size()), static_cast<int>(below.size()), f.values};
    f.row.insert(f.row.end(), below.begin(), below.end());
    f.values += s.width * (s.width + s.height);
    f.supernode_of.insert(f.supernode_of.end(), static_cast<std::size_t>(s.width),
                          static_cast<int>(f.supernodes.size()));
    f.supernodes.push_back(s);
    k = end;
  }
}

/// Column k of U: every supernode that reaches row k; columns of a supernode reach the same rows below it.
void form_upper_parts(SymbolicFactorisation& f) {
  std::vector<std::vector<UpperPart>> parts(static_cast<std::size_t>(f.n));
  for (std::size_t i = 0; i < f.supernodes.size(); ++i) {
    const Supernode& s = f.supernodes[i];
    const auto reach = [&](int k, int row) {
      parts[static_cast<std::size_t>(k)].push_back({static_cast<int>(i), s.values + row * s.width});
    };
    for (int row = 1; row < s.width; ++row) reach(s.first + row, row);
    for (int r = 0; r < s.height; ++r) reach(f.row[static_cast<std::size_t>(s.rows + r)], s.width + r);
  }
  f.upper_begin = {0};
  for (const auto& of_column : parts) {
    f.upper.insert(f.upper.end(), of_column.begin(), of_column.end());
    f.upper_begin.push_back(static_cast<int>(f.upper.size()));
  }
}

}  // namespace

SymbolicFactorisation symbolic_factorisation(const Eigen::SparseMatrix<double>& pattern) {
  SymbolicFactorisation f;
  f.n = static_cast<int>(pattern.rows());
  order(pattern, f);
  form_supernodes(find_fill(pattern, f), f);
  form_upper_parts(f);
  return f;
}

}  // namespace voussoir
