// Direct light by other code than the renderer's: geometry straight from the scene file, Embree for
// visibility, light sampling written from SPEC.md in double. What both agree on is not one program's mistake.
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "formats/light.h"
#include "formats/scene.h"
#include "runtime/measure/image.h"
#include "runtime/scene/camera.h"

namespace nightcity::oracle {

/// What SPEC.md's light file says about light, as far as one moment needs it.
struct Lights {
  std::vector<Light> lights;
  std::vector<LightProfile> profiles;
  std::vector<float> profile_data;
};

class Oracle {
 public:
  Oracle(const Scene& scene, Lights lights);
  ~Oracle();
  Oracle(const Oracle&) = delete;
  Oracle& operator=(const Oracle&) = delete;

  /// The picture through the pixels' centres, cd/m2: light of every lamp and window reflected by diffuse
  /// surfaces, and what surfaces emit. Each light is sampled with `strata` x `strata` jittered points;
  /// another seed gives an independent picture.
  Image render(const CameraPose& pose, std::uint32_t width, std::uint32_t height, int strata,
               unsigned seed) const;

 private:
  struct Geometry;
  std::unique_ptr<Geometry> geometry_;
  Lights lights_;
};

/// A light file with the lights that shine `time_s` seconds after noon; the others keep their index, without
/// flux. Vehicles are left out.
Lights read_lights(const std::filesystem::path& path, double time_s);

}  // namespace nightcity::oracle
