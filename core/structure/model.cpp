#include "core/structure/model.h"

#include "core/structure/mortar_regions.h"

namespace voussoir {

Model with_nominal_parameters(Structure structure, const BridgeDescription& description) {
  Parameters parameters =
      uniform_parameters(structure, description.material, description.joints, description.gravity);
  lay_mortar(description, structure, parameters);
  return {std::move(structure), std::move(parameters)};
}

Model make_model(const BridgeDescription& description) {
  return with_nominal_parameters(make_structure(description), description);
}

}  // namespace voussoir
