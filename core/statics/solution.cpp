#include "core/statics/solution.h"

namespace voussoir {

std::string_view to_string(Outcome outcome) {
  switch (outcome) {
    case Outcome::standing:
      return "standing";
    case Outcome::collapsed:
      return "collapsed";
    case Outcome::unresolved:
      break;
  }
  return "unresolved";
}

std::string_view to_string(Origin origin) {
  switch (origin) {
    case Origin::composed:
      return "composed";
    case Origin::inherited:
      return "inherited";
    case Origin::solved:
      break;
  }
  return "solved";
}

}  // namespace voussoir
