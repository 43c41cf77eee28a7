#include "core/structure/model.h"

#include "core/structure/fill.h"
#include "core/structure/mortar_regions.h"
#include "core/structure/regions.h"

namespace voussoir {

Model with_nominal_parameters(Structure structure, const BridgeDescription& description) {
  Parameters parameters =
      uniform_parameters(structure, description.material, description.joints, description.gravity);
  if (!description.regions.empty()) set_regions(description, structure, parameters);
  lay_mortar(description, structure, parameters);
  if (description.fill.unit_weight > 0.0) parameters.laid_mass = fill_masses(description, structure);
  Model model{std::move(structure), std::move(parameters)};
  if (model.symmetry && !has_symmetric_parameters(model)) model.symmetry.reset();
  return model;
}

Model make_model(const BridgeDescription& description) {
  return with_nominal_parameters(make_structure(description), description);
}

Model with_parameters(Model bridge, Parameters parameters) {
  bridge.parameters = std::move(parameters);
  bridge.symmetry.reset();
  return bridge;
}

}  // namespace voussoir
