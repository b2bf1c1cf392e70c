// The two files of a small scene, as users have them.
#pragma once

#include <filesystem>
#include <vector>

#include "formats/light_file.h"
#include "formats/scene.h"
#include "formats/scene_writer.h"

namespace nightcity::test {

/// Writes `glb`, and the lights into the file beside it. Both have the lights' georeference.
inline void write_scene_files(std::filesystem::path glb, const Scene& scene,
                              const LightFileContent& lights) {
  SceneWriter writer(glb, {});
  for (const SceneMaterial& material : scene.materials) writer.add_material(material);
  for (const SceneMesh& mesh : scene.meshes) writer.add_mesh(mesh);
  for (const SceneNode& node : scene.nodes) writer.add_node(node);
  writer.finish(lights.georeference, scene.places);
  write_light_file(glb.replace_extension(".lights"), lights);
}

/// Writes the two files of a scene whose lights are all of one family and numbered from 1.
inline void write_scene_files(const std::filesystem::path& glb, const Scene& scene,
                              std::vector<Light> lights, const Georeference& georeference = {}) {
  for (std::size_t i = 0; i < lights.size(); ++i) lights[i].id = static_cast<uint>(i + 1);
  const std::vector<LightProvenance> provenance(lights.size());
  write_scene_files(glb, scene,
                    {.georeference = georeference, .lights = lights, .provenance = provenance});
}

}  // namespace nightcity::test
