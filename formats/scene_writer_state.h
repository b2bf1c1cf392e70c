// The state of a SceneWriter, for the files that define its functions.
#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "formats/error.h"
#include "formats/feature_table.h"
#include "formats/gltf_stream.h"
#include "formats/json_text.h"
#include "formats/scene_primitive_writer.h"
#include "formats/scene_writer.h"
#include "formats/trs.h"

namespace nightcity {

inline float min_of(const glm::vec3& v) {
  return std::min({v.x, v.y, v.z});
}
inline float max_of(const glm::vec3& v) {
  return std::max({v.x, v.y, v.z});
}

struct SceneWriter::State {
  std::filesystem::path path;
  Statistics statistics;
  gltf::Stream stream;
  PrimitiveWriter primitives;
  FeatureTableWriter features;
  JsonArray materials, meshes, nodes, punctual, ies, images, samplers, textures;
  std::map<std::string, std::size_t> known_punctual;  // equal lights share a description
  std::map<std::string, std::size_t> known_samplers, known_textures;
  bool finished = false;

  State(std::filesystem::path target, Options options)
      : path(std::move(target)),
        stream(path),
        primitives(path, stream, statistics,
                   options.draco ? std::optional(options.draco_tolerance_m) : std::nullopt),
        features(path),
        materials(path),
        meshes(path),
        nodes(path),
        punctual(path),
        ies(path),
        images(path),
        samplers(path),
        textures(path) {}

  [[noreturn]] void fail(const std::string& place, const std::string& message) const {
    throw Error(path.string(), place, message);
  }

  void check(const ScenePunctual& light) const;
  std::vector<Trs> find_placements(const SceneNode& node) const;
  nlohmann::json write_instances(const SceneNode& node, const std::vector<Trs>& placements);
  std::size_t write_light_description(const ScenePunctual& light);
  nlohmann::json describe_texture(const SceneTexture& texture, const std::string& place);
  nlohmann::json write_features();
  void write_root(JsonText& text, const nlohmann::json& asset, const nlohmann::json& feature_table);
};

}  // namespace nightcity
