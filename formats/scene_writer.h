// Writes city.glb: glTF 2.0 with the extras that SPEC.md describes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>

#include "formats/scene.h"

namespace nightcity {

/// Counts of a scene's content, and its size before and after compression.
struct SceneStatistics {
  std::uint64_t meshes = 0, vertices = 0, triangles = 0, nodes = 0, instances = 0, features = 0;
  int max_draco_bits = 0;        // of a position's quantisation; 0 = no Draco
  double max_draco_error_m = 0;  // displacement of a vertex, measured on the decoded mesh
};

/// A light that shines by a luminaire file (EXT_lights_ies), for other programs.
struct SceneIesLight {
  std::uint32_t profile = 0;   // as add_ies_profile returned it
  glm::vec3 position{0};       // m, in model space
  glm::vec3 axis{0, -1, 0};    // unit vector to the file's nadir
  glm::vec3 tangent{1, 0, 0};  // unit vector, perpendicular, to its half-plane C = 0
  glm::vec3 colour{1};         // linear Rec. 709, luminance 1
  double multiplier = 1;       // of the file's candela
};

/// Streams a city.glb. Geometry goes to a scratch file beside `path` as it is added, so memory does
/// not grow with the city. finish() joins the parts and renames the result; without it nothing is
/// left behind.
///
/// The functions throw Error if a value is not finite, an index points to nothing, or the disk is
/// full.
class SceneWriter {
 public:
  struct Options {
    bool draco = false;
    double draco_tolerance_m =
        0.01;  // bound on a vertex's displacement; decides the quantisation bits
  };
  using Statistics = SceneStatistics;

  SceneWriter(std::filesystem::path path, Options options);
  ~SceneWriter();
  SceneWriter(const SceneWriter&) = delete;
  SceneWriter& operator=(const SceneWriter&) = delete;

  // Each returns the index by which later calls refer to what was added.
  /// A PNG or JPEG, which the file then holds.
  std::uint32_t add_picture(std::span<const std::byte> bytes);
  /// The picture of its texture must have been added before.
  std::uint32_t add_material(const SceneMaterial& material);
  std::uint32_t add_feature(const SceneFeature& feature);
  /// Materials and features that the mesh refers to must have been added before.
  std::uint32_t add_mesh(const SceneMesh& mesh);

  /// Nodes hold translation, rotation and scale, so `to_model` of an instance must be free of
  /// shear. A node without instances would show nothing; it is not written.
  void add_node(const SceneNode& node);
  /// Throws Error if a value is not positive or the cone's angles are out of order.
  void add_punctual(const ScenePunctual& light);
  /// `text`: of an ANSI/IES LM-63 file.
  std::uint32_t add_ies_profile(std::string_view text);
  /// Throws Error if a value is not finite or not positive, or the profile is not there.
  void add_ies_light(const SceneIesLight& light);
  /// Completes the file. To be called once, as the last function.
  void finish(const Georeference& georeference, const ScenePlaces& places = {});

  const Statistics& statistics() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace nightcity
