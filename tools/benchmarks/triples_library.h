#pragma once
/// @file A library of all scenes with up to three missing blocks, made up from one with up to two: as many
/// rows as a database of triples has, without the hours that those take to be solved.

#include <vector>

#include "database/search/search_index.h"
#include "lookup/readings/library.h"

namespace voussoir {

class TriplesLibrary {
 public:
  /// Rows of fewer missing blocks are those of `pairs`, which outlives this. A triple's are what is left when
  /// what all three losses have in common is no more than what two have,
  ///
  ///     d_abc = d_ab + d_ac + d_bc - d_a - d_b - d_c + d_0,
  ///
  /// and none where one of these does not stand, of which only the outcome is known. The index is made anew.
  /// Throws Failure unless all singles and pairs are there, and nothing else.
  explicit TriplesLibrary(const Library& pairs);
  TriplesLibrary(const TriplesLibrary&) = delete;  // the table looks into the vectors
  TriplesLibrary& operator=(const TriplesLibrary&) = delete;

  const Library& library() const { return library_; }
  double seconds_of_index() const { return seconds_of_index_; }  ///< of processor time

 private:
  void add(std::span<const double> row, std::span<const std::int32_t> removed, std::uint8_t outcome);
  void add_triples(const Library& pairs);

  std::vector<double> vertical_;
  std::vector<std::int32_t> removed_;
  std::vector<std::uint8_t> outcome_;
  SearchIndexData index_;
  Library library_;
  double seconds_of_index_ = 0.0;
};

}  // namespace voussoir
