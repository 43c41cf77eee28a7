#pragma once
/// @file How far a database's own numbers are off, measured when it was built: its signals against those of a
/// finer mesh.

#include <vector>

#include "database/format/hdf5_file.h"

namespace voussoir {

/// Of one state. The error of a scene's signal s = d - d(intact) at point i has the standard deviation
///     sqrt((share s_i)^2 + (common rms(s))^2),
/// rms over the points that the scene has; that of the intact bridge's displacement is `intact[i]`.
struct ModelError {
  double share = 0.0;          ///< [-]
  double common = 0.0;         ///< [-]
  std::vector<double> intact;  ///< [m] at each control point; empty: zero

  friend bool operator==(const ModelError&, const ModelError&) = default;
};

/// The datasets of the model errors of so many states at so many points; those that are left out are zero.
std::vector<DatasetValue> model_error_datasets(std::vector<ModelError> errors, std::size_t states,
                                               std::size_t points);

/// One for each state. Throws InputError for wrong sizes and for numbers that are negative or not finite.
std::vector<ModelError> read_model_errors(const Hdf5File& file, std::size_t states, std::size_t points);

}  // namespace voussoir
