#include "core/statics/lane_factorisation.h"

#include <amd.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace voussoir {
namespace {

/// A pivot this small against its diagonal entry has lost all its digits.
constexpr double kLostDigits = 1e-13;
/// Widest supernode: its factors and one row's values fit the sixteen AVX registers.
constexpr int kWidest = 8;

/// work[row] -= sum_c l(row, c) factor[c] for the rows below a supernode; `l` points at the first column
/// used.
template <int Count>
VOUSSOIR_INLINE void update_rows(const DoubleLanes* __restrict l, int stride, const int* __restrict rows,
                                 int height, const DoubleLanes* __restrict factor,
                                 DoubleLanes* __restrict work) {
  DoubleLanes f[Count];
  for (int c = 0; c < Count; ++c) f[c] = factor[c];
  for (int r = 0; r < height; ++r, l += stride) {
    DoubleLanes value = work[rows[r]];
    for (int c = 0; c < Count; ++c) value -= l[c] * f[c];
    work[rows[r]] = value;
  }
}

/// Calls work<count>() with a number of columns known when compiling, so that they fit registers.
template <class Work>
VOUSSOIR_INLINE void with_count(int count, const Work& work) {
  switch (count) {
    case 1:
      return work.template operator()<1>();
    case 2:
      return work.template operator()<2>();
    case 3:
      return work.template operator()<3>();
    case 4:
      return work.template operator()<4>();
    case 5:
      return work.template operator()<5>();
    case 6:
      return work.template operator()<6>();
    case 7:
      return work.template operator()<7>();
    default:
      return work.template operator()<8>();
  }
}

/// x[column] -= sum_r u(column, r) x[row r] for the columns of a supernode, then solves with its own block.
/// From the last row to the first: as they are found.
template <int Width>
VOUSSOIR_INLINE void substitute_back(const DoubleLanes* __restrict u, const int* __restrict rows, int height,
                                     const DoubleLanes* __restrict pivot, const DoubleLanes* __restrict x,
                                     DoubleLanes* __restrict own) {
  DoubleLanes sum[Width];
  for (int c = 0; c < Width; ++c) sum[c] = own[c];
  const DoubleLanes* row = u + (Width + height) * Width;
  for (int r = height; r-- > 0;) {
    row -= Width;
    const DoubleLanes value = x[rows[r]];
    for (int c = 0; c < Width; ++c) sum[c] -= row[c] * value;
  }
  for (int r = Width; r-- > 0;) {
    row -= Width;
    const DoubleLanes value = sum[r] / pivot[r];
    own[r] = value;
    for (int c = 0; c < r; ++c) sum[c] -= row[c] * value;
  }
}

}  // namespace

/// The arithmetic, on plain pointers.
struct LaneFactorisation::Kernel {
  int n;
  const int* a_begin;
  const int* a_row;
  const int* a_slot;
  const Supernode* supernodes;
  const int* supernode_of;
  const int* row;
  const int* upper_begin;
  const UpperPart* upper;
  DoubleLanes* l;
  DoubleLanes* u;
  DoubleLanes* pivot;
  DoubleLanes* diagonal;
  DoubleLanes* work;

  explicit Kernel(LaneFactorisation& f)
      : n(f.n_),
        a_begin(f.a_begin_.data()),
        a_row(f.a_row_.data()),
        a_slot(f.a_slot_.data()),
        supernodes(f.supernodes_.data()),
        supernode_of(f.supernode_of_.data()),
        row(f.row_.data()),
        upper_begin(f.upper_begin_.data()),
        upper(f.upper_.data()),
        l(registers_of(f.l_)),
        u(registers_of(f.u_)),
        pivot(registers_of(f.pivot_)),
        diagonal(registers_of(f.diagonal_)),
        work(registers_of(f.work_)) {}

  static void factorise(const Kernel& k, const DoubleLanes* values);
  static void substitute(const Kernel& k, DoubleLanes* x);
};

/// Left-looking: column k of A minus the earlier columns of L times column k of U.
VOUSSOIR_FOR_EVERY_PROCESSOR
void LaneFactorisation::Kernel::factorise(const Kernel& kernel, const DoubleLanes* values) {
  const Kernel f = kernel;
  for (int k = 0; k < f.n; ++k) {
    const Supernode own = f.supernodes[f.supernode_of[k]];
    for (int c = own.first; c < own.first + own.width; ++c) f.work[c] = DoubleLanes{};
    for (int r = 0; r < own.height; ++r) f.work[f.row[own.rows + r]] = DoubleLanes{};
    for (int p = f.upper_begin[k]; p < f.upper_begin[k + 1]; ++p) {
      const Supernode& s = f.supernodes[f.upper[p].supernode];
      for (int c = s.first; c < s.first + s.width; ++c) f.work[c] = DoubleLanes{};
    }
    for (int p = f.a_begin[k]; p < f.a_begin[k + 1]; ++p) f.work[f.a_row[p]] = values[f.a_slot[p]];
    f.diagonal[k] = f.work[k];

    for (int p = f.upper_begin[k]; p < f.upper_begin[k + 1]; ++p) {
      const UpperPart part = f.upper[p];
      const Supernode s = f.supernodes[part.supernode];
      const int end = std::min(s.first + s.width, k);
      const DoubleLanes* block = f.l + s.values;  // rows and columns of the supernode
      for (int c = s.first; c < end; ++c) {
        const DoubleLanes factor = f.work[c];
        f.u[part.values + c - s.first] = factor;
        for (int r = c + 1; r < s.first + s.width; ++r)
          f.work[r] -= block[(r - s.first) * s.width + c - s.first] * factor;
      }
      with_count(end - s.first, [&]<int kCount>() VOUSSOIR_INLINE_WORK {
        update_rows<kCount>(block + s.width * s.width, s.width, f.row + s.rows, s.height, f.u + part.values,
                            f.work);
      });
    }

    const DoubleLanes pivot = f.work[k];
    f.pivot[k] = pivot;
    DoubleLanes* block = f.l + own.values + k - own.first;
    for (int r = k + 1; r < own.first + own.width; ++r)
      block[(r - own.first) * own.width] = f.work[r] / pivot;
    block += own.width * own.width;
    for (int r = 0; r < own.height; ++r) block[r * own.width] = f.work[f.row[own.rows + r]] / pivot;
  }
}

VOUSSOIR_FOR_EVERY_PROCESSOR
void LaneFactorisation::Kernel::substitute(const Kernel& kernel, DoubleLanes* x) {
  const Kernel f = kernel;
  for (int k = 0; k < f.n;) {  // a supernode at a time
    const Supernode s = f.supernodes[f.supernode_of[k]];
    const DoubleLanes* block = f.l + s.values;
    for (; k < s.first + s.width; ++k)
      for (int r = k + 1; r < s.first + s.width; ++r)
        x[r] -= block[(r - s.first) * s.width + k - s.first] * x[k];
    with_count(s.width, [&]<int kWidth>() VOUSSOIR_INLINE_WORK {
      update_rows<kWidth>(block + s.width * s.width, kWidth, f.row + s.rows, s.height, x + s.first, x);
    });
  }
  for (int i = f.supernode_of[f.n - 1]; i >= 0; --i) {
    const Supernode s = f.supernodes[i];
    with_count(s.width, [&]<int kWidth>() VOUSSOIR_INLINE_WORK {
      substitute_back<kWidth>(f.u + s.values, f.row + s.rows, s.height, f.pivot + s.first, x, x + s.first);
    });
  }
}

LaneFactorisation::LaneFactorisation(const Eigen::SparseMatrix<double>& pattern)
    : n_(static_cast<int>(pattern.rows())) {
  order(pattern);
  const std::vector<std::vector<int>> lower = find_fill(pattern);
  form_supernodes(lower);
  form_upper_parts();
  const auto n = static_cast<std::size_t>(n_);
  pivot_.resize(n);
  diagonal_.resize(n);
  work_.resize(n);
}

void LaneFactorisation::order(const Eigen::SparseMatrix<double>& pattern) {
  permutation_.resize(static_cast<std::size_t>(n_));
  position_.resize(static_cast<std::size_t>(n_));
  if (amd_order(n_, pattern.outerIndexPtr(), pattern.innerIndexPtr(), permutation_.data(), nullptr, nullptr) <
      AMD_OK)
    throw Failure("the ordering of the stiffness matrix failed: out of memory");
  for (int k = 0; k < n_; ++k)
    position_[static_cast<std::size_t>(permutation_[static_cast<std::size_t>(k)])] = k;
}

/// Symbolic factorisation: column k of L holds the lower part of column k of A and whatever its children in
/// the elimination tree hold below k.
std::vector<std::vector<int>> LaneFactorisation::find_fill(const Eigen::SparseMatrix<double>& pattern) {
  const auto n = static_cast<std::size_t>(n_);
  std::vector<std::vector<int>> lower(n);
  std::vector<std::vector<int>> children(n);
  a_begin_ = {0};
  for (std::size_t k = 0; k < n; ++k) {
    const int old = permutation_[k];
    for (int p = pattern.outerIndexPtr()[old]; p < pattern.outerIndexPtr()[old + 1]; ++p) {
      const int row = position_[static_cast<std::size_t>(pattern.innerIndexPtr()[p])];
      a_row_.push_back(row);
      a_slot_.push_back(p);
      if (row > static_cast<int>(k)) lower[k].push_back(row);
    }
    a_begin_.push_back(static_cast<int>(a_row_.size()));
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
void LaneFactorisation::form_supernodes(const std::vector<std::vector<int>>& lower) {
  int l_size = 0;
  for (int k = 0; k < n_;) {
    int end = k + 1;
    while (end < n_ && end - k < kWidest &&
           lower[static_cast<std::size_t>(end - 1)].size() ==
               lower[static_cast<std::size_t>(end)].size() + 1 &&
           lower[static_cast<std::size_t>(end - 1)].front() == end)
      ++end;
    const std::vector<int>& below = lower[static_cast<std::size_t>(end - 1)];
    const Supernode s{k, end - k, static_cast<int>(row_.size()), static_cast<int>(below.size()), l_size};
    row_.insert(row_.end(), below.begin(), below.end());
    l_size += s.width * (s.width + s.height);
    supernode_of_.insert(supernode_of_.end(), static_cast<std::size_t>(s.width),
                         static_cast<int>(supernodes_.size()));
    supernodes_.push_back(s);
    k = end;
  }
  l_.resize(static_cast<std::size_t>(l_size));
}

/// Column k of U: every supernode that reaches row k; columns of a supernode reach the same rows below it.
void LaneFactorisation::form_upper_parts() {
  std::vector<std::vector<UpperPart>> parts(static_cast<std::size_t>(n_));
  for (std::size_t i = 0; i < supernodes_.size(); ++i) {
    const Supernode& s = supernodes_[i];
    const auto reach = [&](int k, int row) {
      parts[static_cast<std::size_t>(k)].push_back({static_cast<int>(i), s.values + row * s.width});
    };
    for (int row = 1; row < s.width; ++row) reach(s.first + row, row);
    for (int r = 0; r < s.height; ++r) reach(row_[static_cast<std::size_t>(s.rows + r)], s.width + r);
  }
  upper_begin_ = {0};
  for (const auto& of_column : parts) {
    upper_.insert(upper_.end(), of_column.begin(), of_column.end());
    upper_begin_.push_back(static_cast<int>(upper_.size()));
  }
  u_.resize(l_.size());
}

std::array<bool, kLanes> LaneFactorisation::factorise(const LaneVector& values) {
  Kernel::factorise(Kernel(*this), registers_of(values));
  std::array<bool, kLanes> regular;
  regular.fill(true);
  for (std::size_t k = 0; k < pivot_.size(); ++k)
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      if (!(std::abs(pivot_[k].value[lane]) > kLostDigits * std::abs(diagonal_[k].value[lane])))
        regular[lane] = false;
  return regular;
}

void LaneFactorisation::solve(LaneVector& right_hand_side) {
  for (std::size_t k = 0; k < permutation_.size(); ++k)
    work_[k] = right_hand_side[static_cast<std::size_t>(permutation_[k])];
  Kernel::substitute(Kernel(*this), registers_of(work_));
  for (std::size_t k = 0; k < permutation_.size(); ++k)
    right_hand_side[static_cast<std::size_t>(permutation_[k])] = work_[k];
}

}  // namespace voussoir
