#include "database/records/record.h"

#include "database/format/field_codec.h"
#include "database/records/columns.h"

namespace voussoir {
namespace {

RecordedState make_state(const Solution& solution, const std::vector<ControlPoint>& points, KeepField keep) {
  RecordedState state;
  state.outcome = solution.outcome;
  state.residual = solution.residual;
  state.iterations = solution.iterations;
  state.extent = solution.extent;
  state.moving = solution.moving;
  state.origin = solution.origin;
  const Eigen::VectorXd vertical = readings_at(points, solution.displacement);
  state.vertical.assign(vertical.begin(), vertical.end());
  if (keep == KeepField::yes) {
    state.packed_field = pack_field(solution.displacement);
    state.field_crc = crc32_of(state.packed_field);
    state.slipped.assign(solution.slipped.data(), solution.slipped.data() + solution.slipped.size());
  }
  return state;
}

void add_counted(ByteView values, std::size_t width, Sha256Stream& hash) {
  const auto count = static_cast<std::uint32_t>(values.size() / width);
  hash.add(std::as_bytes(std::span(&count, 1)));
  hash.add(values);
}

}  // namespace

Record make_record(const RecordKey& key, std::span<const Solution> states,
                   const std::vector<ControlPoint>& points, KeepField keep, KeepField in_checksum) {
  Record record;
  record.key = key;
  std::vector<std::span<const double>> fields;
  for (const Solution& solution : states) {
    record.states.push_back(make_state(solution, points, keep));
    if (in_checksum == KeepField::yes) fields.push_back(numbers_of(solution.displacement));
  }
  record.checksum = scene_checksum(record, fields);
  return record;
}

Solution solution_of(const RecordedState& state, Field displacement) {
  Solution solution;
  solution.displacement = std::move(displacement);
  solution.outcome = state.outcome;
  solution.residual = state.residual;
  solution.iterations = state.iterations;
  solution.extent = state.extent;
  solution.moving = state.moving;
  solution.origin = state.origin;
  solution.slipped = Eigen::Map<const Eigen::Matrix2Xd>(state.slipped.data(), 2,
                                                        static_cast<Eigen::Index>(state.slipped.size() / 2));
  return solution;
}

Sha256 scene_checksum(const Record& record, std::span<const std::span<const double>> fields) {
  Sha256Stream hash;
  const auto states = static_cast<std::uint32_t>(record.states.size());
  hash.add(std::as_bytes(std::span(&states, 1)));
  for_each_column(record.states.size(), [&](const Column& column, std::size_t state) {
    if (!column.in_checksum || (column.optional && is_zero(column.values(record, state)))) return;
    if (column.form == Form::compressed && fields.empty()) return;
    if (column.form != Form::packed)
      add_counted(column.values(record, state), column.value_width, hash);
    else
      add_counted(fields.empty() ? ByteView{} : std::as_bytes(fields[state]), sizeof(double), hash);
  });
  return hash.finish();
}

}  // namespace voussoir
