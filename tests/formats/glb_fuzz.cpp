// libFuzzer target: reads any bytes as a glTF scene. A scene that is read must be valid, and its
// triangles are the same where they are read in place.
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "formats/error.h"
#include "formats/finite.h"
#include "formats/scene_reader.h"
#include "support/fuzz_file.h"

namespace {

using namespace nightcity;

void check(bool holds) {
  if (!holds) std::abort();
}

std::uint32_t id_at(const std::vector<std::uint32_t>& ids, std::uint32_t vertex) {
  return ids.empty() ? no_id : ids[vertex];
}

void check_in_place(const ScenePrimitive& primitive, const MappedPrimitive& mapped) {
  check(3 * std::size_t{mapped.triangles} == primitive.indices.size());
  check(mapped.material == primitive.material);
  for (std::size_t i = 0; i < mapped.triangles; ++i) {
    const auto corners = mapped.corners(i);
    for (std::size_t k = 0; k < 3; ++k) {
      check(corners[k] == primitive.indices[3 * i + k]);
      check(mapped.position(corners[k]) == primitive.positions[corners[k]]);
      check(mapped.feature(corners[k]) == id_at(primitive.feature_ids, corners[k]));
      check(mapped.light(corners[k]) == id_at(primitive.light_ids, corners[k]));
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const test::FuzzFile bytes(data, size);
  try {
    SceneFile file(bytes.path());
    for (std::size_t i = 0; i < file.mesh_count(); ++i) {
      file.count_triangles(i);
      file.find_bounds(i);
    }
    std::vector<SceneMesh> meshes;
    std::vector<MappedMesh> in_place(file.mesh_count());
    for (std::size_t i = 0; i < file.mesh_count(); ++i)
      meshes.push_back(file.read_mesh(i, &in_place[i]));
    const auto held = file.close();
    const Scene scene = file.finish();
    for (const SceneNode& node : scene.nodes) check(node.mesh < meshes.size());
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      check(meshes[i].primitives.size() == in_place[i].size());
      for (std::size_t p = 0; p < meshes[i].primitives.size(); ++p) {
        const ScenePrimitive& primitive = meshes[i].primitives[p];
        check(primitive.material < scene.materials.size());
        for (const std::uint32_t index : primitive.indices)
          check(index < primitive.positions.size());
        for (const glm::vec3& place : primitive.positions) check(finite(place));
        if (in_place[i][p]) check_in_place(primitive, *in_place[i][p]);
      }
    }
  } catch (const Error&) {  // a broken file is refused
  }
  return 0;
}
