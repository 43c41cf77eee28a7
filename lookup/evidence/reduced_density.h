#pragma once
/// @file The density of one scene's readings in the directions of a screen.

#include "lookup/evidence/unknown_screen.h"

namespace voussoir {

/// What is the same for all scenes. Arrays are those of UnknownScreen.
struct ReducedQuestion {
  const double *reading, *points, *bridge, *others;
  ScatterLogs offset, offset_of_few;  ///< of all directions and of kFirstDirections
  double spread;
  // What rows of y are made of: channel, weight and, for each, its numbers in all directions.
  std::size_t rows;
  const std::size_t* channel;
  const double *after, *intact, *directions;
  double changed;  ///< rows of the second epoch
};

/// log p(readings | scene), kappa marginalised; any number below `least` if that is found on the way.
/// -infinity if the scene is impossible. `prediction`: the scene's row of the table; of its known losses
/// there is at least one, which may be that of nothing.
double reduced_log_density(const ReducedQuestion& question, const double* prediction,
                           std::span<const ReducedLoss* const> losses, double least);

}  // namespace voussoir
