#include "tools/map_lights/place_signs.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "tools/osm/tag_values.h"

namespace nightcity::map_lights {
namespace {

constexpr double depth_m = 0.2;         // of a sign's body
constexpr double before_body_m = 0.02;  // as windows stand before their walls
constexpr double step_m = 0.25, farthest_m = 12;
constexpr int column_sides = 6;

// Moves a place out of a building, towards the road. Returns whether it is free then.
bool step_out(glm::dvec2& at, const Ground& ground,
              const std::optional<lights::RoadIndex::Nearest>& road) {
  if (!ground.is_inside(at)) return true;
  if (!road || !(road->distance_m > step_m)) return false;
  const glm::dvec2 towards = (road->point - at) / road->distance_m;
  for (double s = step_m; s <= std::min(farthest_m, road->distance_m); s += step_m)
    if (!ground.is_inside(at + towards * s)) {
      at += towards * s;
      return true;
    }
  return false;
}

lights::LitRectangle make_face(const glm::dvec3& centre, const glm::dvec2& normal, double width_m,
                               double height_m, double luminance) {
  lights::LitRectangle face;
  face.centre = centre + glm::dvec3(normal * before_body_m, 0);
  face.normal = glm::vec3(normal, 0);
  face.along = glm::vec3(-normal.y, normal.x, 0);  // cross(up, normal)
  face.half_width = static_cast<float>(width_m / 2);
  face.half_height = static_cast<float>(height_m / 2);
  face.luminance_cd_m2 = static_cast<float>(luminance);
  return face;
}

}  // namespace

glm::dvec2 SignPlacer::find_facing(const glm::dvec2& lon_lat, const SignTags& tags,
                                   const glm::dvec2& at,
                                   const std::optional<lights::RoadIndex::Nearest>& road) const {
  if (tags.bearing_degrees) {
    // A bearing counts from true north, and the frame has grid north.
    constexpr double step = 1e-4;  // degrees of latitude: 11 m
    const double bearing = glm::radians(*tags.bearing_degrees);
    const double shrink = std::max(0.01, std::cos(glm::radians(lon_lat.y)));
    const glm::dvec2 way = ground_.to_frame(lon_lat + glm::dvec2(step * std::sin(bearing) / shrink,
                                                                 step * std::cos(bearing))) -
                           ground_.to_frame(lon_lat);
    if (const double length = glm::length(way); length > 0 && std::isfinite(length))
      return way / length;
  }
  if (!road) return {0, 1};
  if (tags.sides == 2) return road->along;
  const glm::dvec2 across(-road->along.y, road->along.x), towards = road->point - at;
  return road->distance_m > 0.05 ? towards / glm::length(towards) : across;
}

void SignPlacer::place(const osm::OsmShiningThing& thing, const std::vector<glm::dvec2>& outline,
                       const MapLightOptions& options) {
  const std::string value = osm::find_raw_tag(thing.tags, "advertising");
  const SignDefaults* kind = find_sign(value);
  if (!kind) return out_.leave_out("advertising of a kind that does not shine");
  SignTags tags = read_sign_tags(thing.tags, *kind, half_of(thing));
  for (const auto& [text, count] : tags.unread)
    out_.report().notes["tag not understood: " + text] += count;
  if (!tags.dark.empty()) return out_.leave_out(tags.dark);

  const auto box = find_box(outline);
  glm::dvec2 at = box ? box->centre : outline.front();
  if (!ground_.height_at(at)) return out_.leave_out("outside the model");
  const auto road = roads_.nearest(at);
  const glm::dvec2 mapped = at;
  if (!step_out(at, ground_, road)) return out_.leave_out("inside a building");
  const bool is_moved = at != mapped;
  if (is_moved) tags.sides = std::min(tags.sides, 1);
  glm::dvec2 facing = find_facing(thing.lon_lat.front(), tags, at, road);
  if (box && tags.sides > 0) {  // it lies along its line, and looks to the side of `facing`
    const glm::dvec2 normal = box->across();
    facing = glm::dot(normal, facing) < 0 ? -normal : normal;
    tags.width_m = std::clamp(box->length_m, 0.2, 30.0);
    tags.size = ValueSource::tag;
  }
  const auto height = ground_.height_at(at);
  if (!height) return out_.leave_out("outside the model");
  if (!taken_.take(at)) return out_.leave_out("duplicate");

  ++out_.report().sources["size"][nightcity::name_of(tags.size)];
  ++out_.report().sources["that it shines"][tags.shines == ValueSource::tag ? "tag" : "rule"];
  LitThing lit{thing, MapLightKind::advertising,
               find_hours(MapLightKind::advertising, thing, options, out_.report().notes),
               sign_cct_k};
  lit.position = is_moved ? ValueSource::rule : ValueSource::tag;
  lit.height = tags.size;
  add_faces(
      lit, tags,
      {{at, *height}, facing, tags.width_m, tags.foot_m + tags.height_m, depth_m, tags.sides == 0});
  ++out_.report().kinds[static_cast<std::size_t>(MapLightKind::advertising)].lit;
}

void SignPlacer::add_faces(const LitThing& thing, const SignTags& tags, const Body& body) {
  const glm::dvec3 middle = body.foot + glm::dvec3(0, 0, tags.foot_m + tags.height_m / 2);
  const auto add = [&](const glm::dvec2& normal, double from_middle_m, double width_m) {
    out_.add(thing,
             make_face(middle + glm::dvec3(normal * from_middle_m, 0), normal, width_m,
                       tags.height_m, tags.luminance_cd_m2),
             ValueSource::rule);
  };
  if (body.is_column) {
    const double corner_m = body.width_m / 2;
    for (int k = 0; k < column_sides; ++k) {
      const double angle = std::atan2(body.facing.y, body.facing.x) +
                           (k + 0.5) * 2 * std::numbers::pi / column_sides;
      add({std::cos(angle), std::sin(angle)}, corner_m * std::cos(std::numbers::pi / column_sides),
          corner_m);
    }
  } else {
    add(body.facing, body.depth_m / 2, body.width_m);
    if (tags.sides == 2) add(-body.facing, body.depth_m / 2, body.width_m);
  }
  out_.add(body);
}

}  // namespace nightcity::map_lights
