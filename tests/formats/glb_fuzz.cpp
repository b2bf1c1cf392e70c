// libFuzzer target: reads any bytes as a glTF scene. A scene that is read must be valid.
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "formats/error.h"
#include "formats/finite.h"
#include "formats/scene_reader.h"
#include "support/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nightcity;
  const test::FuzzFile file(data, size);
  try {
    const Scene scene = read_scene(file.path());
    for (const SceneNode& node : scene.nodes)
      if (node.mesh >= scene.meshes.size()) std::abort();
    for (const SceneMesh& mesh : scene.meshes)
      for (const ScenePrimitive& primitive : mesh.primitives) {
        if (primitive.material >= scene.materials.size()) std::abort();
        for (const std::uint32_t index : primitive.indices)
          if (index >= primitive.positions.size()) std::abort();
        for (const glm::vec3& p : primitive.positions)
          if (!finite(p)) std::abort();
      }
  } catch (const Error&) {  // a broken file is refused
  }
  return 0;
}
