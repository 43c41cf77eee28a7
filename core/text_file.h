#pragma once
/// @file Whole texts from and to disk.

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace voussoir {

/// The whole text of a file. Throws InputError naming the file and what was `expected` if it cannot be opened
/// or is larger than `largest` bytes.
std::string read_text(const std::filesystem::path& file, std::size_t largest, const std::string& expected);

/// What is written must not take the place of what is read, of a database or of a bridge file, and be what
/// its name says. Throws InputError naming the file, after the option that gave it, if it is one of `read`
/// or, being there already, HDF5 or TOML, or if its name has none of the `endings` (none given: any will do).
void check_output(const std::string& option, const std::filesystem::path& file,
                  const std::vector<std::string>& endings, std::span<const std::filesystem::path> read = {});

/// Gives a file owner, group and mode of another one that it is to take the place of, as far as this process
/// may: who may not give files away keeps this one, but for others of the same group. Nothing if there is no
/// other.
void take_over_access(const std::filesystem::path& from, const std::filesystem::path& to);

/// Writes a whole text to a file; what it had is kept until all is written. Throws Failure naming the file
/// and the reason if it cannot be written.
void write_file(const std::filesystem::path& file, const std::string& text);

}  // namespace voussoir
