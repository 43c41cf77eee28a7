#pragma once
/// @file What bad input is refused with.

#include <string>

#include "core/error.h"

namespace voussoir::test {

/// The message of the InputError that the work throws, or "accepted".
template <class Work>
std::string refusal_of(const Work& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace voussoir::test
