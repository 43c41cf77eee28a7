#pragma once
/// @file How long locate-damage takes as a whole process.

#include <filesystem>
#include <vector>

#include "lookup/lookup.h"
#include "tools/benchmarks/timing.h"

namespace voussoir {

/// Runs, in turn, a process that does nothing (the system's `true`) and locate-damage with several options on
/// simulated readings (written to a temporary file), each `runs` times, output thrown away.
/// Throws Failure if a program cannot be run or fails.
std::vector<Timing> time_processes(const std::filesystem::path& locate_damage,
                                   const std::filesystem::path& database, const Library& library, int runs);

}  // namespace voussoir
