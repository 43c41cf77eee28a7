#include "database/format/hdf5_handle.h"

namespace voussoir {
namespace {

extern "C" herr_t keep_description(unsigned, const H5E_error2_t* error, void* text) {
  if (error->desc != nullptr) *static_cast<std::string*>(text) = error->desc;
  return 0;
}

/// HDF5 is not shut down at exit either: after a write that failed (disk full) its shutdown works on a file
/// already freed and crashes, and everything that matters has been closed by then.
bool quieten() {
  H5dont_atexit();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  return H5PLset_loading_state(0) >= 0;
}

}  // namespace

std::unique_lock<std::recursive_mutex> lock_hdf5() {
  static std::recursive_mutex mutex;
  std::unique_lock lock(mutex);
  static const bool quiet = quieten();
  static_cast<void>(quiet);
  return lock;
}

std::string last_hdf5_error() {
  std::string text;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, keep_description, &text);
  H5Eclear2(H5E_DEFAULT);
  return text;
}

}  // namespace voussoir
