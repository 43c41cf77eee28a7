#pragma once
/// @file The heap of a program.

namespace voussoir {

/// From now on memory that was freed stays with the program, which gains nothing from giving pages back to
/// the system only to ask for them again.
void keep_freed_memory();

}  // namespace voussoir
