#include "formats/scene_identity.h"

#include <xxhash.h>

#include <nlohmann/json.hpp>

#include "formats/error.h"
#include "formats/georeference_json.h"
#include "formats/json_text.h"

namespace nightcity {

std::string make_scene_id(const Georeference& georeference, std::uint64_t lights_checksum) {
  Georeference without_id = georeference;
  without_id.scene_id.clear();
  const std::string text = dump(georeference_to_json(without_id));
  std::uint64_t hash = XXH64(text.data(), text.size(), lights_checksum);
  std::string id(16, '0');
  for (auto digit = id.rbegin(); digit != id.rend(); ++digit, hash >>= 4)
    *digit = "0123456789abcdef"[hash & 15u];
  return id;
}

void require_same_scene(const std::filesystem::path& scene, const Georeference& of_scene,
                        const std::filesystem::path& lights, const Georeference& of_lights) {
  if (of_scene.scene_id.empty() || of_lights.scene_id.empty() ||
      of_scene.scene_id == of_lights.scene_id)
    return;
  throw Error(lights.string(), "holds the lights of another scene (scene_id " + of_lights.scene_id +
                                   ") than " + scene.string() + " (" + of_scene.scene_id +
                                   "): keep the two files of one bake together");
}

}  // namespace nightcity
