// city.glb: glTF 2.0 with our extras. SceneWriter (tools) streams one out; read_scene (runtime, inspect)
// takes any glTF.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "formats/georeference.h"

namespace nightcity {

constexpr std::uint32_t no_id = 0xFFFFFFFFu;  // no feature, no light

struct SceneMaterial {
  std::string name;
  glm::vec3 base_colour{0.5f};  // linear Rec. 709 reflectance
  glm::vec3 emission_cd_m2{
      0.0f};  // emitted luminance per channel; KHR_materials_emissive_strength in the file
  float roughness = 1.0f;
  bool double_sided = true;
};

/// Triangles of one material. positions in the node's own frame, m.
struct ScenePrimitive {
  std::uint32_t material = 0;
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> indices;      // 3 a triangle, < positions.size()
  std::vector<std::uint32_t> feature_ids;  // a vertex, into Scene::features; empty = none
  std::vector<std::uint32_t>
      light_ids;  // a vertex, into city.lights: emitter geometry; empty = none
};

struct SceneMesh {
  std::string name;
  std::vector<ScenePrimitive> primitives;
};

/// One placing of a mesh. EXT_mesh_gpu_instancing in the file where a node has many.
struct SceneInstance {
  glm::mat4 to_model{1.0f};     // mesh to model space
  std::uint32_t light = no_id;  // whose luminous part this instance shows (attribute _LIGHT)
};

struct SceneNode {
  std::string name;
  std::string
      kind;  // "city", "terrain", "road", "lamp", "window", "vehicle" (extras.nightcity.kind); "" in
             // foreign files
  std::uint32_t mesh = 0;
  bool casts_shadow =
      true;  // extras.nightcity.casts_shadow; false: seen by the eye, not by shadow rays
  std::vector<SceneInstance> instances;
  std::uint32_t vehicle =
      no_id;  // extras.nightcity.vehicle: the mesh is this kind's body, in the vehicle frame
};

/// One building or other city object, kept in the file (EXT_structural_metadata) for whoever clicks on it.
struct SceneFeature {
  std::string id;
  std::string type;      // "Building", "Road", ...
  std::string function;  // code or text as in the source; "" = absent
  std::optional<double> measured_height_m;
  std::optional<int> storeys_above_ground;
};

/// A light without size, for other programs (KHR_lights_punctual); ours take city.lights.
struct ScenePunctual {
  glm::vec3 position{0};
  glm::vec3 direction{0, -1, 0};  // unit, of a spot's axis
  glm::vec3 colour{1};            // linear Rec. 709, luminance 1
  double intensity_cd = 0;        // along the axis
  double inner_rad = 0,
         outer_rad =
             0;  // half angles of the spot's cone, inner < outer <= pi / 2; outer 0: a point
};

struct Scene {
  Georeference georeference;
  std::vector<SceneMaterial> materials;
  std::vector<SceneMesh> meshes;
  std::vector<SceneNode> nodes;
  std::vector<SceneFeature> features;
};

/// Reads .glb or .gltf, ours or anybody's (Draco, instancing, node hierarchies, u8/u16/u32 indices, no
/// indices). Throws Error: missing, truncated, not glTF, index out of range, NaN or Inf in a position or
/// matrix.
Scene read_scene(const std::filesystem::path& path);

/// Streams a city.glb: geometry goes to a scratch file beside `path` as it comes, so memory does not grow
/// with the city. finish() assembles the file and renames; without it nothing is left behind.
class SceneWriter {
 public:
  struct Options {
    bool draco = false;
    double draco_tolerance_m =
        0.01;  // greatest displacement of a vertex; decides the quantisation bits
  };

  SceneWriter(std::filesystem::path path, Options options);
  ~SceneWriter();
  SceneWriter(const SceneWriter&) = delete;
  SceneWriter& operator=(const SceneWriter&) = delete;

  std::uint32_t add_material(const SceneMaterial& material);
  std::uint32_t add_feature(const SceneFeature& feature);
  /// Written out at once; indices stored as 16 or 32 bits by need. Throws Error on NaN, Inf or a bad index.
  std::uint32_t add_mesh(const SceneMesh& mesh);
  /// Written as TRS, so `to_model` must be free of shear. A node without instances shows nothing and is left
  /// out.
  void add_node(const SceneNode& node);
  /// Throws Error where a value is not finite, not positive or the cone is none.
  void add_punctual(const ScenePunctual& light);
  void finish(const Georeference& georeference);

  struct Statistics {
    std::uint64_t meshes = 0, vertices = 0, triangles = 0, nodes = 0, instances = 0, features = 0;
    int max_draco_bits = 0;  // quantisation of positions; 0 = no Draco
    double max_draco_error_m =
        0;  // greatest displacement of a vertex, measured on the decoded mesh
  };
  const Statistics& statistics() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace nightcity
