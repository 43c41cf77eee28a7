#pragma once
/// @file Is it something that nobody stated, a line of levelling that is off or a load, that an answer calls
/// missing blocks?

#include "lookup/answer/fit.h"
#include "lookup/checks/question_context.h"

namespace voussoir {

/// A fit that explains nothing, with what may have acted, if with it others would be likely, too.
std::optional<Fit> check_lines_and_loads(const QuestionContext& asked, const Alarm& alarm);

/// In words, an error that a line of levelling shares, or a load, with which an intact bridge would show such
/// readings, if there may be one.
std::optional<std::string> line_or_load_that_explains(const QuestionContext& asked);

}  // namespace voussoir
