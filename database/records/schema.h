#pragma once
/// @file The schema in one place: names, version, and the datasets that all records share. database/README.md
/// explains it to readers.

#include <string>
#include <vector>

#include "core/structure/block_limits.h"
#include "core/structure/model.h"
#include "core/structure/sensor_description.h"
#include "database/format/dataset_value.h"
#include "database/records/model_error.h"
#include "database/records/provenance.h"
#include "database/records/sensitivities.h"
#include "database/records/variant_parameters.h"

namespace voussoir {

inline constexpr char kFormatName[] = "voussoir database";
/// What the first dataset says of itself: a damaged file is known by it.
inline constexpr char kBridgeTextMeaning[] = "the bridge file (TOML) as it was given";
inline constexpr int kSchemaVersion = 7;
inline constexpr std::size_t kBlockLabelWidth = kLongestLabel + 1;  ///< bytes, padded with zeros
inline constexpr std::size_t kPointNameWidth = kLongestSensorName;  ///< bytes, padded with zeros
inline constexpr std::size_t kStateNameWidth = 32;                  ///< bytes, padded with zeros
inline constexpr std::size_t kParameterNameWidth = 80;              ///< bytes, padded with zeros
inline constexpr std::size_t kUnitWidth = 8;                        ///< bytes, padded with zeros

inline constexpr std::int32_t kNoBlock = -1;  ///< in the place of a block's number

/// Paths of datasets.
namespace dataset {
inline constexpr char kBridgeText[] = "bridge/text";
inline constexpr char kSolverSettings[] = "solver/settings";
inline constexpr char kBlockIndex[] = "geometry/block_index";
inline constexpr char kBlockLabel[] = "geometry/block_label";
inline constexpr char kBlockRole[] = "geometry/block_role";
inline constexpr char kBlockRing[] = "geometry/block_ring";
inline constexpr char kBlockKind[] = "geometry/block_kind";
inline constexpr char kBlockTopCourse[] = "geometry/block_top_course";
inline constexpr char kCorners[] = "geometry/corners";
inline constexpr char kBlockCorners[] = "geometry/block_corners";
inline constexpr char kNodes[] = "geometry/nodes";
inline constexpr char kBlockNodes[] = "geometry/block_nodes";
inline constexpr char kTriangles[] = "geometry/triangles";
inline constexpr char kBlockTriangles[] = "geometry/block_triangles";
inline constexpr char kEdges[] = "geometry/edges";
inline constexpr char kBlockEdges[] = "geometry/block_edges";
inline constexpr char kJointBlocks[] = "geometry/joint_blocks";
inline constexpr char kJointNodes[] = "geometry/joint_nodes";
inline constexpr char kJointEnds[] = "geometry/joint_ends";
inline constexpr char kJointLength[] = "geometry/joint_length";
inline constexpr char kPointName[] = "control/point_name";
inline constexpr char kPointPosition[] = "control/point_position";
inline constexpr char kPointBlock[] = "control/point_block";
inline constexpr char kPointNode[] = "control/point_node";
inline constexpr char kPointQuantity[] = "control/point_quantity";
inline constexpr char kPointOtherBlock[] = "control/point_other_block";
inline constexpr char kWeightPoint[] = "control/weight_point";
inline constexpr char kWeightNode[] = "control/weight_node";
inline constexpr char kWeight[] = "control/weight";
inline constexpr char kStates[] = "history/states";
inline constexpr char kErrorShare[] = "model_error/share";
inline constexpr char kErrorCommon[] = "model_error/common";
inline constexpr char kErrorIntact[] = "model_error/intact";
inline constexpr char kUncertainName[] = "sensitivity/parameter_name";
inline constexpr char kUncertainUnit[] = "sensitivity/parameter_unit";
inline constexpr char kUncertainSigma[] = "sensitivity/parameter_sigma";
inline constexpr char kUncertainOfEpoch[] = "sensitivity/parameter_of_epoch";
inline constexpr char kSensitivityBasis[] = "sensitivity/basis";
inline constexpr char kSensitivityRemoved[] = "sensitivity/removed";
inline constexpr char kSensitivityKnown[] = "sensitivity/known";
inline constexpr char kStandingShare[] = "sensitivity/standing_share";
inline constexpr char kIfStanding[] = "sensitivity/if_standing";
inline constexpr char kBridgeFactors[] = "sensitivity/bridge_factors";
inline constexpr char kEpochFactors[] = "sensitivity/epoch_factors";
inline constexpr char kResidualBridge[] = "sensitivity/residual_bridge";
inline constexpr char kResidualEpoch[] = "sensitivity/residual_epoch";
inline constexpr char kResidualShare[] = "sensitivity/residual_share";
inline constexpr char kSignalLeft[] = "sensitivity/residual_signal";
inline constexpr char kUnevenness[] = "sensitivity/unevenness";
inline constexpr char kLoadPlace[] = "sensitivity/load_place";
inline constexpr char kLoadInfluence[] = "sensitivity/load_influence";
inline constexpr char kSignals[] = "signals";
inline constexpr char kSignalFirst[] = "signals/first";
inline constexpr char kSignalOwn[] = "signals/own";
inline constexpr char kSignalIntact[] = "signals/intact";
inline constexpr char kSignalLead[] = "signals/lead";
inline constexpr char kSignalEpoch[] = "signals/epoch";
inline constexpr char kShard[] = "shard/statement";
inline constexpr char kYoungModulus[] = "variants/young_modulus";
inline constexpr char kPoissonRatio[] = "variants/poisson_ratio";
inline constexpr char kDensity[] = "variants/density";
inline constexpr char kNormalStiffness[] = "variants/normal_stiffness";
inline constexpr char kTangentialStiffness[] = "variants/tangential_stiffness";
inline constexpr char kFriction[] = "variants/friction_coefficient";
inline constexpr char kVertical[] = "control/vertical_displacement";
inline constexpr char kVariant[] = "scenes/variant";
inline constexpr char kRemoved[] = "scenes/removed";
inline constexpr char kOutcome[] = "scenes/outcome";
inline constexpr char kResidual[] = "scenes/residual";
inline constexpr char kIterations[] = "scenes/iterations";
inline constexpr char kCollapse[] = "scenes/collapse";
inline constexpr char kMoving[] = "scenes/moving";
inline constexpr char kChecksum[] = "scenes/checksum";
inline constexpr char kOrigin[] = "scenes/origin";
inline constexpr char kField[] = "fields/displacement";
inline constexpr char kSlipped[] = "fields/slipped";
inline constexpr char kChunkCrc[] = "fields/chunk_crc32";
}  // namespace dataset

/// Names of attributes; those of the root group unless a dataset is named.
namespace attribute {
inline constexpr char kFormat[] = "format";
inline constexpr char kSchemaVersion[] = "schema_version";
inline constexpr char kDigest[] = "content_digest";
inline constexpr char kBridgeName[] = "bridge_name";
inline constexpr char kBridgeSha256[] = "bridge_sha256";
inline constexpr char kProgramVersion[] = "program_version";
inline constexpr char kCompiler[] = "compiler";
inline constexpr char kCompileFlags[] = "compile_flags";
inline constexpr char kSolverRevision[] = "solver_revision";
inline constexpr char kResultsKey[] = "results_key";
}  // namespace attribute

/// A scalar text; `meaning` stands beside it.
DatasetValue text_dataset(const char* path, const std::string& text, const char* meaning);

/// The datasets that all records share (bridge text, settings, geometry, control points, states, model error,
/// sensitivities unless they are null, variants) in the order in which the content digest takes them. Those
/// of joints are missing if the bridge has none: an empty dataset has no place that could be mapped; and
/// those of what points read if all are control points. Throws Failure for a name that is too long to be
/// stored.
std::vector<DatasetValue> shared_datasets(const Provenance& provenance, const Model& bridge,
                                          const std::vector<VariantParameters>& variants,
                                          const std::vector<std::string>& states,
                                          const std::vector<ModelError>& model_errors,
                                          const Sensitivities* sensitivities);

}  // namespace voussoir
