#pragma once
/// @file What would explain readings of a bridge that is not exactly known, and has no part in its posterior:
/// then the answer means nothing.

#include "lookup/answer/fit.h"
#include "lookup/checks/question_context.h"

namespace voussoir {

/// A fit that explains nothing, with the reason, if there is one: where blocks are said to be missing a
/// single reading that is grossly wrong (check_gross_errors), so that others would be likely, too; losses of
/// blocks that are read all the same, which would be likely, too; where blocks are said to be missing, an
/// error that a line of levelling shares or a load that stood on the bridge, not stated, with which others
/// would be likely; sizes that cannot be (check_sizes); falls that show just what the database has of them,
/// which would be likely, too; and, where blocks are said to be missing, errors that are larger than stated,
/// which would be far likelier. Precondition: some scene is likely.
std::optional<Fit> find_other(const QuestionContext& asked);

}  // namespace voussoir
