#include "runtime/render/image_layers.h"

#include <string>
#include <utility>
#include <vector>

#include "shaders/air.glsl.h"
#include "shaders/octahedral.glsl.h"
#include "shaders/tonemap.glsl.h"

namespace nightcity::render {
namespace {

void append(std::vector<float>& values, float value) {
  values.push_back(value);
}

void append(std::vector<float>& values, const glm::vec3& v) {
  values.insert(values.end(), {v.x, v.y, v.z});
}

// Returns the values of the new layer, to be filled.
std::vector<float>& add_layer(measure::Image& image, const char* name,
                              std::vector<std::string> channels) {
  image.layers.push_back({name, std::move(channels), {}});
  measure::ImageLayer& layer = image.layers.back();
  layer.values.reserve(image.pixels() * layer.channels.size());
  return layer.values;
}

}  // namespace

void add_luminance_layer(measure::Image& image) {
  std::vector<float>& luminance = add_layer(image, "luminance", {"Y"});
  for (std::size_t i = 0; i < image.pixels(); ++i)
    luminance.push_back(
        tonemap::luminance_709(image.rgb[3 * i], image.rgb[3 * i + 1], image.rgb[3 * i + 2]));
}

void add_light_layers(measure::Image& image, std::span<const gpu::LayerSums> sums,
                      std::uint32_t frames) {
  const auto add = [&](const char* name, glm::vec3 gpu::LightLayers::*layer) {
    std::vector<float>& values = add_layer(image, name, {"R", "G", "B"});
    for (const gpu::LayerSums& s : sums) append(values, s.sum.*layer / float(frames));
  };
  add("direct_lamps", &gpu::LightLayers::lamps);
  add("direct_windows", &gpu::LightLayers::windows);
  add("direct_vehicles", &gpu::LightLayers::vehicles);
  add("sky", &gpu::LightLayers::sky);
  add("emitted", &gpu::LightLayers::emitted);
  add("indirect", &gpu::LightLayers::indirect);
  add("air", &gpu::LightLayers::air);
}

void add_surface_layers(measure::Image& image, std::span<const gpu::Surface> surfaces,
                        const DeviceScene& scene) {
  const auto add = [&](const char* name, std::vector<std::string> channels, auto&& value_of) {
    std::vector<float>& values = add_layer(image, name, std::move(channels));
    for (const gpu::Surface& s : surfaces) append(values, value_of(s));
  };
  const auto is_hit = [](const gpu::Surface& s) { return s.depth > 0; };
  add("albedo", {"R", "G", "B"},
      [&](const gpu::Surface& s) { return is_hit(s) ? scene.albedo(s.material) : glm::vec3(0); });
  add("normal", {"X", "Y", "Z"}, [&](const gpu::Surface& s) {
    return is_hit(s) ? octahedral::unpack_normal(s.normal) : glm::vec3(0);
  });
  add("position", {"X", "Y", "Z"}, [&](const gpu::Surface& s) {
    return is_hit(s) ? glm::vec3(glm::dvec3(s.position) + scene.origin()) : s.position;
  });
  add("motion", {"X", "Y", "Z"}, [](const gpu::Surface& s) { return s.motion; });
  add("depth", {"Z"}, [](const gpu::Surface& s) { return s.depth; });
  add("material", {"id"},
      [&](const gpu::Surface& s) { return is_hit(s) ? float(s.material) : -1.0f; });
  add("feature", {"id"}, [&](const gpu::Surface& s) {
    return is_hit(s) && s.feature != NO_HIT ? float(s.feature) : -1.0f;
  });
}

void add_transmittance_layer(measure::Image& image, std::span<const gpu::Surface> surfaces,
                             const gpu::Air& air, float camera_height) {
  std::vector<float>& values = add_layer(image, "transmittance", {"Y"});
  for (const gpu::Surface& s : surfaces) {
    const float depth = air::optical_depth(air.extinction, air.falloff, camera_height - air.level,
                                           s.position.y - air.level, s.depth);
    values.push_back(s.depth > 0 ? std::exp(-depth) : 1.0f);
  }
}

}  // namespace nightcity::render
