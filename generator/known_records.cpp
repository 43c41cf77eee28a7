#include "generator/known_records.h"

#include "core/error.h"
#include "database/format/field_codec.h"

namespace voussoir {

const RecordSource* KnownRecords::source_of(const RecordKey& key) const {
  if (journal_.contains(key)) return &journal_;
  for (const auto& source : others_)
    if (source->contains(key)) return source.get();
  return nullptr;
}

bool KnownRecords::contains(const RecordKey& key) const {
  return source_of(key) != nullptr;
}

Record KnownRecords::read(const RecordKey& key) const {
  return source_of(key)->read(key);
}

Solution KnownRecords::read_solution(const RecordKey& key, Eigen::Index nodes) const {
  const RecordedState state = read(key).states.at(0);
  auto field = unpack_field(state.packed_field, nodes);
  if (!field) throw Failure(fmt::format("{}: holds a damaged field; delete it", journal_.path().string()));
  return solution_of(state, std::move(*field));
}

}  // namespace voussoir
