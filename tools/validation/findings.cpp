#include "tools/validation/findings.h"

namespace voussoir::validation {

Case absolute_case(Case known, double tolerance, std::string reason) {
  known.error = std::abs(known.computed - known.expected);
  known.tolerance = tolerance;
  known.reason = std::move(reason);
  return known;
}

Case relative_case(Case known, double tolerance, std::string reason) {
  Case result = absolute_case(std::move(known), tolerance, std::move(reason));
  result.error /= std::abs(result.expected);
  return result;
}

Case comparison(Case known, std::string reason) {
  Case result = relative_case(std::move(known), 0.0, std::move(reason));
  result.tolerance.reset();
  return result;
}

}  // namespace voussoir::validation
