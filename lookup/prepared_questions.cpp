#include "lookup/prepared_questions.h"

namespace voussoir {

Answer PreparedQuestions::ask(const Comparison& comparison, const LookupSettings& settings) {
  if (comparison.library.storage != nullptr) return locate_damage(comparison, settings);
  const bool known = counts_as_known(comparison, settings);
  return locate_damage(comparison, settings, *prepared(comparison.library, settings, known));
}

std::shared_ptr<const Preparation> PreparedQuestions::prepared(const Library& library,
                                                               const LookupSettings& settings, bool known) {
  const std::scoped_lock lock(mutex_);
  std::shared_ptr<const Preparation>& found = by_table_[{library.table.vertical.data(), known}];
  if (!found) found = std::make_shared<const Preparation>(library, settings, known);
  return found;
}

}  // namespace voussoir
