#include "lookup/readings/millimetres.h"

#include "core/error.h"
#include "core/text.h"
#include "core/units.h"

namespace voussoir {

double parse_millimetres(std::string_view text, double least, double most) {
  std::string_view digits = text;
  for (const std::string_view unit : {"mm", "mm/m"})
    if (text.ends_with(unit)) digits = text.substr(0, text.size() - unit.size());
  const std::optional<double> number = parse_number(trimmed(digits));
  if (!number || *number < least || *number > most)
    throw InputError(fmt::format("{} given, expected millimetres from {:g} to {:g}, such as 0.02mm",
                                 in_quotes(text), least, most));
  return kMetresPerMillimetre * *number;
}

}  // namespace voussoir
