// Describes the surface under a click, the light that reaches it, and the source of each value.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "runtime/scene/camera.h"
#include "runtime/scene/light_families.h"
#include "runtime/scene/render_scene.h"

namespace nightcity::viewer {

/// A light with its values and their sources, in words.
struct PickedLight {
  std::size_t light;
  std::string name;  // "lamp 123, 4000 lm, 8.0 m high"
  double lux = 0, share = 0, distance_m = 0;
  std::string sources;  // "position: tag, flux: rule, ..."
};

struct Pick {
  glm::vec3 point{0}, normal{0, 1, 0};  // model space
  std::vector<std::string> lines;       // of the surface: object, attributes, place
  std::optional<PickedLight> emitter;   // the light whose luminous surface was picked
  std::vector<PickedLight> strongest;   // of the static lights at the point
  double lux = 0;                       // of all static lights
  std::size_t lights = 0;               // that give it
};

/// Returns what a pixel of a window of `size` pixels shows, nothing for the sky. Vehicles are
/// looked through, and lights of families outside `on` are off.
std::optional<Pick> pick(const scene::RenderScene& scene, const scene::CameraPose& pose,
                         const glm::vec2& pixel, const glm::vec2& size, double time_s,
                         scene::LightFamilies on = scene::all_families);

/// Finds the lights at the point that was picked anew: one of them changed, or the time.
void find_lights(Pick& picked, const scene::RenderScene& scene, double time_s,
                 scene::LightFamilies on);

/// Returns a light's values and where they came from.
PickedLight describe_light(const scene::RenderScene& scene, std::size_t light);

}  // namespace nightcity::viewer
