#include "runtime/viewer/controls.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "runtime/scene/trace_ray.h"
#include "runtime/viewer/camera_motion.h"

namespace nightcity::viewer {
namespace {

constexpr float radians_per_pixel = 0.005f;
constexpr float min_speed_m_s = 0.5f, max_speed_m_s = 500;
constexpr float full_speed_below_m = 20;  // above the ground; speeds are true below
constexpr float walking_m_s = 1.4f;       // a pedestrian's; Shift runs
constexpr float farthest_m = 1e5f;        // from the origin
constexpr float body_m = 0.3f;            // nearest that a walker comes to a wall
constexpr float max_step_m = 0.6f;        // height of a kerb or stair that a walker climbs
constexpr double sight_m = 20'000;

bool is_usable(const scene::CameraPose& pose) {
  const auto fine = [](const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) &&
           std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}) <= farthest_m;
  };
  return fine(pose.position) && fine(pose.target) &&
         glm::distance(pose.position, pose.target) > 1e-3f;
}

// The horizontal directions to the right and ahead.
std::pair<glm::vec3, glm::vec3> level_axes(const scene::CameraPose& pose) {
  const glm::vec3 ahead = pose.target - pose.position;
  glm::vec3 flat{ahead.x, 0, ahead.z};
  if (glm::length(flat) < 1e-4f * glm::length(ahead)) flat = {pose.up.x, 0, pose.up.z};
  if (glm::length(flat) < 1e-6f) flat = {0, 0, -1};
  flat = glm::normalize(flat);
  return {glm::cross(flat, glm::vec3(0, 1, 0)), flat};
}

void shift(scene::CameraPose& pose, const glm::vec3& step) {
  pose.position += step;
  pose.target += step;
}

// Moves along the level plane so that the point at `depth_m` under the cursor follows it.
void pan(CameraControl& control, const Hands& hands, const glm::vec2& size) {
  const auto [right, ahead] = level_axes(control.pose);
  const float depth_m = control.pivot ? glm::distance(*control.pivot, control.pose.position)
                                      : glm::distance(control.pose.position, control.pose.target);
  const float metres =
      2 * std::tan(glm::radians(control.pose.fov_deg) / 2) * depth_m / std::max(1.0f, size.y);
  // A pixel up the picture is farther along the ground the flatter the view.
  const glm::vec3 view = glm::normalize(control.pose.target - control.pose.position);
  const float slope = std::max(std::abs(view.y), 0.2f);
  shift(control.pose, -hands.pan.x * metres * right + hands.pan.y * metres / slope * ahead);
}

void walk(CameraControl& control, const Hands& hands, const scene::RenderScene& scene) {
  const auto [right, ahead] = level_axes(control.pose);
  const float metres_s = walking_m_s * (hands.fast ? 5.0f : 1.0f);
  const glm::vec3 way = metres_s * (static_cast<float>(hands.held_s.x) * right +
                                    static_cast<float>(hands.held_s.z) * ahead);
  const float length = glm::length(way);
  // In steps shorter than a body, so that no wall is jumped over.
  const int steps = std::min(2000, static_cast<int>(std::ceil(length / (0.5f * body_m))));
  for (int i = 0; i < steps; ++i) {
    const glm::vec3 step = way / float(steps), eye = control.pose.position;
    const glm::vec3 knee = eye - glm::vec3(0, eye_height_m - max_step_m, 0);
    const double reach = double(glm::length(step)) + double(body_m);
    const glm::dvec3 direction = glm::normalize(glm::dvec3(step));
    if (scene::trace_ray(scene, glm::dvec3(eye), direction, reach, MASK_VISIBLE) ||
        scene::trace_ray(scene, glm::dvec3(knee), direction, reach, MASK_VISIBLE))
      return;
    const std::optional<float> ground = find_ground(scene, knee + step);
    if (!ground) return;  // the edge of the model
    shift(control.pose, step + glm::vec3(0, *ground + eye_height_m - eye.y, 0));
  }
}

void scroll(CameraControl& control, const Hands& hands, const scene::RenderScene& scene,
            const glm::vec2& size) {
  if (control.motion == Motion::fly) {
    control.speed_m_s =
        std::clamp(control.speed_m_s * std::pow(1.2f, hands.scroll), min_speed_m_s, max_speed_m_s);
    return;
  }
  if (control.motion == Motion::walk) return;
  const float factor = std::pow(0.9f, hands.scroll);
  const auto point = find_point(scene, control.pose, hands.cursor, size);
  control.pose = point ? zoomed(control.pose, *point, factor) : dollied(control.pose, factor);
}

}  // namespace

glm::vec3 direction_through(const scene::CameraPose& pose, const glm::vec2& pixel,
                            const glm::vec2& size) {
  return scene::direction_through(scene::make_camera(pose, size.x / size.y),
                                  pixel / size * 2.0f - 1.0f);
}

std::optional<glm::vec3> find_point(const scene::RenderScene& scene, const scene::CameraPose& pose,
                                    const glm::vec2& pixel, const glm::vec2& size) {
  const glm::dvec3 direction(direction_through(pose, pixel, size));
  const auto hit =
      scene::trace_ray(scene, glm::dvec3(pose.position), direction, sight_m, MASK_VISIBLE);
  if (!hit) return std::nullopt;
  return glm::vec3(glm::dvec3(pose.position) + hit->distance * direction);
}

std::optional<float> find_ground(const scene::RenderScene& scene, const glm::vec3& from) {
  const auto hit =
      scene::trace_ray(scene, glm::dvec3(from), {0, -1, 0}, double(farthest_m), MASK_VISIBLE);
  if (!hit) return std::nullopt;
  return from.y - static_cast<float>(hit->distance);
}

std::string describe_camera(const scene::RenderScene& scene, const scene::CameraPose& pose) {
  const glm::dvec3 enh = scene.georeference.from_model(glm::dvec3(pose.position));
  std::string text = fmt::format("{:.0f} E, {:.0f} N", enh.x, enh.y);
  if (const std::optional<float> ground = find_ground(scene, pose.position))
    text += fmt::format(", {:.1f} m up", pose.position.y - *ground);
  const glm::vec3 ahead = level_axes(pose).second;
  constexpr const char* points[] = {"north", "north-east", "east", "south-east",
                                    "south", "south-west", "west", "north-west"};
  const double turn = glm::degrees(std::atan2(double(ahead.x), -double(ahead.z)));  // from north
  return text + ", looking " + points[static_cast<std::size_t>(std::lround(turn / 45 + 8)) % 8];
}

float find_speed(const CameraControl& control, std::optional<float> height_m) {
  const float higher =
      control.speed_by_height && height_m ? std::max(1.0f, *height_m / full_speed_below_m) : 1.0f;
  return std::clamp(control.speed_m_s, min_speed_m_s, max_speed_m_s) * higher;
}

void move_camera(CameraControl& control, const Hands& hands, const scene::RenderScene& scene,
                 const glm::vec2& size) {
  const scene::CameraPose before = control.pose;
  if (hands.pressed) control.pivot = find_point(scene, control.pose, hands.cursor, size);
  const glm::vec2 angle = hands.drag * radians_per_pixel;
  if (angle != glm::vec2(0))
    control.pose =
        control.motion == Motion::orbit
            ? orbited(control.pose, control.pivot.value_or(control.pose.target), -angle.x, angle.y)
            : turned(control.pose, angle.x, angle.y);
  if (hands.pan != glm::vec2(0)) pan(control, hands, size);
  if (hands.scroll != 0) scroll(control, hands, scene, size);
  if (hands.held_s != glm::dvec3(0)) {
    if (control.motion == Motion::walk) {
      walk(control, hands, scene);
    } else {
      const std::optional<float> ground = find_ground(scene, control.pose.position);
      const float speed = find_speed(
          control, ground ? std::optional(control.pose.position.y - *ground) : std::nullopt);
      control.pose =
          moved(control.pose, glm::vec3(hands.held_s) * speed * (hands.fast ? 5.0f : 1.0f));
    }
  }
  if (!is_usable(control.pose)) control.pose = before;
}

void begin_to_walk(CameraControl& control, const scene::RenderScene& scene) {
  const std::optional<float> ground = find_ground(scene, control.pose.position);
  if (!ground) return;
  const auto [right, ahead] = level_axes(control.pose);
  control.pose.position.y = *ground + eye_height_m;
  control.pose.target = control.pose.position + 30.0f * ahead;
  control.pose.up = {0, 1, 0};
}

}  // namespace nightcity::viewer
