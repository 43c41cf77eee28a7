#pragma once
/// @file Many matrices of one size, one after the other and each row by row, as they stand in a file.

#include <Eigen/Core>
#include <vector>

#include "database/records/stored_numbers.h"

namespace voussoir {

/// Looks into a file, or keeps its own numbers.
class StackedMatrices {
 public:
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  using View = Eigen::Map<const RowMajor>;

  StackedMatrices() = default;
  /// Its own: zeros.
  StackedMatrices(std::size_t count, Eigen::Index rows, Eigen::Index columns)
      : rows_(rows), columns_(columns), own_(count * static_cast<std::size_t>(rows * columns), 0.0) {}
  /// Those of a file: whole ones.
  StackedMatrices(StoredNumbers stored, Eigen::Index rows, Eigen::Index columns)
      : rows_(rows), columns_(columns), stored_(std::move(stored)) {}

  Eigen::Index rows() const { return rows_; }
  Eigen::Index columns() const { return columns_; }
  std::span<const double> numbers() const { return own_.empty() ? stored_.all() : std::span(own_); }

  /// One of them. Throws InputError if the file has a number there that is not finite. Precondition: it
  /// exists.
  View operator[](std::size_t i) const {
    const auto one = numbers().subspan(i * size(), size());
    if (own_.empty()) stored_.require_finite(one);
    return {one.data(), rows_, columns_};
  }

  /// One of its own.
  Eigen::Map<RowMajor> own(std::size_t i) { return {own_.data() + i * size(), rows_, columns_}; }

 private:
  std::size_t size() const { return static_cast<std::size_t>(rows_ * columns_); }

  Eigen::Index rows_ = 0;
  Eigen::Index columns_ = 0;
  std::vector<double> own_;
  StoredNumbers stored_;
};

}  // namespace voussoir
