#pragma once
/// @file Datasets of names of fixed width, padded with zeros.

#include <string>
#include <vector>

#include "database/format/hdf5_file.h"

namespace voussoir {

/// Throws Failure for a name that is too long.
DatasetValue name_dataset(const char* path, const std::vector<std::string>& names, std::size_t width,
                          const char* meaning);

/// The names without their padding. Throws InputError unless there are names of this width.
std::vector<std::string> read_names(const Hdf5File& file, const char* path, std::size_t width);

}  // namespace voussoir
