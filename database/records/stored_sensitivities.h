#pragma once
/// @file Sensitivities as a file keeps them.

#include <optional>
#include <vector>

#include "database/format/dataset_value.h"
#include "database/format/hdf5_file.h"
#include "database/records/sensitivities.h"

namespace voussoir {

/// The datasets of sensitivities, which outlive them; datasets that would have no elements are left out.
std::vector<DatasetValue> sensitivity_datasets(const Sensitivities& sensitivities);

/// How many of everything there are in a file.
struct SensitivitySizes {
  std::size_t states = 0;
  std::size_t points = 0;
  std::size_t blocks = 0;
};

/// Nothing if the file has none. Throws InputError for wrong types, shapes and sizes, scenes that are out of
/// order or without an intact bridge, and numbers that are not finite, but for the factors, which are looked
/// at when they are asked for.
std::optional<Sensitivities> read_sensitivities(const Hdf5File& file, const SensitivitySizes& sizes);

}  // namespace voussoir
