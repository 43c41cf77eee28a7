#include "database/records/record_key.h"

#include "core/error.h"

namespace voussoir {

std::vector<RecordKey> keys_of(std::int32_t variant, const std::vector<Scene>& scenes) {
  std::vector<RecordKey> keys;
  keys.reserve(scenes.size());
  for (const Scene& scene : scenes) keys.push_back({variant, scene});
  return keys;
}

std::string to_string(const RecordKey& key, const BlockLayout& layout) {
  const std::string scene = to_string(key.scene, layout);
  return key.variant == kNominalVariant ? scene : fmt::format("{} of variant {}", scene, key.variant);
}

}  // namespace voussoir
