#pragma once
/// @file The evidence of every scene of a table.

#include <cstddef>
#include <vector>

#include "database/records/database.h"
#include "lookup/evidence/row_values.h"
#include "lookup/readings/observation.h"

namespace voussoir {

/// log p(readings | scene), a value for each of the given rows (in ascending order), with an unknown noise
/// level, an automatic noise shape and nuisances marginalised. -infinity for impossible scenes (a reading on
/// a block that the scene lacks; without a model error also one beyond a uniform noise's bound), with an
/// unknown level perhaps for scenes less likely than the likeliest by exp(50). A silent sensor on a block
/// that the scene has counts with the chance of its failing. Throws InputError if no reading is at a point
/// that can move.
std::vector<double> log_evidence_of_each(const Observation& observation, const SceneTable& table,
                                         std::span<const std::size_t> rows);

/// The same as values of the table's rows, -infinity for those that are not given.
RowValues log_evidence_of_rows(const Observation& observation, const SceneTable& table,
                               std::vector<std::size_t> rows);

/// The noise's shapes that are possible, equally likely beforehand.
std::vector<NoiseShape> shapes_of(const NoiseModel& noise);

/// The same in groups that share their sums, bounded errors last: they take longest.
std::vector<std::vector<NoiseShape>> groups_of(const NoiseModel& noise);

/// [-] where the noise's level is not unknown.
double stated_level(const Observation& observation);

/// True if the evidence over an unknown level has a closed form.
bool has_closed_form(const Observation& observation);

/// log of the chance, in each of the given rows, that the silent sensors are silent: certain on missing
/// blocks, the noise model's `silence` on the others; and that those are read that are held and tell no more:
/// impossible on missing blocks.
std::vector<double> log_chance_of_silence(const Observation& observation, const SceneTable& table,
                                          std::span<const std::size_t> rows);

/// What the readings say of the noise if one scene is the truth.
struct NoiseEstimate {
  NoiseShape shape = NoiseShape::uniform;  ///< the likeliest of the model's shapes
  double level = 0.0;                      ///< [-] as stated, or the likeliest
  bool estimated = false;                  ///< the level was unknown
  double floor = 0.0;                      ///< [m] as stated beside the level
};
NoiseEstimate estimate_noise(const Observation& observation, std::span<const double> prediction);

}  // namespace voussoir
