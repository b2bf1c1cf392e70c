#include "runtime/scene/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>
#include <string_view>

#include "formats/atomic_file.h"
#include "formats/error.h"
#include "formats/json_parse.h"
#include "formats/small_file.h"
#include "runtime/scene/lit_part.h"
#include "runtime/scene/named_street_view.h"
#include "runtime/scene/street_view.h"

namespace nightcity::scene {
namespace {

constexpr std::string_view street_prefix = "street:";

CameraPose overview(const RenderScene& scene) {
  const LitPart focus = find_lit_part(scene);
  CameraPose pose;
  pose.fov_deg = 45;
  pose.target = focus.centre;
  pose.position = focus.centre + focus.radius_m * glm::vec3(-1.0f, 0.8f, 1.25f);
  return pose;
}

CameraPose top(const RenderScene& scene) {
  const LitPart focus = find_lit_part(scene);
  CameraPose pose;
  pose.fov_deg = 45;
  pose.target = focus.centre;
  pose.up = {0, 0, -1};  // north up
  pose.position = focus.centre + glm::vec3(0,
                                           std::max(focus.radius_m / std::tan(glm::radians(22.5f)),
                                                    scene.bounds.upper.y - focus.centre.y + 10.0f),
                                           0);
  return pose;
}

glm::vec3 vector_of(const nlohmann::json& json, const char* key, const std::string& file,
                    const glm::dvec3& origin = glm::dvec3(0)) {
  const nlohmann::json& v = json.at(key);
  if (!v.is_array() || v.size() != 3) throw Error(file, key, "expected three numbers");
  const glm::vec3 out(glm::dvec3(v[0].get<double>(), v[1].get<double>(), v[2].get<double>()) -
                      origin);
  if (!std::isfinite(out.x) || !std::isfinite(out.y) || !std::isfinite(out.z))
    throw Error(file, key, "not a finite number");
  return out;
}

CameraPose read_camera(const std::string& file, const glm::dvec3& origin) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) {
    std::string names;
    for (const std::string& name : camera_presets()) names += (names.empty() ? "" : ", ") + name;
    throw Error(file, "no such camera file, and no preset of that name (" + names + ")");
  }
  return parse_camera(read_small_file(file), file, origin);
}

}  // namespace

gpu::Camera make_camera(const CameraPose& pose, float aspect) {
  const glm::vec3 ahead = pose.target - pose.position;
  const float distance = glm::length(ahead);
  if (!(distance > 0) || !std::isfinite(distance))
    throw Error("camera", "position and target coincide");
  const glm::vec3 forward = ahead / distance;
  // In double, where the squares of any float have room; `up` may have any length but 0.
  const double length = glm::length(glm::dvec3(pose.up));
  if (!(length > 0)) throw Error("camera", "up has no length");
  const glm::vec3 side = glm::cross(forward, glm::vec3(glm::dvec3(pose.up) / length));
  if (!(glm::length(side) > 1e-6f)) throw Error("camera", "up is along the view direction");
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

glm::vec3 direction_through(const gpu::Camera& camera, const glm::vec2& place) {
  return glm::normalize(camera.forward +
                        camera.right * (place.x * camera.tan_half_height * camera.aspect) -
                        camera.up * (place.y * camera.tan_half_height));
}

CameraPose relative_to(const glm::dvec3& origin, const CameraPose& pose) {
  CameraPose result = pose;
  const glm::dvec3 step = pose.origin - origin;
  result.origin = origin;
  result.position = glm::vec3(glm::dvec3(pose.position) + step);
  result.target = glm::vec3(glm::dvec3(pose.target) + step);
  return result;
}

CameraPose parse_camera(const std::string& text, const std::string& source,
                        const glm::dvec3& origin) {
  try {
    const nlohmann::json json = parse_json(text, source);
    CameraPose pose;
    pose.origin = origin;
    pose.position = vector_of(json, "position", source, origin);
    pose.target = vector_of(json, "target", source, origin);
    if (json.contains("up")) pose.up = vector_of(json, "up", source);
    if (json.contains("fov_deg")) pose.fov_deg = json["fov_deg"].get<float>();
    make_camera(pose, 1.0f);  // throws if it is no view
    return pose;
  } catch (const nlohmann::json::exception& error) {
    throw Error(source, "not a camera: " + describe(error));
  }
}

CameraPose find_camera(const std::string& preset_or_file, const RenderScene& scene) {
  if (preset_or_file.starts_with('{')) return parse_camera(preset_or_file, "camera", scene.origin);
  if (preset_or_file.starts_with(street_prefix))
    return find_view_of(scene, preset_or_file.substr(street_prefix.size()));
  CameraPose pose;
  if (preset_or_file == "overview")
    pose = overview(scene);
  else if (preset_or_file == "street")
    pose = find_street_view(scene).value_or(overview(scene));
  else if (preset_or_file == "top")
    pose = top(scene);
  else
    return read_camera(preset_or_file, scene.origin);
  pose.origin = scene.origin;
  return pose;
}

const std::vector<std::string>& camera_presets() {
  static const std::vector<std::string> names{"overview", "street", "top"};
  return names;
}

namespace {

nlohmann::json to_json(const CameraPose& pose) {
  const auto array = [](const auto& v) { return nlohmann::json::array({v.x, v.y, v.z}); };
  const auto place = [&](const glm::vec3& v) {
    return pose.origin == glm::dvec3(0) ? array(v) : array(glm::dvec3(v) + pose.origin);
  };
  return {{"position", place(pose.position)},
          {"target", place(pose.target)},
          {"up", array(pose.up)},
          {"fov_deg", pose.fov_deg}};
}

}  // namespace

std::string to_text(const CameraPose& pose) {
  return to_json(pose).dump();
}

void write_camera(const std::filesystem::path& file, const CameraPose& pose) {
  const std::string text = to_json(pose).dump(2) + "\n";
  AtomicFile out(file);
  out.write(text.data(), text.size());
  out.commit();
}

}  // namespace nightcity::scene
