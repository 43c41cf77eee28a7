#pragma once
/// @file Changes that show the model turned round: the two times were taken for each other, or what is down
/// counts as up.

#include <optional>

#include "lookup/answer/fit.h"
#include "lookup/checks/asked_readings.h"

namespace voussoir {

/// A fit that explains nothing, with the reason, if a known bridge does not show these changes well and with
/// the opposite sign they would be a thousand times as likely: with them as they are no block is missing, and
/// a loss that they show is not seen. Null if there is nothing to say against them. `chance`: of the fit as
/// it is. Of a bridge that is not exactly known see check_sizes.
std::optional<Fit> check_signs(const AskedReadings& asked, double chance);

}  // namespace voussoir
