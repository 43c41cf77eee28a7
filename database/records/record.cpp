#include "database/records/record.h"

#include "database/format/field_codec.h"

namespace voussoir {

Record make_record(const Scene& scene, const Solution& solution, const std::vector<ControlPoint>& points,
                   KeepField keep, KeepField in_checksum) {
  Record record;
  record.scene = scene;
  record.outcome = solution.outcome;
  record.residual = solution.residual;
  record.iterations = solution.iterations;
  record.extent = solution.extent;
  record.moving = solution.moving;
  const Eigen::VectorXd vertical = vertical_displacements(solution.displacement, points);
  record.vertical.assign(vertical.begin(), vertical.end());
  const std::span field(solution.displacement.data(), static_cast<std::size_t>(solution.displacement.size()));
  if (keep == KeepField::yes) record.packed_field = pack_field(solution.displacement);
  record.checksum = scene_checksum(record, in_checksum == KeepField::yes ? field : std::span<const double>{});
  return record;
}

Solution solution_of(const Record& record, Field displacement) {
  Solution solution;
  solution.displacement = std::move(displacement);
  solution.outcome = record.outcome;
  solution.residual = record.residual;
  solution.iterations = record.iterations;
  solution.extent = record.extent;
  solution.moving = record.moving;
  return solution;
}

Sha256 scene_checksum(const Record& record, std::span<const double> field) {
  ByteWriter head;
  head.put(kOnlyVariant);
  head.put(static_cast<std::int32_t>(record.scene.removed.size()));
  head.put_bytes(view_bytes(record.scene.removed));
  head.put(record.outcome);
  head.put(record.residual);
  head.put(record.iterations);
  head.put(record.extent);
  head.put(static_cast<std::int32_t>(record.moving.size()));
  head.put_bytes(view_bytes(record.moving));
  head.put_bytes(view_bytes(record.vertical));
  Sha256Stream hash;
  hash.add(head.bytes());
  hash.add(std::as_bytes(field));
  return hash.finish();
}

}  // namespace voussoir
