#include "lookup/readings/comparison.h"

namespace voussoir {

Comparison absolute_readings(Library library, Measurements measured) {
  return {.library = std::move(library), .measured = std::move(measured), .model_error = {}};
}

}  // namespace voussoir
