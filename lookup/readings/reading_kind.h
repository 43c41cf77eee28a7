#pragma once
/// @file What readings are the difference of.

namespace voussoir {

enum class ReadingKind {
  absolute,    ///< displacement since the bridge carried nothing: the paper's
  change,      ///< between two epochs under the bridge's own weight
  load,        ///< what a load case adds
  load_change  ///< how much more it adds in the second of two epochs
};

constexpr bool is_change(ReadingKind kind) {
  return kind == ReadingKind::change || kind == ReadingKind::load_change;
}

constexpr bool is_loaded(ReadingKind kind) {
  return kind == ReadingKind::load || kind == ReadingKind::load_change;
}

/// Of how many levellings a reading is the difference: one in each epoch, or two, with the load and without.
constexpr int levellings(ReadingKind kind) {
  return (is_change(kind) ? 2 : 1) * (is_loaded(kind) ? 2 : 1);
}

}  // namespace voussoir
