// Names and numbers of glTF 2.0 and of our conventions on top of it (SPEC.md), shared by reader and
// writer.
#pragma once

#include <cstdint>
#include <string>

#include "formats/scene.h"

namespace nightcity::gltf {

// Accessor component types and buffer view targets (glTF 2.0, section 5).
constexpr int int8 = 5120, uint8 = 5121, int16 = 5122, uint16 = 5123, uint32 = 5125, float32 = 5126;
constexpr int array_buffer = 34962, element_array_buffer = 34963;

// Samplers of textures (glTF 2.0, section 5.26).
constexpr int linear = 9729, linear_mipmap_linear = 9987;
constexpr int wrap_clamp = 33071, wrap_mirror = 33648, wrap_repeat = 10497;
constexpr int to_wrap(TextureWrap wrap) {
  return wrap == TextureWrap::clamp    ? wrap_clamp
         : wrap == TextureWrap::mirror ? wrap_mirror
                                       : wrap_repeat;
}

constexpr std::uint32_t glb_magic = 0x46546C67, chunk_json = 0x4E4F534A, chunk_binary = 0x004E4942;

constexpr const char* draco = "KHR_draco_mesh_compression";
constexpr const char* emissive_strength = "KHR_materials_emissive_strength";
constexpr const char* gpu_instancing = "EXT_mesh_gpu_instancing";
constexpr const char* instance_features = "EXT_instance_features";
constexpr const char* lights_punctual = "KHR_lights_punctual";
constexpr const char* lights_ies = "EXT_lights_ies";
constexpr const char* mesh_features = "EXT_mesh_features";
constexpr const char* hierarchy = "NIGHTCITY_hierarchy";  // SPEC.md, 2.6
constexpr const char* structural_metadata = "EXT_structural_metadata";

constexpr const char* specular_glossiness = "KHR_materials_pbrSpecularGlossiness";
constexpr const char* texture_transform = "KHR_texture_transform";

constexpr const char* colour_attribute = "COLOR_0";
inline std::string texture_attribute(std::uint32_t set) {
  return "TEXCOORD_" + std::to_string(set);
}
// This attribute of vertices and instances is an index into the table of features.
constexpr const char* feature_attribute = "_FEATURE_ID_0";
// This attribute of vertices and instances is an index into city.lights.
constexpr const char* light_attribute = "_LIGHT";
constexpr const char* extras_key = "nightcity";
constexpr const char* scene_version = "1.3";

// Ids are stored as floats, which are exact for whole numbers up to 2^24. But Draco's quantiser
// adds 0.5 before it rounds down, and floats hold halves only up to 2^23.
constexpr std::uint32_t max_id = (1u << 23) - 1;
constexpr float null_feature_id = 8388607.0f, null_light = -1.0f;

}  // namespace nightcity::gltf
