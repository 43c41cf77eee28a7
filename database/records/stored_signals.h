#pragma once
/// @file The signal factors (signal_factors.h) of all losses in all states, as a database keeps them: a
/// question about a bridge that is not exactly known needs those of every loss, and to read them takes a
/// fraction of the time that making them takes. They follow from the sensitivities and say nothing new.

#include <cstdint>
#include <optional>
#include <vector>

#include "database/records/signal_factors.h"
#include "database/records/stored_numbers.h"

namespace voussoir {

struct Sensitivities;

/// Refers to the file.
class StoredSignals {
 public:
  /// Throws InputError unless the datasets are of `losses` losses at so many points.
  StoredSignals(const Hdf5File& file, std::size_t losses, std::size_t points);

  /// B and H: points x columns, in place.
  using View = Eigen::Map<const Eigen::MatrixXd>;
  struct Views {
    View own, intact;
  };
  /// Of the loss with this number: state after state, in each a number for each scene of the sensitivities.
  /// Without columns where they know nothing. Throws InputError if a number is not finite.
  Views operator[](std::size_t loss) const;

 private:
  std::span<const std::int32_t> first_;  // columns, by loss
  StoredNumbers own_, intact_;           // columns x points
  std::size_t points_;
};

/// Nothing if the file has none.
std::optional<StoredSignals> read_signals(const Hdf5File& file, std::size_t losses, std::size_t points);

/// What is stored of sensitivities. The same ones always give the same bytes.
std::vector<DatasetValue> signal_datasets(const Sensitivities& sensitivities);

/// Whether signals are those of the sensitivities that they were read with, which need to have some: the
/// products that they are kept for (B B^T and H B^T) are compared. Throws InputError if a number is not
/// finite.
bool are_signals_right(const Sensitivities& sensitivities);

}  // namespace voussoir
