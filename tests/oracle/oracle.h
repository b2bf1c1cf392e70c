// Light computed by other code than the renderer's: geometry straight from the scene file,
// Embree for visibility, light sampling written from SPEC.md in double. Where both agree, the
// result is not one program's mistake.
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <random>
#include <vector>

#include "formats/light.h"
#include "formats/scene.h"
#include "oracle/air.h"
#include "runtime/measure/image.h"
#include "runtime/scene/camera.h"

namespace nightcity::oracle {

/// The lights of a light file (SPEC.md) at one moment.
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

  /// Returns the picture through the pixels' centres, cd/m2: the light of every lamp and window
  /// that diffuse surfaces reflect, and what surfaces emit. Each light is sampled at `strata` x
  /// `strata` jittered points; another seed gives an independent picture. Light that reached a
  /// surface after up to `bounces` others is added by `paths` paths a pixel, whose every vertex is
  /// lit by all lights. Air is marched through
  /// along each ray, in jittered steps.
  measure::Image render(const scene::CameraPose& pose, std::uint32_t width, std::uint32_t height,
                        int strata, unsigned seed, int bounces = 0, int paths = 1,
                        const Air& air = {}) const;

 private:
  struct Geometry;
  struct Vertex;
  std::optional<Vertex> find_vertex(const glm::dvec3& origin, const glm::dvec3& direction,
                                    bool from_camera) const;
  glm::dvec3 reflect_lights(const Vertex& vertex, int strata, std::mt19937& random,
                            const Air& air) const;
  glm::dvec3 follow_path(Vertex vertex, int bounces, std::mt19937& random, const Air& air) const;
  glm::dvec3 march(const glm::dvec3& eye, const glm::dvec3& direction, double depth,
                   std::mt19937& random, const Air& air) const;
  std::unique_ptr<Geometry> geometry_;
  Lights lights_;
};

/// Reads a light file. Lights that do not shine `time_s` seconds after noon keep their index,
/// without flux. Vehicles are left out.
Lights read_lights(const std::filesystem::path& path, double time_s);

}  // namespace nightcity::oracle
