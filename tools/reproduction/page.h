#pragma once
/// @file The whole reproduction: experiments, chapters, page and CSV files.

#include <filesystem>
#include <string>
#include <vector>

#include "tools/reproduction/subject.h"

namespace voussoir {

/// Runs all experiments and lays out what they give. Throws InputError for cases that the bridge does not
/// have, Failure for scenes that the database lacks.
std::vector<Chapter> reproduce(const Subject& subject);

/// The page, complete in itself.
std::string reproduction_page(const Subject& subject, const std::vector<Chapter>& chapters);

/// Writes index.html, and a CSV file for every figure and table, into a folder, which is made if needed.
void write_reproduction(const Subject& subject, const std::vector<Chapter>& chapters,
                        const std::filesystem::path& folder);

}  // namespace voussoir
