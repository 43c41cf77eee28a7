#pragma once
/// @file The search index as datasets, one index for each history's own state.

#include <span>
#include <string>

#include "database/format/hdf5_file.h"
#include "database/search/search_index.h"

namespace voussoir {

/// Names of the index's datasets in its group.
namespace index_dataset {
inline constexpr char kExponent[] = "exponent";
inline constexpr char kCoarseness[] = "coarseness";
inline constexpr char kFirst[] = "first";
inline constexpr char kCentre[] = "centre";
inline constexpr char kLeast[] = "least";
inline constexpr char kMost[] = "most";
inline constexpr char kRow[] = "row";
inline constexpr char kBounds[] = "bounds";
inline constexpr char kSketch[] = "sketch";
}  // namespace index_dataset

/// The path of a dataset of a state's index: "search_built/row".
std::string index_path(const std::string& state, const char* name);

/// What is stored of a state for rows of `points` displacements [m] (not empty): the same rows always give
/// the same bytes. Nothing if no row has displacements: then there is nothing to search.
std::vector<DatasetValue> search_datasets(const std::string& state, std::span<const double> rows,
                                          std::size_t points);

/// The index of a state with these rows of `points` displacements, in place in the file; one of no slots if
/// no row has any and the file has no index. Throws InputError unless no row is in it twice and all numbers
/// are such that no sum of them overflows. Whether they are the right ones is for verify-database.
SearchIndex read_search_index(const Hdf5File& file, const std::string& state, std::span<const double> rows,
                              std::size_t points);

}  // namespace voussoir
