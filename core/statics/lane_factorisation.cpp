#include "core/statics/lane_factorisation.h"

#include <algorithm>
#include <cmath>

namespace voussoir {
namespace {

/// A pivot this small against its diagonal entry has lost all its digits.
constexpr double kLostDigits = 1e-13;

/// work[row] -= sum_c l(row, c) factor[c] for the rows below a supernode; `l` points at the first column
/// used.
template <int Count, class Number, class Work>
VOUSSOIR_INLINE void update_rows(const Number* __restrict l, int stride, const int* __restrict rows,
                                 int height, const Work* __restrict factor, Work* __restrict work) {
  Work f[Count];
  for (int c = 0; c < Count; ++c) f[c] = factor[c];
  for (int r = 0; r < height; ++r, l += stride) {
    Work value = work[rows[r]];
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
template <int Width, class Number>
VOUSSOIR_INLINE void substitute_back(const Number* __restrict u, const int* __restrict rows, int height,
                                     const Number* __restrict pivot, const DoubleLanes* __restrict x,
                                     DoubleLanes* __restrict own) {
  DoubleLanes sum[Width];
  for (int c = 0; c < Width; ++c) sum[c] = own[c];
  const Number* row = u + (Width + height) * Width;
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

VOUSSOIR_INLINE bool is_zero(const DoubleLanes* x, int count) {
  DoubleMask other = {};
  for (int i = 0; i < count; ++i) other |= x[i] != DoubleLanes{};
  return !any(other);
}

/// What the arithmetic works on, as plain pointers.
template <class Number>
struct Parts {
  int n;
  const int* a_begin;
  const int* a_row;
  const int* a_slot;
  const Supernode* supernodes;
  const int* supernode_of;
  const int* row;
  const int* upper_begin;
  const UpperPart* upper;
  Number* l;
  Number* u;
  Number* pivot;
  Number* diagonal;
  Number* work;
};

template <class Number>
Parts<Number> parts_of(const SymbolicFactorisation& symbolic, Factors<Number>& factors) {
  return {symbolic.n,
          symbolic.a_begin.data(),
          symbolic.a_row.data(),
          symbolic.a_slot.data(),
          symbolic.supernodes.data(),
          symbolic.supernode_of.data(),
          symbolic.row.data(),
          symbolic.upper_begin.data(),
          symbolic.upper.data(),
          registers_of(factors.l),
          registers_of(factors.u),
          registers_of(factors.pivot),
          registers_of(factors.diagonal),
          registers_of(factors.work)};
}

/// Left-looking: column k of A minus the earlier columns of L times column k of U.
template <class Number>
VOUSSOIR_INLINE void eliminate(const Parts<Number>& parts, const Number* values) {
  const Parts<Number> f = parts;
  for (int k = 0; k < f.n; ++k) {
    const Supernode own = f.supernodes[f.supernode_of[k]];
    for (int c = own.first; c < own.first + own.width; ++c) f.work[c] = Number{};
    for (int r = 0; r < own.height; ++r) f.work[f.row[own.rows + r]] = Number{};
    for (int p = f.upper_begin[k]; p < f.upper_begin[k + 1]; ++p) {
      const Supernode& s = f.supernodes[f.upper[p].supernode];
      for (int c = s.first; c < s.first + s.width; ++c) f.work[c] = Number{};
    }
    for (int p = f.a_begin[k]; p < f.a_begin[k + 1]; ++p) f.work[f.a_row[p]] = values[f.a_slot[p]];
    f.diagonal[k] = f.work[k];

    for (int p = f.upper_begin[k]; p < f.upper_begin[k + 1]; ++p) {
      const UpperPart part = f.upper[p];
      const Supernode s = f.supernodes[part.supernode];
      const int end = std::min(s.first + s.width, k);
      const Number* block = f.l + s.values;  // rows and columns of the supernode
      for (int c = s.first; c < end; ++c) {
        const Number factor = f.work[c];
        f.u[part.values + c - s.first] = factor;
        for (int r = c + 1; r < s.first + s.width; ++r)
          f.work[r] -= block[(r - s.first) * s.width + c - s.first] * factor;
      }
      with_count(end - s.first, [&]<int kCount>() VOUSSOIR_INLINE_WORK {
        update_rows<kCount>(block + s.width * s.width, s.width, f.row + s.rows, s.height, f.u + part.values,
                            f.work);
      });
    }

    const Number pivot = f.work[k];
    f.pivot[k] = pivot;
    Number* block = f.l + own.values + k - own.first;
    for (int r = k + 1; r < own.first + own.width; ++r)
      block[(r - own.first) * own.width] = f.work[r] / pivot;
    block += own.width * own.width;
    for (int r = 0; r < own.height; ++r) block[r * own.width] = f.work[f.row[own.rows + r]] / pivot;
  }
}

/// A reading of one place is zero in most rows, and stays so forward wherever nothing of it arrives.
template <class Number>
VOUSSOIR_INLINE void substitute_in(const Parts<Number>& parts, DoubleLanes* x) {
  const Parts<Number> f = parts;
  for (int k = 0; k < f.n;) {  // a supernode at a time
    const Supernode s = f.supernodes[f.supernode_of[k]];
    const Number* block = f.l + s.values;
    if (is_zero(x + k, s.width)) {
      k += s.width;
      continue;
    }
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

// Overloads: the compiler clones no templates.
VOUSSOIR_FOR_EVERY_PROCESSOR
void factorise_on(const Parts<DoubleLanes>& parts, const DoubleLanes* values) {
  eliminate(parts, values);
}
VOUSSOIR_FOR_EVERY_PROCESSOR
void factorise_on(const Parts<double>& parts, const double* values) {
  eliminate(parts, values);
}
VOUSSOIR_FOR_EVERY_PROCESSOR
void substitute(const Parts<DoubleLanes>& parts, DoubleLanes* x) {
  substitute_in(parts, x);
}
VOUSSOIR_FOR_EVERY_PROCESSOR
void substitute(const Parts<double>& parts, DoubleLanes* x) {
  substitute_in(parts, x);
}

}  // namespace

template <class Number>
PatternFactorisation<Number>::PatternFactorisation(const Eigen::SparseMatrix<double>& pattern)
    : symbolic_(symbolic_factorisation(pattern)) {
  const auto n = static_cast<std::size_t>(symbolic_.n), values = static_cast<std::size_t>(symbolic_.values);
  factors_.l.resize(values);
  factors_.u.resize(values);
  factors_.pivot.resize(n);
  factors_.diagonal.resize(n);
  factors_.work.resize(n);
  sides_.resize(n);
}

template <class Number>
std::array<bool, kLaneCount<Number>> PatternFactorisation<Number>::factorise(const Cells<Number>& values) {
  factorise_on(parts_of(symbolic_, factors_), registers_of(values));
  std::array<bool, kLaneCount<Number>> regular;
  regular.fill(true);
  for (std::size_t k = 0; k < factors_.pivot.size(); ++k)
    for (int i = 0; i < kLaneCount<Number>; ++i)
      if (!(std::abs(lane(factors_.pivot[k].value, i)) >
            kLostDigits * std::abs(lane(factors_.diagonal[k].value, i))))
        regular[static_cast<std::size_t>(i)] = false;
  return regular;
}

template <class Number>
void PatternFactorisation<Number>::solve(LaneVector& right_hand_sides) {
  for (std::size_t k = 0; k < symbolic_.permutation.size(); ++k)
    sides_[k] = right_hand_sides[static_cast<std::size_t>(symbolic_.permutation[k])];
  substitute(parts_of(symbolic_, factors_), registers_of(sides_));
  for (std::size_t k = 0; k < symbolic_.permutation.size(); ++k)
    right_hand_sides[static_cast<std::size_t>(symbolic_.permutation[k])] = sides_[k];
}

template class PatternFactorisation<DoubleLanes>;
template class PatternFactorisation<double>;

}  // namespace voussoir
