#include "runtime/viewer/camera_motion.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

namespace nightcity::viewer {
namespace {

constexpr glm::vec3 world_up{0, 1, 0};

// A view direction as two angles in radians: from north (-Z) towards west, and above the horizon.
struct Heading {
  float azimuth;
  float elevation;
};

Heading heading_of(const scene::CameraPose& pose) {
  const glm::vec3 d = glm::normalize(pose.target - pose.position);
  const float elevation = std::asin(std::clamp(d.y, -1.0f, 1.0f));
  glm::vec3 flat{d.x, 0, d.z};
  // Looking straight down, the top of the picture is ahead; looking straight up, it is behind.
  if (glm::length(flat) < 1e-4f) flat = d.y < 0 ? pose.up : -pose.up;
  return {std::atan2(-flat.x, -flat.z), elevation};
}

glm::vec3 direction_of(const Heading& heading) {
  const float limit = glm::radians(max_elevation_deg);
  const float elevation = std::clamp(heading.elevation, -limit, limit);
  return {-std::sin(heading.azimuth) * std::cos(elevation), std::sin(elevation),
          -std::cos(heading.azimuth) * std::cos(elevation)};
}

}  // namespace

bool is_same_pose(const scene::CameraPose& a, const scene::CameraPose& b) {
  return a.position == b.position && a.target == b.target && a.up == b.up && a.fov_deg == b.fov_deg;
}

scene::CameraPose orbited(const scene::CameraPose& pose, float yaw, float pitch) {
  const Heading heading = heading_of(pose);
  // The camera rises when the view direction sinks.
  const glm::vec3 d = direction_of({heading.azimuth + yaw, heading.elevation - pitch});
  scene::CameraPose result = pose;
  result.position = pose.target - d * glm::length(pose.target - pose.position);
  result.up = world_up;
  return result;
}

scene::CameraPose orbited(const scene::CameraPose& pose, const glm::vec3& pivot, float yaw,
                          float pitch) {
  // The turn of the view, about the pivot instead of the target.
  const scene::CameraPose about_target = orbited(pose, yaw, pitch);
  const auto axes = [](const scene::CameraPose& of) {
    const glm::vec3 forward = glm::normalize(of.target - of.position);
    const glm::vec3 right = glm::normalize(glm::cross(forward, of.up));
    return glm::mat3(right, glm::cross(right, forward), forward);
  };
  const glm::mat3 turn = axes(about_target) * glm::transpose(axes(pose));
  scene::CameraPose result = about_target;
  result.position = pivot + turn * (pose.position - pivot);
  result.target = pivot + turn * (pose.target - pivot);
  return result;
}

scene::CameraPose turned(const scene::CameraPose& pose, float yaw, float pitch) {
  const Heading heading = heading_of(pose);
  const glm::vec3 d = direction_of({heading.azimuth + yaw, heading.elevation + pitch});
  scene::CameraPose result = pose;
  result.target = pose.position + d * glm::length(pose.target - pose.position);
  result.up = world_up;
  return result;
}

scene::CameraPose moved(const scene::CameraPose& pose, const glm::vec3& right_up_forward) {
  const glm::vec3 forward = glm::normalize(pose.target - pose.position);
  const glm::vec3 right = glm::normalize(glm::cross(forward, pose.up));
  const glm::vec3 up = glm::cross(right, forward);
  const glm::vec3 step =
      right_up_forward.x * right + right_up_forward.y * up + right_up_forward.z * forward;
  scene::CameraPose result = pose;
  result.position += step;
  result.target += step;
  return result;
}

scene::CameraPose dollied(const scene::CameraPose& pose, float factor) {
  const glm::vec3 offset = pose.position - pose.target;
  const float distance = glm::length(offset);
  scene::CameraPose result = pose;
  result.position = pose.target + offset * (std::clamp(distance * factor, 0.5f, 1e5f) / distance);
  return result;
}

scene::CameraPose zoomed(const scene::CameraPose& pose, const glm::vec3& point, float factor) {
  const glm::vec3 offset = pose.position - point;
  const float distance = glm::length(offset);
  if (!(distance > 0)) return pose;
  const glm::vec3 forward = glm::normalize(pose.target - pose.position);
  scene::CameraPose result = pose;
  result.position = point + offset * (std::clamp(distance * factor, 0.2f, 1e5f) / distance);
  const float depth = std::max(0.1f, glm::dot(point - result.position, forward));
  result.target = result.position + depth * forward;
  return result;
}

}  // namespace nightcity::viewer
