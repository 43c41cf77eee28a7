#pragma once
/// @file HDF5 identifiers that close themselves. Only files of database/ include hdf5.h.

#include <hdf5.h>

#include <mutex>
#include <string>
#include <utility>

namespace voussoir {

class Hdf5Handle {
 public:
  using Closer = herr_t (*)(hid_t);

  Hdf5Handle() = default;
  Hdf5Handle(hid_t id, Closer closer) : id_(id), closer_(closer) {}
  ~Hdf5Handle() { close(); }
  Hdf5Handle(Hdf5Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), closer_(other.closer_) {}
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(closer_, other.closer_);
    return *this;
  }

  hid_t get() const { return id_; }
  explicit operator bool() const { return id_ >= 0; }

  /// False if HDF5 reports that closing failed (for a file: that not all of it could be written).
  bool close() {
    if (id_ < 0) return true;
    return closer_(std::exchange(id_, -1)) >= 0;
  }

 private:
  hid_t id_ = -1;
  Closer closer_ = nullptr;
};

/// HDF5 as Debian builds it is not thread-safe: whoever calls it holds this lock (which one thread may
/// take several times: a database may be read while another is written). Taking it for the first time turns
/// off HDF5's own error messages, its loading of plug-ins and its work at exit.
std::unique_lock<std::recursive_mutex> lock_hdf5();

/// The most specific message of HDF5's last error, or an empty text. Clears the error.
std::string last_hdf5_error();

}  // namespace voussoir
