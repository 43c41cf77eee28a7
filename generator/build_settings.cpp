#include "generator/build_settings.h"

#include <fmt/format.h>

#include "database/field_codec.h"

namespace voussoir {
namespace {

constexpr const char* kMirrorUsed = "mirror_images = used\n";
constexpr const char* kMirrorNotUsed = "mirror_images = not used\n";

}  // namespace

std::string build_settings(const SolverChoice& solver, const Bridge& bridge, UseMirror mirror) {
  const bool used = mirror == UseMirror::yes && bridge.symmetry.has_value();
  return solver.settings + (used ? kMirrorUsed : kMirrorNotUsed) +
         fmt::format("storage_step_m = {}\n", kStorageStep);
}

UseMirror mirror_use_in(const std::string& settings) {
  return settings.find(kMirrorUsed) == std::string::npos ? UseMirror::no : UseMirror::yes;
}

}  // namespace voussoir
