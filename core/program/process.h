#pragma once
/// @file What a program has to put right of the process that it is before it opens any file.

namespace voussoir {

/// A limit on the size of files becomes an error of writing, as a full disk is, not the end by a signal; a
/// file that somebody shortens while it is read in place (mmap) ends the program with a message and 1; and
/// standard streams that whoever started the program has closed are opened on nothing, or the first file that
/// is opened would get what is said.
void prepare_process();

}  // namespace voussoir
