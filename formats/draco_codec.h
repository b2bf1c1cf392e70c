// KHR_draco_mesh_compression's payload. Debian's tinygltf has no Draco, so libdraco is used directly.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "formats/scene_file.h"

namespace nightcity {

/// Bits of position quantisation that keep every vertex within `tolerance_m` over a box of greatest side
/// `extent_m`: Draco rounds each axis to steps of extent / (2^bits - 1), so a vertex moves at most sqrt(3)/2
/// steps.
int draco_bits(double extent_m, double tolerance_m);

struct DracoEncoded {
  std::vector<char> bytes;
  // Ids by which the glTF extension names the attributes; -1 = not there.
  int position_id = -1, feature_id = -1, light_id = -1;
  std::uint32_t vertex_count = 0, index_count = 0;  // as decoded: Draco drops degenerate triangles
  glm::vec3 least{0}, greatest{0};                  // of the decoded positions
  int bits = 0;
  double error_m =
      0;  // greatest distance from an original vertex to its decoded place, measured after decoding
};

/// Feature and light ids (as the floats glTF stores) are kept exactly. Empty where Draco cannot encode the
/// mesh (every triangle degenerate) or moves a vertex by more than the tolerance: the caller then stores it
/// plain.
std::optional<DracoEncoded> encode_draco(const ScenePrimitive& primitive,
                                         std::span<const float> feature_ids,
                                         std::span<const float> light_ids, double tolerance_m);

struct DracoDecoded {
  std::vector<std::uint32_t> indices;
  std::vector<std::vector<float>> attributes;  // in the order asked for
};

struct DracoAttribute {
  std::uint32_t id;
  int components;
};

/// Throws Error (no file name) where the bytes are no Draco mesh or an attribute is missing.
DracoDecoded decode_draco(std::span<const std::byte> bytes,
                          std::span<const DracoAttribute> attributes);

}  // namespace nightcity
