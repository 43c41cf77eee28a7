#pragma once
/// @file Is it one reading alone that says what an answer calls missing?

#include "lookup/answer/fit.h"
#include "lookup/checks/question_context.h"

namespace voussoir {

/// A fit that explains nothing, with the reading, if a single one, or all that is read on one block, may be
/// grossly wrong: if that were so, others would be likely, too.
std::optional<Fit> check_gross_errors(const QuestionContext& asked, const Alarm& alarm);

}  // namespace voussoir
