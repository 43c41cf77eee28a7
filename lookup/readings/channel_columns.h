#pragma once
/// @file Columns of a matrix by channel, of which most questions need the leading ones only.

#include <Eigen/Core>
#include <algorithm>
#include <memory>
#include <vector>

#include "database/records/stored_signals.h"

namespace voussoir {

/// Its own, or a file's, which are not read before they are asked for.
class ChannelColumns {
 public:
  ChannelColumns() = default;
  /// Channels x columns.
  explicit ChannelColumns(Eigen::MatrixXd own) : own_(std::move(own)) {}
  /// `factor` times what the file has at the channels' points.
  ChannelColumns(const StoredColumns& stored, std::shared_ptr<const std::vector<Eigen::Index>> points,
                 double factor)
      : stored_(stored), points_(std::move(points)), factor_(factor), in_order_(is_every_point()) {}

  Eigen::Index count() const { return points_ ? stored_.columns() : own_.cols(); }

  /// The leading ones, at most all. Throws InputError if the file has a number there that is not finite.
  Eigen::MatrixXd leading(Eigen::Index columns) const {
    if (!points_) return own_.leftCols(std::min(columns, count()));
    const StoredColumns::View stored = stored_.leading(columns);
    if (in_order_) return factor_ * stored;
    return factor_ * stored(*points_, Eigen::all);
  }
  Eigen::MatrixXd all() const { return leading(count()); }

  /// How many leading ones show, if columns come the largest variance first: those before the first whose
  /// variance, over all points and times how many are left, is below `least` [m2].
  Eigen::Index that_show(double least) const {
    Eigen::Index shown = 0;
    while (shown < count() && variance(shown) * static_cast<double>(count() - shown) >= least) ++shown;
    return shown;
  }

 private:
  /// As a rule, and then columns need not be put together number by number.
  bool is_every_point() const {
    Eigen::Index next = 0;
    return static_cast<Eigen::Index>(points_->size()) == stored_.points() &&
           std::all_of(points_->begin(), points_->end(), [&](Eigen::Index point) { return point == next++; });
  }
  double variance(Eigen::Index column) const {
    return points_ ? factor_ * factor_ * stored_.some(column, 1).squaredNorm()
                   : own_.col(column).squaredNorm();
  }

  Eigen::MatrixXd own_;
  StoredColumns stored_;
  std::shared_ptr<const std::vector<Eigen::Index>> points_;  ///< of the file's, by channel
  double factor_ = 1.0;
  bool in_order_ = false;  ///< channel i is the file's point i, and there are no others
};

}  // namespace voussoir
