#include "database/format/hdf5_writing.h"

#include <array>
#include <cerrno>
#include <cstring>

namespace voussoir {
namespace {

constexpr hsize_t kAlignment = 8;  ///< [bytes] so that a mapped dataset can be read as doubles in place

Hdf5Handle make_text_type(std::size_t width) {
  Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.get(), width);
  H5Tset_strpad(type.get(), H5T_STR_NULLPAD);
  H5Tset_cset(type.get(), H5T_CSET_UTF8);
  return type;
}

Hdf5Handle make_type(const DatasetValue& value) {
  switch (value.type) {
    case ElementType::float64:
      return {H5Tcopy(H5T_IEEE_F64LE), H5Tclose};
    case ElementType::int32:
      return {H5Tcopy(H5T_STD_I32LE), H5Tclose};
    case ElementType::int16:
      return {H5Tcopy(H5T_STD_I16LE), H5Tclose};
    case ElementType::int8:
      return {H5Tcopy(H5T_STD_I8LE), H5Tclose};
    case ElementType::uint8:
      return {H5Tcopy(H5T_STD_U8LE), H5Tclose};
    case ElementType::uint32:
      return {H5Tcopy(H5T_STD_U32LE), H5Tclose};
    case ElementType::text:
      return make_text_type(value.text_width);
  }
  return {};
}

Hdf5Handle make_space(const std::vector<std::uint64_t>& shape) {
  const std::vector<hsize_t> extents(shape.begin(), shape.end());
  if (extents.empty()) return {H5Screate(H5S_SCALAR), H5Sclose};
  return {H5Screate_simple(static_cast<int>(extents.size()), extents.data(), nullptr), H5Sclose};
}

/// How groups and datasets are made. Time stamps would make the bytes of equal databases differ; attributes
/// and links stay in the object header, where the reader looks for them, however many there are.
Hdf5Handle plain_object(hid_t property_class) {
  constexpr unsigned kMostInHeader = 1000;
  Hdf5Handle properties(H5Pcreate(property_class), H5Pclose);
  H5Pset_obj_track_times(properties.get(), false);
  H5Pset_attr_phase_change(properties.get(), kMostInHeader, 0);
  if (property_class != H5P_DATASET_CREATE) H5Pset_link_phase_change(properties.get(), kMostInHeader, 0);
  return properties;
}

Hdf5Handle create_file(const std::filesystem::path& path) {
  errno = 0;
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_libver_bounds(access.get(), H5F_LIBVER_V110, H5F_LIBVER_V110);  // all metadata carries checksums
  H5Pset_alignment(access.get(), 1, kAlignment);
  H5Pset_file_locking(access.get(), false, true);
  const Hdf5Handle creation = plain_object(H5P_FILE_CREATE);
  return {H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.get(), access.get()), H5Fclose};
}

}  // namespace

Hdf5Output::Hdf5Output(const std::filesystem::path& path) : path_(path), file_(create_file(path)) {
  check(static_cast<bool>(file_), "cannot be created");
}

/// Each public member begins with errno = 0: a number that stands there is of this call, not of an older one.
void Hdf5Output::check(bool ok, const std::string& what) const {
  if (ok) return;
  const std::string reason = errno != 0 ? std::strerror(errno) : last_hdf5_error();
  throw Failure(fmt::format("{}: {}: {}", path_.string(), what, reason));
}

void Hdf5Output::add_text_attribute(const char* name, const std::string& text) {
  errno = 0;
  const Hdf5Handle type = make_text_type(std::max<std::size_t>(text.size(), 1));
  const Hdf5Handle space = make_space({});
  const Hdf5Handle made(H5Acreate2(file_.get(), name, type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT),
                        H5Aclose);
  check(made && H5Awrite(made.get(), type.get(), text.c_str()) >= 0, "cannot be written");
}

void Hdf5Output::add_int_attribute(const char* name, int number) {
  errno = 0;
  const Hdf5Handle space = make_space({});
  const std::int32_t value = number;
  const Hdf5Handle made(H5Acreate2(file_.get(), name, H5T_STD_I32LE, space.get(), H5P_DEFAULT, H5P_DEFAULT),
                        H5Aclose);
  check(made && H5Awrite(made.get(), H5T_STD_I32LE, &value) >= 0, "cannot be written");
}

void Hdf5Output::describe(const Hdf5Handle& object, const std::string& units, const std::string& meaning) {
  for (const auto& [name, text] : {std::pair{"units", units}, std::pair{"meaning", meaning}}) {
    const Hdf5Handle type = make_text_type(std::max<std::size_t>(text.size(), 1));
    const Hdf5Handle space = make_space({});
    const Hdf5Handle made(H5Acreate2(object.get(), name, type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT),
                          H5Aclose);
    check(made && H5Awrite(made.get(), type.get(), text.c_str()) >= 0, "cannot be written");
  }
}

void Hdf5Output::ensure_group(const std::string& dataset_path) {
  const std::string group = dataset_path.substr(0, dataset_path.find('/'));
  if (H5Lexists(file_.get(), group.c_str(), H5P_DEFAULT) > 0) return;
  const Hdf5Handle creation = plain_object(H5P_GROUP_CREATE);
  const Hdf5Handle made(H5Gcreate2(file_.get(), group.c_str(), H5P_DEFAULT, creation.get(), H5P_DEFAULT),
                        H5Gclose);
  check(static_cast<bool>(made), "cannot be written");
}

void Hdf5Output::add_dataset(const DatasetValue& value) {
  errno = 0;
  ensure_group(value.path);
  const Hdf5Handle type = make_type(value);
  const Hdf5Handle space = make_space(value.shape);
  const Hdf5Handle creation = plain_object(H5P_DATASET_CREATE);
  const Hdf5Handle made(H5Dcreate2(file_.get(), value.path.c_str(), type.get(), space.get(), H5P_DEFAULT,
                                   creation.get(), H5P_DEFAULT),
                        H5Dclose);
  const bool written =
      made && H5Dwrite(made.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, value.content().data()) >= 0;
  check(written, "cannot be written");
  describe(made, value.units, value.meaning);
}

Hdf5Handle Hdf5Output::add_field_dataset(const DatasetValue& value) {
  errno = 0;
  ensure_group(value.path);
  const Hdf5Handle type = make_type(value);
  const Hdf5Handle space = make_space(value.shape);
  const Hdf5Handle creation = plain_object(H5P_DATASET_CREATE);
  const std::array<hsize_t, 4> chunk = {1, 1, value.shape.at(2), value.shape.at(3)};
  H5Pset_chunk(creation.get(), chunk.size(), chunk.data());
  H5Pset_shuffle(creation.get());
  H5Pset_deflate(creation.get(), 1);
  Hdf5Handle made(H5Dcreate2(file_.get(), value.path.c_str(), type.get(), space.get(), H5P_DEFAULT,
                             creation.get(), H5P_DEFAULT),
                  H5Dclose);
  check(static_cast<bool>(made), "cannot be written");
  describe(made, value.units, value.meaning);
  return made;
}

void Hdf5Output::add_chunk(const Hdf5Handle& field_dataset, std::uint64_t state, std::uint64_t row,
                           ByteView packed) {
  errno = 0;
  const std::array<hsize_t, 4> offset = {state, row, 0, 0};
  constexpr std::uint32_t kAllFilters = 0;
  check(H5Dwrite_chunk(field_dataset.get(), H5P_DEFAULT, kAllFilters, offset.data(), packed.size(),
                       packed.data()) >= 0,
        "cannot be written");
}

void Hdf5Output::add_field_view(const std::string& name, const std::string& database, const char* path,
                                const std::vector<std::uint64_t>& shape, std::uint64_t row) {
  errno = 0;
  const std::uint64_t nodes = shape.at(2);
  const Hdf5Handle source = make_space(shape);
  const Hdf5Handle view = make_space({nodes, 3});
  const std::array<hsize_t, 4> source_start = {0, row, 0, 0};
  const std::array<hsize_t, 4> source_count = {1, 1, nodes, 2};
  const std::array<hsize_t, 2> view_start = {0, 0};
  const std::array<hsize_t, 2> view_count = {nodes, 2};
  H5Sselect_hyperslab(source.get(), H5S_SELECT_SET, source_start.data(), nullptr, source_count.data(),
                      nullptr);
  H5Sselect_hyperslab(view.get(), H5S_SELECT_SET, view_start.data(), nullptr, view_count.data(), nullptr);
  const Hdf5Handle creation = plain_object(H5P_DATASET_CREATE);
  H5Pset_virtual(creation.get(), view.get(), database.c_str(), path, source.get());
  H5Sselect_all(view.get());
  const Hdf5Handle made(H5Dcreate2(file_.get(), name.c_str(), H5T_IEEE_F64LE, view.get(), H5P_DEFAULT,
                                   creation.get(), H5P_DEFAULT),
                        H5Dclose);
  check(static_cast<bool>(made), "cannot be written");
}

void Hdf5Output::close() {
  errno = 0;
  check(H5Fflush(file_.get(), H5F_SCOPE_GLOBAL) >= 0, "cannot be written");
  check(file_.close(), "cannot be written");
}

}  // namespace voussoir
