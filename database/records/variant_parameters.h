#pragma once
/// @file The parameters of a bridge's variants as a database file holds them.

#include <cstdint>
#include <optional>
#include <vector>

#include "core/structure/parameters.h"
#include "database/format/hdf5_file.h"

namespace voussoir {

/// One variant's parameters: of every block (row of geometry/block_index) and of every joint (row of
/// geometry/joint_blocks).
struct VariantParameters {
  std::vector<double> young_modulus;         ///< [Pa], of blocks
  std::vector<double> poisson_ratio;         ///< [-], of blocks
  std::vector<double> density;               ///< [kg/m3], of blocks
  std::vector<double> normal_stiffness;      ///< [Pa/m], of joints
  std::vector<double> tangential_stiffness;  ///< [Pa/m], of joints
  std::vector<double> friction_coefficient;  ///< [-], of joints

  friend bool operator==(const VariantParameters&, const VariantParameters&) = default;
};

/// The number of the variant that has these parameters, if there is one.
std::optional<std::int32_t> find_variant(const std::vector<VariantParameters>& variants,
                                         const VariantParameters& parameters);

/// The parameters of every block and every joint as a file holds them.
VariantParameters variant_parameters(const Parameters& parameters);

/// One dataset for each parameter, variants x blocks or variants x joints; a bridge without joints has none
/// of joints. Precondition: at least one variant, and all of the same bridge.
std::vector<DatasetValue> parameter_datasets(const std::vector<VariantParameters>& variants);

/// How many variants the file has. Throws InputError if it does not say.
std::size_t read_variant_count(const Hdf5File& file);

/// Throws InputError if the datasets' sizes do not fit together.
std::vector<VariantParameters> read_parameters(const Hdf5File& file, std::size_t blocks, std::size_t joints);

}  // namespace voussoir
