#pragma once
/// @file FLANN's trees of k-means clusters over rows of displacements, kept in the database so that a query
/// need not make them.

#include <memory>
#include <span>
#include <vector>

#include "database/format/bytes.h"

namespace voussoir {

/// The same rows [m] always give the same bytes. NaN: no displacement; trees take the first row's there.
Bytes build_nearest_trees(std::span<const double> rows, std::size_t points);

/// A neighbour by its row, and how far it is: the sum of absolute differences where there is a reading.
struct Neighbour {
  std::size_t row;
  double distance;
};

class NearestTrees {
 public:
  /// Stored trees over the rows that they were made of, which must outlive them; only the `wanted` rows (in
  /// ascending order) can be found. Throws InputError if the bytes are damaged or belong to other rows.
  NearestTrees(ByteView stored, std::span<const double> rows, std::size_t points,
               std::span<const std::size_t> wanted);
  ~NearestTrees();
  NearestTrees(NearestTrees&&) noexcept;
  NearestTrees& operator=(NearestTrees&&) noexcept;

  /// About the `count` nearest rows, nearest first, after a look at about `checks` rows. NaN: no reading.
  /// Rows that lack a displacement where there is a reading are infinitely far and left out.
  std::vector<Neighbour> nearest(std::span<const double> readings, std::size_t count, int checks) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace voussoir
