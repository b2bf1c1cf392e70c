#include "runtime/viewer/pick.h"

#include <fmt/format.h>

#include <glm/geometric.hpp>

#include "runtime/scene/point_light.h"
#include "runtime/scene/trace_ray.h"
#include "runtime/viewer/controls.h"

namespace nightcity::viewer {
namespace {

constexpr double pick_range_m = 20'000;
constexpr std::size_t most_lights = 10;

std::string describe_sources(const LightProvenance& provenance) {
  std::string text;
  const auto add = [&](const char* what, ValueSource source) {
    text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", what, name_of(source));
  };
  add("position", provenance.position);
  add("height", provenance.height);
  add("flux", provenance.flux);
  add("colour", provenance.colour);
  add("profile", provenance.profile);
  add("schedule", provenance.schedule);
  if (provenance.source_id != 0) text += fmt::format(", source {}", provenance.source_id);
  return text;
}

void describe_object(const scene::RenderScene& scene, std::uint32_t feature,
                     std::vector<std::string>& lines) {
  if (feature >= scene.features.size()) return;
  const SceneFeature& object = scene.features[feature];
  lines.push_back(fmt::format("{} {}", object.type, object.id));
  if (!object.function.empty()) lines.push_back("function " + object.function);
  if (object.measured_height_m)
    lines.push_back(fmt::format("measured height {:.1f} m", *object.measured_height_m));
  if (object.storeys_above_ground)
    lines.push_back(fmt::format("{} storeys", *object.storeys_above_ground));
}

void describe_place(const scene::RenderScene& scene, const Pick& picked,
                    const scene::CameraPose& pose, std::vector<std::string>& lines) {
  const Georeference& reference = scene.georeference;
  const glm::dvec3 enh = reference.from_model(glm::dvec3(picked.point));
  lines.push_back(fmt::format("{:.1f} E, {:.1f} N, {:.1f} m high ({})", enh.x, enh.y, enh.z,
                              reference.crs.empty() ? "the city's own frame" : reference.crs));
  lines.push_back(
      fmt::format("{:.1f} m from the camera", glm::distance(picked.point, pose.position)));
}

}  // namespace

PickedLight describe_light(const scene::RenderScene& scene, std::size_t index) {
  const Light& light = scene.lights[index];
  PickedLight picked{index, {}, 0, 0, 0, {}};
  picked.name =
      fmt::format("{} {:08x}, {:.0f} lm", name_of(scene.families[index]), light.id, light.flux_lm);
  if (index < scene.provenance.size()) picked.sources = describe_sources(scene.provenance[index]);
  return picked;
}

void find_lights(Pick& picked, const scene::RenderScene& scene, double time_s,
                 scene::LightFamilies on) {
  if (picked.emitter) picked.emitter = describe_light(scene, picked.emitter->light);
  picked.strongest.clear();
  const scene::PointLight here = scene::find_light_at(
      scene, glm::dvec3(picked.point), glm::dvec3(picked.normal), time_s, most_lights, on);
  picked.lux = here.lux;
  picked.lights = here.lit;
  for (const scene::LightShare& share : here.strongest) {
    PickedLight one = describe_light(scene, share.light);
    one.lux = share.lux;
    one.share = here.lux > 0 ? share.lux / here.lux : 0;
    one.distance_m = share.distance_m;
    picked.strongest.push_back(std::move(one));
  }
}

std::optional<Pick> pick(const scene::RenderScene& scene, const scene::CameraPose& pose,
                         const glm::vec2& pixel, const glm::vec2& size, double time_s,
                         scene::LightFamilies on) {
  const glm::dvec3 direction(direction_through(pose, pixel, size));
  const auto hit =
      scene::trace_ray(scene, glm::dvec3(pose.position), direction, pick_range_m, MASK_VISIBLE);
  if (!hit) return std::nullopt;
  const glm::dvec3 point = glm::dvec3(pose.position) + hit->distance * direction;
  Pick picked;
  picked.point = glm::vec3(point);
  picked.normal = glm::vec3(hit->normal);
  const gpu::Triangle& triangle = scene.triangles[hit->triangle];
  const gpu::Instance& instance = scene.instances[hit->instance];
  describe_object(scene, instance.feature != NO_HIT ? instance.feature : triangle.feature,
                  picked.lines);
  describe_place(scene, picked, pose, picked.lines);
  const std::uint32_t light = instance.light != NO_HIT ? instance.light : triangle.light;
  if (light < scene.lights.size()) picked.emitter = describe_light(scene, light);

  find_lights(picked, scene, time_s, on);
  return picked;
}

}  // namespace nightcity::viewer
