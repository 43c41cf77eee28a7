#include "core/structure/fill.h"

#include "core/structure/top_surface.h"

namespace voussoir {

Eigen::VectorXd fill_masses(const BridgeDescription& description, const Structure& structure) {
  Eigen::VectorXd masses = Eigen::VectorXd::Zero(structure.mesh.node_count());
  if (description.gravity <= 0.0) return masses;
  const double per_area = description.fill.unit_weight / description.gravity * description.material.thickness;
  TopSurface(structure.mesh).add_soil(description.fill.surface, per_area, masses);
  return masses;
}

}  // namespace voussoir
