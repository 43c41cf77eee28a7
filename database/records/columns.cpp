#include "database/records/columns.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "core/error.h"
#include "database/records/schema.h"

namespace voussoir {
namespace {

using enum Extent;

bool exists(Outcome outcome) {
  return outcome <= Outcome::unresolved;
}
bool exists(CollapseExtent extent) {
  return extent <= CollapseExtent::arch;
}
bool exists(Origin origin) {
  return origin <= Origin::inherited;
}
template <class Number>
bool exists(Number) {
  return true;
}

template <PlainValue T>
ByteView bytes_of(const T& value) {
  return std::as_bytes(std::span(&value, 1));
}
template <class Values>
ByteView bytes_of(const Values& values) {
  return view_bytes(values);
}

template <PlainValue T>
bool assign(T& value, ByteView bytes) {
  if (bytes.size() != sizeof(T)) return false;
  std::memcpy(&value, bytes.data(), sizeof(T));
  return exists(value);
}
template <class T>
bool assign(std::vector<T>& values, ByteView bytes) {
  values.resize(bytes.size() / sizeof(T));
  if (!bytes.empty()) std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
  return bytes.size() % sizeof(T) == 0;
}
bool assign(Sha256& hash, ByteView bytes) {
  if (bytes.size() != hash.size()) return false;
  std::memcpy(hash.data(), bytes.data(), bytes.size());
  return true;
}

template <class T>
struct ValueOf {
  using Type = T;
};
template <class T>
struct ValueOf<std::vector<T>> {
  using Type = T;
};
template <>
struct ValueOf<Sha256> {
  using Type = std::uint8_t;
};

/// The type in the file of values that are a T in a record.
template <class T>
constexpr ElementType type_in_file(Form form) {
  if (form == Form::packed) return ElementType::float64;
  if (form == Form::marks) return ElementType::uint8;
  if (std::is_same_v<T, double>) return ElementType::float64;
  if (std::is_same_v<T, std::uint32_t>) return ElementType::uint32;
  return sizeof(T) == sizeof(std::int32_t) ? ElementType::int32 : ElementType::uint8;
}

constexpr bool kInChecksum = true;
constexpr bool kOptional = true;

/// `Place` is a captureless function from a record and the number of a state to the member that the column
/// holds.
template <class Place>
Column column(const char* path, std::vector<Extent> shape, Place place, Form form, bool in_checksum,
              const char* units, const char* meaning, bool optional = false) {
  Record example;
  example.states.resize(1);
  using T = typename ValueOf<std::remove_cvref_t<decltype(place(example, 0))>>::Type;
  return {path,
          std::move(shape),
          form,
          in_checksum,
          optional,
          units,
          meaning,
          type_in_file<T>(form),
          sizeof(T),
          [](const Record& record, std::size_t state) { return bytes_of(Place{}(record, state)); },
          [](Record& record, std::size_t state, ByteView bytes) {
            return assign(Place{}(record, state), bytes);
          }};
}

constexpr auto kVariantOf = [](auto& record, std::size_t) -> auto& {
  return record.key.variant;
};
constexpr auto kRemovedOf = [](auto& record, std::size_t) -> auto& {
  return record.key.scene.removed;
};
constexpr auto kChecksumOf = [](auto& record, std::size_t) -> auto& {
  return record.checksum;
};
template <auto Member>
constexpr auto kOfState = [](auto& record, std::size_t state) -> auto& {
  return record.states[state].*Member;
};

std::vector<Column> columns_of_record() {
  return {column(dataset::kVariant, {records}, kVariantOf, Form::plain, kInChecksum, "1",
                 "variant of the bridge (row of the datasets of `variants/`)"),
          column(dataset::kRemoved, {records, most_missing}, kRemovedOf, Form::padded, kInChecksum, "1",
                 "removed blocks (rows of `geometry/block_index`), ascending, then -1"),
          column(dataset::kChecksum, {records, checksum_bytes}, kChecksumOf, Form::plain, !kInChecksum, "1",
                 "SHA-256 of all that is kept of the record, see below")};
}

std::vector<Column> columns_of_state() {
  using State = RecordedState;
  return {
      column(dataset::kOutcome, {states, records}, kOfState<&State::outcome>, Form::plain, kInChecksum, "1",
             "0 standing, 1 collapsed, 2 unresolved"),
      column(dataset::kResidual, {states, records}, kOfState<&State::residual>, Form::plain, kInChecksum, "1",
             "as the solver left it: standing: largest unbalanced nodal force over the largest nodal "
             "weight; collapsed: sum of the blocks' resultant forces over the bridge's weight"),
      column(dataset::kIterations, {states, records}, kOfState<&State::iterations>, Form::plain, kInChecksum,
             "1", "linear systems solved, or time steps of a collapse"),
      column(dataset::kCollapse, {states, records}, kOfState<&State::extent>, Form::plain, kInChecksum, "1",
             "what moves away: 0 nothing, 1 wall blocks only, 2 blocks of the arch"),
      column(dataset::kMoving, {states, records, blocks}, kOfState<&State::moving>, Form::marks, kInChecksum,
             "1",
             "1 for each block that had moved so far when the collapse was decided that it counts as fallen, "
             "0 for all others"),
      column(dataset::kVertical, {states, records, points}, kOfState<&State::vertical>, Form::plain,
             kInChecksum, "m",
             "vertical displacement of the control points, up is positive; NaN where the block is gone"),
      column(dataset::kField, {states, records, nodes, components}, kOfState<&State::packed_field>,
             Form::packed, kInChecksum, "m", "ux, uy of each node; NaN in removed blocks"),
      column(dataset::kChunkCrc, {states, records}, kOfState<&State::field_crc>, Form::plain, !kInChecksum,
             "1", "CRC-32 (zlib's) of the field's compressed chunk as it stands in the file"),
      column(
          dataset::kSlipped, {states, records, joints, components}, kOfState<&State::slipped>,
          Form::compressed, kInChecksum, "m",
          "plastic slip at both ends of each joint with which a standing state's last step begins, as motion "
          "(`built`) or a jump (later states) has slid them; 0: none, or what the state before has left; "
          "missing if no state begins with any",
          kOptional),
      column(dataset::kOrigin, {states, records}, kOfState<&State::origin>, Form::plain, kInChecksum, "1",
             "0 solved, 1 composed, 2 inherited; missing if all are 0", kOptional)};
}

std::uint64_t size_of(Extent extent, const Sizes& sizes) {
  switch (extent) {
    case states:
      return sizes.states;
    case records:
      return sizes.records;
    case most_missing:
      return sizes.most_missing;
    case points:
      return sizes.points;
    case blocks:
      return sizes.blocks;
    case nodes:
      return sizes.nodes;
    case joints:
      return sizes.joints;
    case components:
      return 2;
    case checksum_bytes:
      break;
  }
  return sizeof(Sha256);
}

std::vector<std::int32_t> numbers_in(ByteView bytes) {
  std::vector<std::int32_t> numbers;
  assign(numbers, bytes);
  return numbers;
}

Bytes bytes_from(const std::vector<std::int32_t>& numbers) {
  const ByteView bytes = view_bytes(numbers);
  return {bytes.begin(), bytes.end()};
}

/// The numbers before the first -1; nothing if other numbers follow it.
std::optional<Bytes> without_padding(ByteView row) {
  std::vector<std::int32_t> numbers = numbers_in(row);
  const auto end = std::find(numbers.begin(), numbers.end(), kNoBlock);
  if (std::any_of(end, numbers.end(), [](std::int32_t number) { return number != kNoBlock; }))
    return std::nullopt;
  numbers.erase(end, numbers.end());
  return bytes_from(numbers);
}

std::optional<Bytes> marked_places(ByteView row) {
  std::vector<std::int32_t> places;
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (row[i] > std::byte{1}) return std::nullopt;
    if (row[i] == std::byte{1}) places.push_back(static_cast<std::int32_t>(i));
  }
  return bytes_from(places);
}

}  // namespace

bool Column::of_fields() const {
  return std::string_view(path).starts_with("fields/");
}

const std::vector<Column>& record_columns() {
  static const std::vector<Column> columns = [] {
    std::vector<Column> all = columns_of_record();
    std::ranges::move(columns_of_state(), std::back_inserter(all));
    return all;
  }();
  return columns;
}

const Column& column_at(const char* path) {
  return *std::ranges::find_if(
      record_columns(), [path](const Column& column) { return std::string_view(column.path) == path; });
}

std::vector<std::uint64_t> shape_of(const Column& column, const Sizes& sizes) {
  std::vector<std::uint64_t> shape;
  for (const Extent extent : column.shape) shape.push_back(size_of(extent, sizes));
  return shape;
}

bool is_zero(ByteView values) {
  return std::ranges::all_of(values, [](std::byte value) { return value == std::byte{0}; });
}

std::size_t row_size(const Column& column, const Sizes& sizes) {
  std::size_t size = width_of(column.type);
  for (const Extent extent : column.shape)
    if (extent != states && extent != records) size *= size_of(extent, sizes);
  return size;
}

Eigen::Index pairs_in_row(const Column& column, const Sizes& sizes) {
  return static_cast<Eigen::Index>(row_size(column, sizes) / (2 * sizeof(double)));
}

void write_row(const Column& column, ByteView values, std::span<std::byte> row) {
  const auto require = [&](bool fits) {
    if (!fits) throw std::logic_error(fmt::format("{}: values that do not fit into a row", column.path));
  };
  if (column.form == Form::marks) {
    for (const std::int32_t place : numbers_in(values)) {
      require(place >= 0 && static_cast<std::size_t>(place) < row.size());
      row[static_cast<std::size_t>(place)] = std::byte{1};
    }
    return;
  }
  require(column.form == Form::padded ? values.size() <= row.size() : values.size() == row.size());
  const auto rest = std::copy(values.begin(), values.end(), row.begin());
  std::fill(rest, row.end(), std::byte{0xff});  // every byte of -1
}

std::optional<Bytes> read_row(const Column& column, ByteView row) {
  if (column.form == Form::padded) return without_padding(row);
  if (column.form == Form::marks) return marked_places(row);
  return Bytes(row.begin(), row.end());
}

}  // namespace voussoir
