#pragma once
/// @file Steps that make a finished file take the place of an old one in a single moment.

#include <filesystem>

namespace voussoir {

/// Waits until the file's content is on the disk, then gives it the name `target`, replacing a file of that
/// name, whose owner, group and mode it takes over as far as this process may. Whoever opens `target` finds
/// the old file or the new one, whole. Throws Failure.
void put_in_place(const std::filesystem::path& finished, const std::filesystem::path& target);

/// The file that the path leads to through symbolic links, whether it exists or not: replacing that one keeps
/// the links. Throws Failure for links that lead round in circles.
std::filesystem::path behind_links(std::filesystem::path path);

}  // namespace voussoir
