#include "lookup/readings/library.h"

namespace voussoir {

Library library_of(const Database& database, std::size_t state) {
  return {database.table(kNominalVariant, state), database.control_points(), database.layout(),
          state == 0 ? database.search_index() : SearchIndex{}};
}

}  // namespace voussoir
