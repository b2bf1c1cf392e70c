// The content of a city.glb: what SceneWriter writes and read_scene returns.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <string>
#include <vector>

#include "formats/georeference.h"
#include "formats/scene_places.h"

namespace nightcity {

constexpr std::uint32_t no_id = 0xFFFFFFFFu;  // no feature, no light, no vehicle

/// A picture as it lies in the file: a PNG or JPEG, sRGB.
using ScenePicture = std::vector<std::byte>;

/// A picture goes on so beyond its edges.
enum class TextureWrap : std::uint8_t { repeat, clamp, mirror };

/// A picture on the surfaces of a material, by their vertices' texture coordinates.
struct SceneTexture {
  std::uint32_t picture = 0;  // index into Scene::pictures
  glm::vec3 factor{1};        // each texel times it is the reflectance
  TextureWrap wrap_u = TextureWrap::repeat, wrap_v = TextureWrap::repeat;
  std::uint32_t coordinates = 0;  // the set of the file (TEXCOORD_n); written as set 0
  bool operator==(const SceneTexture&) const = default;
};

struct SceneMaterial {
  std::string name;
  glm::vec3 base_colour{0.5f};     // reflectance, linear Rec. 709; the mean under a texture
  glm::vec3 emission_cd_m2{0.0f};  // emitted luminance of each channel
  float roughness = 1.0f;
  bool double_sided = true;
  std::optional<SceneTexture> texture{};
};

/// Triangles of one material.
struct ScenePrimitive {
  std::uint32_t material = 0;          // index into Scene::materials
  std::vector<glm::vec3> positions;    // m, in the node's own frame
  std::vector<std::uint32_t> indices;  // three for each triangle, each < positions.size()
  // One for each vertex, or empty: the city object it belongs to (index into Scene::features) and
  // the light whose luminous surface it is part of (index into city.lights).
  std::vector<std::uint32_t> feature_ids;
  std::vector<std::uint32_t> light_ids;
  // The material of each triangle, where vertices have colours of their own (COLOR_0 in files of
  // others); otherwise empty, and `material` is that of all triangles. Not written.
  std::vector<std::uint32_t> triangle_materials;
  // One for each vertex, or empty: its place in the material's picture, from the upper left corner,
  // 1 being the picture's width and height.
  std::vector<glm::vec2> texture_coordinates{};
};

struct SceneMesh {
  std::string name;
  std::vector<ScenePrimitive> primitives;
};

/// One placement of a mesh. A node with many of them becomes EXT_mesh_gpu_instancing in the file.
struct SceneInstance {
  glm::mat4 to_model{1.0f};  // from the mesh's frame to model space
  std::uint32_t light =
      no_id;  // the light whose luminous surface this instance is (attribute _LIGHT)
  // The part of the translation that its floats in `to_model` cannot hold: far from the origin
  // these are up to a metre apart.
  glm::vec3 translation_rest{0};
  // The object that this instance is (EXT_instance_features): it goes before those of vertices.
  std::uint32_t feature = no_id;
};

/// Returns an instance's matrix to model space with the translation in double.
inline glm::dmat4 to_double(const SceneInstance& instance) {
  glm::dmat4 matrix(instance.to_model);
  matrix[3] += glm::dvec4(instance.translation_rest, 0);
  return matrix;
}

struct SceneNode {
  std::string name;
  // extras.nightcity.kind: "city", "terrain", "road", "bridge", "barrier", "lamp", "window",
  // "tree", "vehicle" or "horizon"; "" in files of others.
  std::string kind;
  std::uint32_t mesh = 0;
  // extras.nightcity.casts_shadow. False: cameras see the node, shadow rays pass through it.
  bool casts_shadow = true;
  std::vector<SceneInstance> instances;
  // extras.nightcity.vehicle: the mesh is the body of this kind of vehicle, in the vehicle's frame.
  std::uint32_t vehicle = no_id;
  std::uint32_t number = no_id;  // among the nodes of the file that it was read from
};

/// A building or another city object, kept in the file (EXT_structural_metadata) to identify what a
/// user clicks on.
struct SceneFeature {
  std::string id;
  std::string type{};      // "Building", "Road", ...
  std::string function{};  // code or text as in the source; "" = absent
  std::optional<double> measured_height_m{};
  std::optional<int> storeys_above_ground{};
  std::string provenance{};  // of a light: where each of its values comes from; "" = absent
};

/// A light without size (KHR_lights_punctual), for other programs; ours read city.lights instead.
struct ScenePunctual {
  glm::vec3 position{0};          // m, in model space
  glm::vec3 direction{0, -1, 0};  // unit vector along a spot's axis
  glm::vec3 colour{1};            // linear Rec. 709, luminance 1
  double intensity_cd = 0;        // along the axis
  // Half angles of a spot's cone, inner < outer <= pi / 2. outer_rad = 0: a point light, which has
  // no cone.
  double inner_rad = 0, outer_rad = 0;
};

struct Scene {
  Georeference georeference;
  std::vector<SceneMaterial> materials;
  std::vector<ScenePicture> pictures{};
  std::vector<SceneMesh> meshes;
  std::vector<SceneNode> nodes;
  std::vector<SceneFeature> features;
  // Each sentence names one kind of content, in a file of others, that is not shown as it is there.
  std::vector<std::string> skipped;
  ScenePlaces places{};
};

}  // namespace nightcity
