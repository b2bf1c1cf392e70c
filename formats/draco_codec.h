// The compressed data of KHR_draco_mesh_compression. Debian's tinygltf is built without Draco, so
// libdraco is used directly.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "formats/scene.h"

namespace nightcity {

/// Returns how many bits of quantisation keep each vertex within `tolerance_m` of its place, in a
/// bounding box whose longest side is `extent_m`. Draco rounds each coordinate to steps of extent /
/// (2^bits - 1), so a vertex moves by at most sqrt(3)/2 steps.
int draco_bits(double extent_m, double tolerance_m);

struct DracoEncoded {
  std::vector<char> bytes;
  // The ids by which the glTF extension refers to the attributes; -1 = absent.
  int position_id = -1, feature_id = -1, light_id = -1;
  // The size of the decoded mesh, which may be smaller: Draco leaves out degenerate triangles.
  std::uint32_t vertex_count = 0, index_count = 0;
  glm::vec3 min{0}, max{0};  // bounds of the decoded positions
  int bits = 0;              // of quantisation
  double error_m = 0;        // the largest displacement of a vertex, measured after decoding
};

/// Returns the compressed primitive; feature and light ids (as the floats that glTF stores) are
/// kept exactly. Returns nothing if Draco cannot encode the mesh (all triangles are degenerate) or
/// moves a vertex by more than the tolerance; such a mesh is to be stored uncompressed.
std::optional<DracoEncoded> encode_draco(const ScenePrimitive& primitive,
                                         std::span<const float> feature_ids,
                                         std::span<const float> light_ids, double tolerance_m);

struct DracoDecoded {
  std::vector<std::uint32_t> indices;
  std::vector<std::vector<float>> attributes;  // in the order of the request
};

struct DracoAttribute {
  std::uint32_t id;
  int components;
};

/// Returns the mesh in `bytes` with these attributes. Throws Error, without a file name, if the
/// bytes are no Draco mesh or an attribute is missing.
DracoDecoded decode_draco(std::span<const std::byte> bytes,
                          std::span<const DracoAttribute> attributes);

}  // namespace nightcity
