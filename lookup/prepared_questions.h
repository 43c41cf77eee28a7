#pragma once
/// @file Questions to one database that share what does not depend on their readings.

#include <map>
#include <memory>
#include <mutex>

#include "lookup/lookup.h"

namespace voussoir {

/// All questions have the same settings but for the noise, and come from any number of threads.
class PreparedQuestions {
 public:
  /// locate_damage; what is prepared is shared by all questions to a table of the database itself.
  Answer ask(const Comparison& comparison, const LookupSettings& settings);

 private:
  std::shared_ptr<const Preparation> prepared(const Library& library, const LookupSettings& settings,
                                              bool known);

  std::mutex mutex_;
  std::map<std::pair<const double*, bool>, std::shared_ptr<const Preparation>> by_table_;
};

}  // namespace voussoir
