#include "lookup/readings/millimetres.h"

#include "core/error.h"
#include "core/text.h"
#include "core/units.h"

namespace voussoir {

double parse_millimetres(std::string_view text, double least, double most, std::string_view unit) {
  std::string_view digits = text;
  if (text.ends_with(unit)) digits.remove_suffix(unit.size());
  const std::optional<double> number = parse_number(trimmed(digits));
  if (!number || *number < least || *number > most)
    throw InputError(fmt::format("{} given, expected millimetres{} from {:g} to {:g}, such as 0.02{}",
                                 in_quotes(text), unit == "mm" ? "" : " per metre", least, most, unit));
  return kMetresPerMillimetre * *number;
}

}  // namespace voussoir
