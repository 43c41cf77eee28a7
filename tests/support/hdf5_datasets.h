#pragma once
/// @file What the HDF5 library finds in a file: the oracle of our own reader.

#include <hdf5.h>

#include <string>
#include <vector>

namespace voussoir::test {

/// Paths "group/dataset" of all datasets as HDF5 visits them.
inline std::vector<std::string> dataset_paths(hid_t file) {
  std::vector<std::string> paths;
  H5Ovisit(
      file, H5_INDEX_NAME, H5_ITER_INC,
      [](hid_t, const char* name, const H5O_info_t* info, void* data) -> herr_t {
        if (info->type == H5O_TYPE_DATASET) static_cast<std::vector<std::string>*>(data)->emplace_back(name);
        return 0;
      },
      &paths);
  return paths;
}

}  // namespace voussoir::test
