// Places that a user names: coordinates, a street, or a city object by its id.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "runtime/scene/camera.h"
#include "runtime/viewer/map_projection.h"

namespace nightcity::viewer {

struct Place {
  glm::vec3 point{0};  // model space, m: on the ground, or the middle of an object
  float radius_m = 0;  // of the object; 0 for a point
  std::string name;    // what was found, in words
  std::optional<scene::CameraPose> stand{};  // a pedestrian's view, on a street
};

/// Returns the place that `text` names: "52.5163, 13.3777" (latitude and longitude, also with N, S,
/// E or W behind), "412013 5761972" (easting and northing in the city's CRS, m), or the name of a
/// street or the id of a city object, of which a part is enough. Of several names and ids the one
/// with number `turn`, from 0 and round and round: the best streets, then objects. Throws Error,
/// which says what there is instead, where there is no such place in the model.
Place find_place(const std::string& text, const scene::RenderScene& scene,
                 const MapProjection& projection, std::size_t turn = 0);

/// Returns the view of a pedestrian on a street, or else a pose that looks at the place from the
/// side from which `before` looks, from above; at the field of view of `before`.
scene::CameraPose look_at_place(const Place& place, const scene::CameraPose& before);

/// Returns where a camera is (describe_camera), and on a second line its latitude and longitude,
/// where the city's CRS tells them.
std::string describe_place(const scene::RenderScene& scene, const MapProjection& projection,
                           const scene::CameraPose& pose);

}  // namespace nightcity::viewer
