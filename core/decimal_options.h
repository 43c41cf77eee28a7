#pragma once
/// @file Whole numbers on command lines are decimal, whoever wrote them with zeros before.

#include <string>

#include "core/text.h"

namespace voussoir {

/// The library that reads command lines takes 010 for eight and 0x10 for sixteen: such texts are refused for
/// all options of the application (CLI::App) that take whole numbers.
template <class App>
void expect_decimal_numbers(App& app) {
  for (auto* const option : app.get_options()) {
    if (!option->get_type_name().starts_with("INT") && !option->get_type_name().starts_with("UINT")) continue;
    option->check([](const std::string& text) {
      const std::size_t first = text.find_first_not_of("+-");
      const bool is_octal = first != std::string::npos && text[first] == '0' && first + 1 < text.size();
      return is_octal ? in_quotes(text) + " given, expected a decimal number without zeros before it" : "";
    });
  }
}

}  // namespace voussoir
