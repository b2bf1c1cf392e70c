#include "runtime/scene/camera.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

#include "formats/atomic_file.h"
#include "formats/error.h"
#include "formats/input_file.h"
#include "runtime/scene/brute_force.h"

namespace nightcity::scene {
namespace {

constexpr float eye_height_m = 1.7f;

glm::vec3 lights_median(const RenderScene& scene) {
  glm::vec3 median(0);
  std::vector<float> values(scene.lights.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::transform(scene.lights.begin(), scene.lights.end(), values.begin(),
                   [&](const Light& light) { return light.position[axis]; });
    std::nth_element(values.begin(),
                     values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
    median[axis] = values[values.size() / 2];
  }
  return median;
}

struct Focus {
  glm::vec3 centre;
  float radius;  // horizontal extent of the part worth seeing, m
};

// Returns the lit part of the city: around the median lamp, out to the distance that contains nine
// tenths of the lamps.
Focus lit_part(const RenderScene& scene) {
  if (scene.bounds.empty()) return {glm::vec3(0), 10};
  const glm::vec3 middle = 0.5f * (scene.bounds.lower + scene.bounds.upper);
  const glm::vec3 size = scene.bounds.upper - scene.bounds.lower;
  if (scene.lights.size() < 4)
    return {{middle.x, scene.bounds.lower.y, middle.z},
            std::max(1.0f, 0.5f * std::max(size.x, size.z))};
  const glm::vec3 centre = lights_median(scene);
  std::vector<float> distances;
  for (const Light& light : scene.lights)
    distances.push_back(std::hypot(light.position.x - centre.x, light.position.z - centre.z));
  const auto nth = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() * 9 / 10);
  std::nth_element(distances.begin(), nth, distances.end());
  return {centre, std::clamp(*nth, 20.0f, 600.0f)};
}

CameraPose overview(const RenderScene& scene) {
  const Focus focus = lit_part(scene);
  CameraPose pose;
  pose.fov_deg = 45;
  pose.target = focus.centre;
  pose.position = focus.centre + focus.radius * glm::vec3(-1.0f, 0.8f, 1.25f);
  return pose;
}

CameraPose top(const RenderScene& scene) {
  const Focus focus = lit_part(scene);
  CameraPose pose;
  pose.fov_deg = 45;
  pose.target = focus.centre;
  pose.up = {0, 0, -1};  // north up
  pose.position = focus.centre + glm::vec3(0,
                                           std::max(focus.radius / std::tan(glm::radians(22.5f)),
                                                    scene.bounds.upper.y - focus.centre.y + 10.0f),
                                           0);
  return pose;
}

// Beside a lamp one stands in the street; below a window one would stand in the house.
bool is_in_the_street(LightKind kind) {
  switch (kind) {
    case LightKind::sphere:
      return true;
    case LightKind::rectangle:
      return false;
  }
  return false;
}

bool is_lamp(const Light& light) {
  return is_in_the_street(light_kind(light)) && light.flux_lm > 0;
}

// Returns whether nothing is overhead: the place is neither under a tree nor inside a house.
bool open_sky(const RenderScene& scene, const glm::vec3& eye) {
  return !brute_force_hit(scene, glm::dvec3(eye), {0.0, 1.0, 0.0}, 1e30, MASK_SHADOW).has_value();
}

// Returns a pedestrian's view near a lamp, towards the farthest open direction along which other
// lamps stand.
CameraPose street(const RenderScene& scene) {
  if (scene.lights.empty()) return overview(scene);
  const Focus focus = lit_part(scene);
  std::vector<const Light*> nearest;
  // In a scene without lamps any light will do.
  const bool lamps_there = std::any_of(scene.lights.begin(), scene.lights.end(), is_lamp);
  for (const Light& light : scene.lights)
    if (light.flux_lm > 0 && (!lamps_there || is_lamp(light))) nearest.push_back(&light);
  const auto centre_distance = [&](const Light* light) {
    return std::hypot(light->position.x - focus.centre.x, light->position.z - focus.centre.z);
  };
  std::sort(nearest.begin(), nearest.end(),
            [&](auto* a, auto* b) { return centre_distance(a) < centre_distance(b); });
  if (nearest.size() > 40) nearest.resize(40);

  CameraPose best = overview(scene);
  float best_score = 0;
  for (const Light* lamp : nearest) {
    // Out from the post towards the road, down to the ground, up to eye height.
    const glm::vec3 out = glm::length(glm::vec3(lamp->tangent.x, 0, lamp->tangent.z)) > 0.5f
                              ? glm::normalize(glm::vec3(lamp->tangent.x, 0, lamp->tangent.z))
                              : glm::vec3(1, 0, 0);
    const glm::vec3 above = lamp->position + 3.0f * out;
    const auto down = brute_force_hit(scene, above, {0, -1, 0}, 60, MASK_SHADOW);
    if (!down) continue;
    const glm::vec3 eye = above - glm::vec3(0, float(*down) - eye_height_m, 0);
    if (eye.y > lamp->position.y || !open_sky(scene, eye)) continue;  // on a roof, or indoors
    for (int turn = 0; turn < 16; ++turn) {
      const float angle = glm::radians(22.5f * float(turn));
      const glm::vec3 ahead(std::cos(angle), 0, std::sin(angle));
      const float open =
          float(brute_force_hit(scene, eye, ahead, 250, MASK_SHADOW).value_or(250.0));
      float lamps = 0;
      for (const Light& other : scene.lights) {
        const glm::vec3 to = other.position - eye;
        const float along = glm::dot(to, ahead);
        if (along > 5 && along < open && glm::length(to - along * ahead) < 0.4f * along)
          lamps += 1.0f / (1.0f + along / 60.0f);
      }
      const float score = lamps * std::sqrt(std::min(open, 120.0f));
      if (score > best_score) {
        best_score = score;
        best.position = eye;
        best.target = eye + 30.0f * ahead + glm::vec3(0, 1.5f, 0);
        best.up = {0, 1, 0};
        best.fov_deg = 65;
      }
    }
  }
  return best;
}

glm::vec3 vector_of(const nlohmann::json& json, const char* key, const std::string& file) {
  const nlohmann::json& v = json.at(key);
  if (!v.is_array() || v.size() != 3) throw Error(file, key, "expected three numbers");
  const glm::vec3 out(v[0].get<float>(), v[1].get<float>(), v[2].get<float>());
  if (!std::isfinite(out.x) || !std::isfinite(out.y) || !std::isfinite(out.z))
    throw Error(file, key, "not a finite number");
  return out;
}

CameraPose read_camera(const std::string& file) {
  refuse_special_file(file);
  std::ifstream in(file);
  if (!in) {
    std::string names;
    for (const std::string& name : camera_presets()) names += (names.empty() ? "" : ", ") + name;
    throw Error(file, "no such camera file, and no preset of that name (" + names + ")");
  }
  try {
    const nlohmann::json json = nlohmann::json::parse(in);
    CameraPose pose;
    pose.position = vector_of(json, "position", file);
    pose.target = vector_of(json, "target", file);
    if (json.contains("up")) pose.up = vector_of(json, "up", file);
    if (json.contains("fov_deg")) pose.fov_deg = json["fov_deg"].get<float>();
    make_camera(pose, 1.0f);  // throws if it is no view
    return pose;
  } catch (const nlohmann::json::exception& e) {
    throw Error(file, std::string("not a camera: ") + e.what());
  }
}

}  // namespace

gpu::Camera make_camera(const CameraPose& pose, float aspect) {
  const glm::vec3 ahead = pose.target - pose.position;
  const float distance = glm::length(ahead);
  if (!(distance > 0) || !std::isfinite(distance))
    throw Error("camera", "position and target coincide");
  const glm::vec3 forward = ahead / distance;
  const glm::vec3 side = glm::cross(forward, pose.up);
  if (!(glm::length(side) > 1e-6f * glm::length(pose.up)))
    throw Error("camera", "up is along the view direction");
  if (!(pose.fov_deg > 0 && pose.fov_deg <= 179))
    throw Error("camera", "fov_deg must be in (0, 179]");
  gpu::Camera camera{};
  camera.position = pose.position;
  camera.forward = forward;
  camera.right = glm::normalize(side);
  camera.up = glm::cross(camera.right, forward);
  camera.tan_half_height = std::tan(0.5f * glm::radians(pose.fov_deg));
  camera.aspect = aspect;
  return camera;
}

CameraPose find_camera(const std::string& preset_or_file, const RenderScene& scene) {
  if (preset_or_file == "overview") return overview(scene);
  if (preset_or_file == "street") return street(scene);
  if (preset_or_file == "top") return top(scene);
  return read_camera(preset_or_file);
}

const std::vector<std::string>& camera_presets() {
  static const std::vector<std::string> names{"overview", "street", "top"};
  return names;
}

void write_camera(const std::filesystem::path& file, const CameraPose& pose) {
  const auto array = [](const glm::vec3& v) { return nlohmann::json::array({v.x, v.y, v.z}); };
  const nlohmann::json json{{"position", array(pose.position)},
                            {"target", array(pose.target)},
                            {"up", array(pose.up)},
                            {"fov_deg", pose.fov_deg}};
  const std::string text = json.dump(2) + "\n";
  AtomicFile out(file);
  out.write(text.data(), text.size());
  out.commit();
}

}  // namespace nightcity::scene
