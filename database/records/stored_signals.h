#pragma once
/// @file What losses change in the derivatives, in all states and in the form in which a question about a
/// bridge that is not exactly known needs it (signal_factors.h), as a database keeps it: to read some columns
/// of every loss takes a fraction of the time that making them takes. It follows from the sensitivities and
/// says nothing new.

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "database/records/signal_factors.h"
#include "database/records/stored_numbers.h"

namespace voussoir {

struct Sensitivities;

/// A matrix, points x columns, that lies column by column in the mapped file. Refers to its dataset.
class StoredColumns {
 public:
  using View = Eigen::Map<const Eigen::MatrixXd>;

  StoredColumns() = default;
  StoredColumns(const StoredNumbers& dataset, std::size_t first, std::size_t columns, std::size_t points);

  Eigen::Index points() const { return points_; }
  Eigen::Index columns() const { return columns_; }
  /// In place; others are not touched. Throws InputError if one of their numbers is not finite.
  View some(Eigen::Index first, Eigen::Index count) const;
  View leading(Eigen::Index count) const { return some(0, std::min(count, columns_)); }
  View all() const { return some(0, columns_); }

 private:
  const StoredNumbers* dataset_ = nullptr;
  std::size_t begin_ = 0;
  Eigen::Index columns_ = 0;
  Eigen::Index points_ = 0;
};

/// Refers to the file.
class StoredSignals {
 public:
  /// Throws InputError unless the datasets are of `losses` losses at so many points, with so many leading
  /// columns and parameters of an epoch.
  StoredSignals(const Hdf5File& file, std::size_t losses, std::size_t points, std::size_t leading,
                std::size_t of_epoch);

  /// Of one loss. Where nothing is known B and H have no columns, and the others are zero.
  struct Columns {
    StoredColumns own;     ///< B
    StoredColumns intact;  ///< H
    StoredColumns lead;    ///< the leading columns of D
    StoredColumns epoch;   ///< what it changes in E
  };
  /// Losses have numbers state after state, in each one for every scene of the sensitivities.
  Columns operator[](std::size_t loss) const;

 private:
  std::span<const std::int32_t> first_;        // columns of B and H, by loss
  StoredNumbers own_, intact_, lead_, epoch_;  // columns x points
  std::size_t points_, leading_, of_epoch_;
};

/// Nothing if the file has none.
std::optional<StoredSignals> read_signals(const Hdf5File& file, std::size_t losses, std::size_t points,
                                          std::size_t leading, std::size_t of_epoch);

/// What is stored of sensitivities. The same ones always give the same bytes.
std::vector<DatasetValue> signal_datasets(const Sensitivities& sensitivities);

/// Whether signals are those of the sensitivities that they were read with, which need to have some: of B and
/// H the products that they are kept for (B B^T and H B^T) are compared. Throws InputError if a number is not
/// finite.
bool are_signals_right(const Sensitivities& sensitivities);

}  // namespace voussoir
