#include "lookup/readings/library.h"

#include "database/records/state_name.h"

namespace voussoir {

Library library_of(const Database& database, std::size_t state) {
  return {
      database.table(kNominalVariant, state), database.control_points(), database.layout(),
      state == 0 || is_history(database.states().at(state)) ? database.search_index(state) : SearchIndex{}};
}

}  // namespace voussoir
