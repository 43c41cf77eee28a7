#pragma once
/// @file The evidence over an unknown noise level where errors do not grow with the level alone: absolute
/// parts, the model's own error, nuisances, Student's t. Levels are gone through where they matter.

#include <vector>

#include "lookup/evidence/level_likelihood.h"
#include "lookup/evidence/level_rule.h"

namespace voussoir {

/// The level at which the readings are likeliest, under the first of the shapes, for the likeliest of these
/// rows, to a quarter of an octave. For a few rows: many levels are tried with each of them.
double likeliest_level(const Observation& observation, Shapes shapes, const SceneTable& table,
                       std::span<const std::size_t> rows);

/// The same of many rows: with those that are likeliest by their estimates.
double likeliest_level_of_all(const Observation& observation, Shapes shapes, const SceneTable& table,
                              std::span<const std::size_t> rows);

/// Share of the levels' range that a row's likelihood fills: log of what its peak has to be multiplied by.
double log_width(NoiseShape shape, std::size_t count);

/// For each shape log of the mean of p(readings | scene, level) over levels with a density uniform in log
/// level between kSmallestLevel and kLargestLevel, for each of these rows. `level` is where the readings are
/// likeliest for the best of them; rows that are less likely than that by exp(30) may be off.
std::vector<std::vector<double>> evidence_over_levels(const Observation& observation, Shapes shapes,
                                                      double level, const SceneTable& table,
                                                      std::span<const std::size_t> rows,
                                                      LevelRule rule = LevelRule::fine);

/// log of the factor beyond which a scene's probability is taken for zero.
inline constexpr double kHopeless = 50.0;

}  // namespace voussoir
