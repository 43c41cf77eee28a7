#include "core/structure/loads.h"

#include "core/error.h"
#include "core/structure/top_surface.h"

namespace voussoir {
namespace {

Field standing_load(const LoadDescription& load, const TopSurface& top, double share, int nodes) {
  Field force = Field::Zero(2, nodes);
  for (const PointLoad& point : load.points) top.add_force(point.x, share * point.force, force);
  for (const LineLoad& line : load.lines)
    top.add_line(line.from_x, line.to_x, share * line.force_per_length, force);
  return force;
}

void add_vehicle(const LoadDescription& load, double place, double share, const TopSurface& top,
                 Field& force) {
  for (const Axle& axle : load.axles)
    if (top.is_under(place - axle.at)) top.add_force(place - axle.at, share * axle.force, force);
}

/// One for each name.
std::vector<Field> stage_forces(const LoadDescription& load, const Structure& structure, double thickness) {
  const TopSurface top(structure.mesh);
  const double share = thickness / load.width.value_or(thickness);
  const Field standing = standing_load(load, top, share, structure.mesh.node_count());
  std::vector<Field> forces;
  for (const double place : load.places) add_vehicle(load, place, share, top, forces.emplace_back(standing));
  if (load.places.empty()) forces.push_back(standing);
  if (load.unload) forces.push_back(Field::Zero(2, structure.mesh.node_count()));
  return forces;
}

}  // namespace

std::vector<std::string> stage_names(const LoadDescription& load) {
  std::vector<std::string> names;
  if (load.places.size() < 2) names.push_back(load.name);
  for (std::size_t step = 1; load.places.size() > 1 && step <= load.places.size(); ++step)
    names.push_back(fmt::format("{}@{}", load.name, step));
  if (load.unload) names.push_back(load.name + "@off");
  return names;
}

std::vector<LoadStage> load_stages(const LoadDescription& load, const Structure& structure,
                                   double thickness) {
  const std::vector<std::string> names = stage_names(load);
  std::vector<LoadStage> stages;
  try {
    for (Field& force : stage_forces(load, structure, thickness))
      stages.push_back({names[stages.size()], std::move(force)});
  } catch (const InputError& error) {
    throw InputError(fmt::format("load case '{}': {}", load.name, error.what()));
  }
  return stages;
}

}  // namespace voussoir
