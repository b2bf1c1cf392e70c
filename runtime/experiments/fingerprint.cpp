#include "runtime/experiments/fingerprint.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <fstream>
#include <vector>

namespace nightcity::experiments {

std::string fingerprint_scene(const std::filesystem::path& glb) {
  XXH64_state_t* state = XXH64_createState();
  XXH64_reset(state, 0);
  std::filesystem::path lights = glb;
  lights.replace_extension(".lights");
  std::vector<char> block(1 << 20);
  for (const auto& path : {glb, lights}) {
    std::ifstream file(path, std::ios::binary);
    while (file) {
      file.read(block.data(), static_cast<std::streamsize>(block.size()));
      XXH64_update(state, block.data(), static_cast<std::size_t>(file.gcount()));
    }
  }
  const std::string text = fmt::format("{:016x}", XXH64_digest(state));
  XXH64_freeState(state);
  return text;
}

std::string fingerprint_pose(const scene::CameraPose& pose) {
  std::vector<float> values;
  for (const glm::vec3& v : {pose.position, pose.target, pose.up})
    values.insert(values.end(), {v.x, v.y, v.z});
  values.push_back(pose.fov_deg);
  return fmt::format("{:08x}",
                     XXH64(values.data(), values.size() * sizeof(float), 0) & 0xFFFFFFFFu);
}

}  // namespace nightcity::experiments
