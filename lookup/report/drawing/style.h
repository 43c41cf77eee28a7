#pragma once
/// @file The one style sheet of pictures and pages: light and dark, phone, A4.

#include <string>

namespace voussoir {

/// Series of a chart have one of this many colours (classes "s0", "s1"..).
inline constexpr int kSeriesColours = 6;

/// Colours and what pictures need.
std::string drawing_style();

/// What a page needs beside it.
std::string page_style();

/// The page's script: shows an element's tip beside the pointer, on touch as well.
std::string page_script();

}  // namespace voussoir
