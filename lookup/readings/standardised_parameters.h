#pragma once
/// @file How far a variant's parameters are from the nominal bridge's, in the standard deviations that the
/// bridge file states: parameters_at backwards.

#include "core/structure/uncertain_parameters.h"
#include "database/records/variant_parameters.h"

namespace voussoir {

/// One number for each uncertain parameter of the bridge. The common factor of all stiffnesses and the
/// joints' own can stand for each other: the common one takes their mean, as far as it is uncertain. What is
/// not uncertain is not looked at. Precondition: both have the blocks and joints of the structure that the
/// parameters are of.
Eigen::VectorXd standardised_parameters(const UncertainParameters& uncertain,
                                        const VariantParameters& nominal, const VariantParameters& variant);

}  // namespace voussoir
