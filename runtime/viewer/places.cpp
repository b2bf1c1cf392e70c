#include "runtime/viewer/places.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <optional>
#include <regex>
#include <utility>
#include <vector>

#include "formats/error.h"
#include "formats/to_lower.h"
#include "runtime/scene/named_street_view.h"
#include "runtime/scene/street_names.h"
#include "runtime/viewer/controls.h"

namespace nightcity::viewer {
namespace {

Error not_found(const std::string& text, const std::string& reason) {
  return Error("go to", "'" + text + "': " + reason);
}

struct Numbers {
  double first, second;
  std::string first_side, second_side;  // N, S, E, W or ""
};

std::optional<Numbers> parse_numbers(const std::string& text) {
  static const std::regex form(
      R"(^\s*([-+]?\d+(?:\.\d+)?)\s*(?:°|deg)?\s*([NSEWnsew]?)\s*[,;\s]\s*([-+]?\d+(?:\.\d+)?)\s*(?:°|deg)?\s*([NSEWnsew]?)\s*$)");
  std::smatch match;
  if (text.size() > 200 || !std::regex_match(text, match, form)) return std::nullopt;
  const auto side = [](std::string letter) {
    for (char& c : letter) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return letter;
  };
  return Numbers{std::stod(match[1]), std::stod(match[3]), side(match[2]), side(match[4])};
}

// Returns latitude and longitude where the numbers can be these.
std::optional<glm::dvec2> to_degrees(Numbers numbers, bool projected) {
  const auto is = [](const std::string& side, const char* letters) {
    return side.empty() || std::string(letters).find(side) != std::string::npos;
  };
  if (is(numbers.first_side, "EW") && is(numbers.second_side, "NS") &&
      !(numbers.first_side + numbers.second_side).empty()) {
    std::swap(numbers.first, numbers.second);
    std::swap(numbers.first_side, numbers.second_side);
  }
  if (!is(numbers.first_side, "NS") || !is(numbers.second_side, "EW")) return std::nullopt;
  if (std::abs(numbers.first) > 90 || std::abs(numbers.second) > 180) return std::nullopt;
  if (!projected) return std::nullopt;
  return glm::dvec2(numbers.first_side == "S" ? -numbers.first : numbers.first,
                    numbers.second_side == "W" ? -numbers.second : numbers.second);
}

Place find_point(const std::string& text, const glm::dvec2& plane,
                 const scene::RenderScene& scene) {
  const glm::dvec3 at = scene.georeference.to_model({plane.x, plane.y, 0});
  const glm::dvec3 lower(scene.bounds.lower), upper(scene.bounds.upper);
  if (at.x < lower.x || at.x > upper.x || at.z < lower.z || at.z > upper.z) {
    const glm::dvec3 middle = 0.5 * (lower + upper);
    throw not_found(text,
                    fmt::format("this lies {:.1f} km from the middle of the model, outside it",
                                std::hypot(at.x - middle.x, at.z - middle.z) / 1000));
  }
  glm::vec3 point(at.x, upper.y + 1, at.z);
  point.y = find_ground(scene, point).value_or(float(lower.y));
  return {point, 0, fmt::format("{:.0f} E, {:.0f} N", plane.x, plane.y)};
}

// Returns how far latitude and longitude, which have no place on the city's plane, are from its
// middle, as on a sphere.
std::string describe_remoteness(const glm::dvec2& degrees, const scene::RenderScene& scene,
                                const MapProjection& projection) {
  const glm::dvec3 middle = scene.georeference.from_model(
      0.5 * (glm::dvec3(scene.bounds.lower) + glm::dvec3(scene.bounds.upper)));
  const auto city = projection.to_degrees({middle.x, middle.y});
  if (!city) return "the city's CRS does not reach there";
  const auto direction_of = [](const glm::dvec2& at) {
    const double latitude = glm::radians(at.x), longitude = glm::radians(at.y);
    return glm::dvec3(std::cos(latitude) * std::cos(longitude),
                      std::cos(latitude) * std::sin(longitude), std::sin(latitude));
  };
  constexpr double mean_radius_km = 6371;  // of the Earth
  const double cosine = glm::dot(direction_of(degrees), direction_of(*city));
  return fmt::format("this lies {:.1f} km from the middle of the model, outside it",
                     mean_radius_km * std::acos(std::clamp(cosine, -1.0, 1.0)));
}

// Returns the corners of a mesh's triangles: those of one city object, or all where none is given.
std::vector<glm::vec3> find_corners(const scene::RenderScene& scene, const scene::Mesh& mesh,
                                    std::optional<std::uint32_t> feature) {
  std::vector<glm::vec3> corners;
  for (std::uint32_t i = mesh.first_triangle; i < mesh.first_triangle + mesh.triangles; ++i) {
    const gpu::Triangle& triangle = scene.triangles[i];
    if (!feature || triangle.feature == *feature)
      corners.insert(corners.end(), {triangle.v0, triangle.v1, triangle.v2});
  }
  return corners;
}

// The bounds of a city object: of its triangles wherever their meshes stand, and of the instances
// that it is.
std::optional<scene::Box> find_bounds(const scene::RenderScene& scene, std::uint32_t feature) {
  scene::Box box;
  bool any = false;
  for (const scene::Mesh& mesh : scene.meshes) {
    const std::vector<glm::vec3> own = find_corners(scene, mesh, feature);
    for (const gpu::Instance& instance : scene.instances) {
      if (instance.root != mesh.root) continue;
      const bool is_whole = instance.feature == feature;
      if (!is_whole && (own.empty() || instance.feature != NO_HIT)) continue;
      const glm::dmat4 to_object = glm::transpose(
          glm::dmat4(glm::dvec4(instance.to_object[0]), glm::dvec4(instance.to_object[1]),
                     glm::dvec4(instance.to_object[2]), glm::dvec4(0, 0, 0, 1)));
      const glm::dmat4 to_model = glm::inverse(to_object);
      for (const glm::vec3& corner : is_whole ? find_corners(scene, mesh, {}) : own) {
        box.grow(glm::vec3(to_model * glm::dvec4(glm::dvec3(corner), 1)));
        any = true;
      }
    }
  }
  return any ? std::optional(box) : std::nullopt;
}

// Returns the city objects whose ids contain the text, or the one whose id it is.
std::vector<std::uint32_t> find_objects(const std::string& text, const scene::RenderScene& scene) {
  const std::string wanted = to_lower(text);
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < scene.features.size(); ++i) {
    const std::string id = to_lower(scene.features[i].id);
    if (id == wanted) return {i};
    if (id.find(wanted) != std::string::npos) found.push_back(i);
  }
  return found;
}

Place stand_on(const NamedStreet& street, const scene::RenderScene& scene) {
  scene::NamedStreetView view = scene::find_view_of(scene, street);
  return {view.pose.target, 0, street.name + (view.from_above ? " (from above)" : ""), view.pose};
}

// Returns nothing where the object has no surfaces of its own.
std::optional<Place> find_object(std::uint32_t feature, const scene::RenderScene& scene) {
  const std::optional<scene::Box> box = find_bounds(scene, feature);
  if (!box) return std::nullopt;
  const SceneFeature& object = scene.features[feature];
  return Place{0.5f * (box->lower + box->upper), 0.5f * glm::distance(box->lower, box->upper),
               object.type + " " + object.id};
}

std::string describe_names(const scene::RenderScene& scene) {
  if (scene.places.streets.empty())
    return "there are no names of streets in this scene: its map had none, or an older nightbake "
           "made it";
  return fmt::format("none of the {} streets and squares has it in its name",
                     scene.places.streets.size());
}

// Returns ", the first of 3 whose names contain ...", with what Enter goes to next.
std::string describe_turn(const std::string& text, std::size_t turn, std::size_t streets,
                          std::size_t objects) {
  const std::size_t count = streets + objects;
  const char* what = objects == 0 ? "names" : streets == 0 ? "ids" : "names or ids";
  const std::string which = turn == 0 ? "the first" : fmt::format("number {}", turn + 1);
  return fmt::format(", {} of {} whose {} contain \"{}\"; Enter goes to the next", which, count,
                     what, text);
}

// Returns the street or object with that number, and where it has no place, the next.
Place find_named(const std::string& text, const scene::RenderScene& scene, std::size_t turn) {
  const std::vector<std::size_t> streets = scene::find_streets(scene.places.streets, text);
  const std::vector<std::uint32_t> objects = find_objects(text, scene);
  const std::size_t count = streets.size() + objects.size();
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t number = (turn + i) % count;
    std::optional<Place> place = number < streets.size()
                                     ? stand_on(scene.places.streets[streets[number]], scene)
                                     : find_object(objects[number - streets.size()], scene);
    if (!place) continue;
    if (count > 1) place->name += describe_turn(text, turn % count, streets.size(), objects.size());
    return *place;
  }
  throw not_found(text, fmt::format("no city object of {} has this in its id, and {}. Latitude and "
                                    "longitude, or easting and northing, are understood too",
                                    scene.features.size(), describe_names(scene)));
}

}  // namespace

Place find_place(const std::string& text, const scene::RenderScene& scene,
                 const MapProjection& projection, std::size_t turn) {
  if (text.find_first_not_of(" \t") == std::string::npos) throw not_found(text, "nothing is named");
  const std::optional<Numbers> numbers = parse_numbers(text);
  if (!numbers) return find_named(text, scene, turn);
  if (const auto degrees = to_degrees(*numbers, projection.is_usable())) {
    const auto plane = projection.to_plane(degrees->x, degrees->y);
    if (!plane) throw not_found(text, describe_remoteness(*degrees, scene, projection));
    Place place = find_point(text, *plane, scene);
    place.name = fmt::format("{:.5f}, {:.5f}: {}", degrees->x, degrees->y, place.name);
    return place;
  }
  if (!numbers->first_side.empty() && !projection.is_usable())
    throw not_found(text, scene.georeference.crs.empty()
                              ? "this city has no CRS, so it has no latitude and longitude"
                              : "this scene's file has no latitude and longitude, which a bake "
                                "adds where it can; this "
                                "city is in " +
                                    scene.georeference.crs);
  return find_point(text, {numbers->first, numbers->second}, scene);
}

scene::CameraPose look_at_place(const Place& place, const scene::CameraPose& before) {
  if (place.stand) {
    scene::CameraPose pose = *place.stand;
    pose.fov_deg = before.fov_deg;
    return pose;
  }
  constexpr float steepness_deg = 35, nearest_m = 60;
  glm::vec3 ahead = before.target - before.position;
  ahead.y = 0;
  ahead = glm::length(ahead) > 1e-3f ? glm::normalize(ahead) : glm::vec3(0, 0, -1);
  const float half_view = glm::radians(std::min(before.fov_deg, 120.0f) / 2);
  const float distance_m = std::max(nearest_m, 1.3f * place.radius_m / std::sin(half_view));
  const float down = std::sin(glm::radians(steepness_deg)),
              level = std::cos(glm::radians(steepness_deg));
  scene::CameraPose pose = before;
  pose.target = place.point;
  pose.position = place.point - distance_m * (level * ahead - glm::vec3(0, down, 0));
  pose.up = {0, 1, 0};
  return pose;
}

std::string describe_place(const scene::RenderScene& scene, const MapProjection& projection,
                           const scene::CameraPose& pose) {
  std::string text = describe_camera(scene, pose);
  const glm::dvec3 plane = scene.georeference.from_model(glm::dvec3(pose.position));
  if (const auto degrees = projection.to_degrees({plane.x, plane.y}))
    text += fmt::format("\n{:.5f}, {:.5f} (latitude, longitude)", degrees->x, degrees->y);
  return text;
}

}  // namespace nightcity::viewer
