#pragma once
/// @file Numbers of a dataset, in place in the mapped file and not looked at before they are used.

#include <Eigen/Core>
#include <span>
#include <string>

#include "core/error.h"
#include "database/format/hdf5_file.h"

namespace voussoir {

class StoredNumbers {
 public:
  StoredNumbers() = default;
  /// Throws InputError unless the dataset has just this shape. Looks into the file, which outlives this.
  StoredNumbers(const Hdf5File& file, const char* path, const std::vector<std::uint64_t>& shape)
      : name_(fmt::format("{}: dataset '{}'", file.path().string(), path)) {
    const ByteView bytes = file.array(path, ElementType::float64, shape);
    all_ = {reinterpret_cast<const double*>(bytes.data()), bytes.size() / sizeof(double)};
  }

  std::span<const double> all() const { return all_; }

  /// Throws InputError, which names file and dataset, if one of these, which are some of all, is not finite.
  void require_finite(std::span<const double> some) const {
    const Eigen::Map<const Eigen::ArrayXd> all(some.data(), static_cast<Eigen::Index>(some.size()));
    if ((all * 0.0).sum() != 0.0)  // only finite numbers times zero are zero
      throw InputError(name_ + " holds a number that is not finite");
  }

 private:
  std::string name_;
  std::span<const double> all_;
};

}  // namespace voussoir
