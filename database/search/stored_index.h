#pragma once
/// @file The search index as datasets of search/.

#include "database/format/hdf5_file.h"
#include "database/search/search_index.h"

namespace voussoir {

/// Paths of the index's datasets.
namespace dataset {
inline constexpr char kIndexExponent[] = "search/exponent";
inline constexpr char kIndexCoarseness[] = "search/coarseness";
inline constexpr char kIndexFirst[] = "search/first";
inline constexpr char kIndexCentre[] = "search/centre";
inline constexpr char kIndexLeast[] = "search/least";
inline constexpr char kIndexMost[] = "search/most";
inline constexpr char kIndexRow[] = "search/row";
inline constexpr char kIndexBounds[] = "search/bounds";
inline constexpr char kIndexSketch[] = "search/sketch";
}  // namespace dataset

/// What is stored for rows of `points` displacements [m] (not empty): the same rows always give the same
/// bytes.
std::vector<DatasetValue> search_datasets(std::span<const double> rows, std::size_t points);

/// The index of so many rows and points, in place in the file. Throws InputError unless every row is in it
/// once and all numbers are such that no sum of them overflows. Whether they are the right ones is for
/// verify-database.
SearchIndex read_search_index(const Hdf5File& file, std::size_t rows, std::size_t points);

}  // namespace voussoir
