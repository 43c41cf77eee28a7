#pragma once
/// @file The heap of a program.

namespace voussoir {

/// From now on memory that was freed stays with the program, which gains nothing from giving pages back to
/// the system only to ask for them again. And the heap begins where a large page may begin, and grows at once
/// to what a lookup needs, in large pages where there are any.
void prepare_heap();

/// All threads take memory from the program's heap, instead of each from one of its own that grows page by
/// page. Quicker for one question, slower for many side by side. Before there are threads.
void share_heap();

}  // namespace voussoir
