#pragma once
/// @file Which of many scenes are worth another look.

#include <span>
#include <vector>

namespace voussoir {

/// Of these places, in their order, those that are left when the smallest values below `stays` are taken away
/// whose exponentials sum up to exp(log_rest) at most: as many as a histogram of the values shows, which
/// counts none as smaller than it is. NaN and infinity stay, -infinity never does.
std::vector<std::size_t> likely_places(std::span<const std::size_t> places, std::span<const double> values,
                                       double log_rest, double stays);

/// The same of all places.
std::vector<std::size_t> likely_places(std::span<const double> values, double log_rest, double stays);

}  // namespace voussoir
