// Writes the triangles of a scene as glTF primitives, plain or compressed with Draco.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "formats/draco_codec.h"
#include "formats/gltf_stream.h"
#include "formats/scene_writer.h"

namespace nightcity {

/// Returns ids as the floats that glTF stores (it allows no 32-bit integers as vertex attributes),
/// with `none` in place of no_id.
std::vector<float> to_float_ids(const std::vector<std::uint32_t>& ids, float none);

/// Returns the array `featureIds` of EXT_mesh_features and EXT_instance_features, null where no id
/// is one of a feature: their featureCount must be above 0.
nlohmann::json describe_feature_ids(std::span<const float> feature_ids);

class PrimitiveWriter {
 public:
  /// Refers to `stream` and `statistics`. `file` is for messages. Without a tolerance nothing is
  /// compressed.
  PrimitiveWriter(std::filesystem::path file, gltf::Stream& stream, SceneStatistics& statistics,
                  std::optional<double> draco_tolerance_m);

  /// The numbers of materials and features that a primitive may refer to.
  struct Limits {
    std::size_t materials, features;
  };
  /// Writes the vertices and indices and returns the primitive's JSON. Throws Error with `place`
  /// ("mesh 3") if a position is not finite or an index points to nothing.
  nlohmann::json write(const ScenePrimitive& primitive, const Limits& limits,
                       const std::string& place);

 private:
  void check(const ScenePrimitive& primitive, const Limits& limits, const std::string& place) const;
  nlohmann::json write_plain(const ScenePrimitive& primitive, std::span<const float> feature_ids,
                             std::span<const float> light_ids);
  std::size_t write_indices(const std::vector<std::uint32_t>& indices, std::size_t vertex_count);
  nlohmann::json write_draco(const DracoEncoded& encoded);

  std::filesystem::path file_;
  gltf::Stream& stream_;
  SceneStatistics& statistics_;
  std::optional<double> draco_tolerance_m_;
};

}  // namespace nightcity
