// From mouse and held keys to the camera.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "runtime/scene/camera.h"
#include "runtime/scene/render_scene.h"

namespace nightcity::viewer {

enum class Motion { orbit, fly, walk };

/// The height of a pedestrian's eye above the ground, m.
constexpr float eye_height_m = 1.7f;

/// The mouse's movements since the last frame of the panel, less those that the panel took for
/// itself.
struct Hands {
  glm::vec2 drag{0};     // pixels, left button
  glm::vec2 pan{0};      // pixels, right or middle button
  float scroll = 0;      // notches, positive away from the user
  glm::vec2 cursor{0};   // pixels
  bool clicked = false;  // the left button was pressed and released in one place
  bool pressed = false;  // the left button went down
  // Seconds for which the keys for right, up and forward were held, less those of their opposites.
  glm::dvec3 held_s{0};
  bool fast = false;  // Shift is held
};

/// The camera and how it moves.
struct CameraControl {
  scene::CameraPose pose;
  Motion motion = Motion::orbit;
  float speed_m_s = 10;            // flying, at 20 m above the ground and below
  bool speed_by_height = true;     // faster above that, in proportion
  std::optional<glm::vec3> pivot;  // the point that a drag orbits about; else the pose's target
};

/// Returns the point of the scene that a pixel of a window of `size` pixels shows.
std::optional<glm::vec3> find_point(const scene::RenderScene& scene, const scene::CameraPose& pose,
                                    const glm::vec2& pixel, const glm::vec2& size);

/// Returns the unit direction through a pixel.
glm::vec3 direction_through(const scene::CameraPose& pose, const glm::vec2& pixel,
                            const glm::vec2& size);

/// Returns the height of the ground or roof below a point, m in model space; nothing where there is
/// none.
std::optional<float> find_ground(const scene::RenderScene& scene, const glm::vec3& from);

/// Returns where a camera is and which way it looks: "412008 E, 5761972 N, 24 m up, looking
/// north-east". Coordinates are those of the city's CRS; heights are above what is below the
/// camera.
std::string describe_camera(const scene::RenderScene& scene, const scene::CameraPose& pose);

/// Returns the speed of flight of a camera this high above the ground, m/s.
float find_speed(const CameraControl& control, std::optional<float> height_m);

/// Moves the camera. Coordinates stay finite and within 100 km of the origin. Walking keeps the
/// eye above the ground and out of walls.
void move_camera(CameraControl& control, const Hands& hands, const scene::RenderScene& scene,
                 const glm::vec2& size);

/// Puts a camera that starts to walk on the ground below it, looking level.
void begin_to_walk(CameraControl& control, const scene::RenderScene& scene);

}  // namespace nightcity::viewer
