#include "tools/bake/scene/lamp_models.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <tuple>
#include <vector>

#include "tools/bake/scene/shapes.h"

namespace nightcity::bake {
namespace {

using std::numbers::pi;
constexpr std::size_t lamps_in_node = 8'192;  // lamps in one node

// Sizes of common street furniture, m. They decide what a lamp looks like, and have no effect on
// its light.
constexpr float post_radius = 0.06f;
constexpr float arm_radius = 0.03f;
constexpr float housing_length = 0.55f, housing_height = 0.10f, housing_width = 0.26f;
constexpr double arm_clearance = 0.02;  // between a post and the ball beside or above it

// A box from the origin along +x, its underside at y = 0.
ScenePrimitive box(float length, float height, float width, std::uint32_t material) {
  ScenePrimitive p;
  p.material = material;
  for (const float x : {0.0f, length})
    for (const float y : {0.0f, height})
      for (const float z : {-width / 2, width / 2}) p.positions.push_back({x, y, z});
  p.indices = {0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1,
               2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3};
  return p;
}

// Octahedron, every face split in four and pushed out to the unit sphere: 32 triangles, 18
// vertices.
ScenePrimitive ball(std::uint32_t material) {
  ScenePrimitive p;
  p.material = material;
  p.positions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  constexpr std::array<std::array<std::uint32_t, 3>, 8> faces{
      {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [found, is_new] =
        middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(p.positions.size()));
    if (is_new) p.positions.push_back(glm::normalize(p.positions[a] + p.positions[b]));
    return found->second;
  };
  for (const auto& [a, b, c] : faces) {
    const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    p.indices.insert(p.indices.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
  }
  return p;
}

// Rotation about the vertical that takes +x to the horizontal direction (east, north).
glm::mat4 heading(const glm::dvec2& direction) {
  return glm::rotate(glm::mat4(1), static_cast<float>(std::atan2(direction.y, direction.x)),
                     {0, 1, 0});
}

// Lamps whose balls look alike share a mesh and a material.
using LampLook = std::tuple<float, float, float, float, float>;  // flux, radius, colour
LampLook to_lamp_look(const lights::PlacedLamp& lamp) {
  return {static_cast<float>(lamp.flux_lm), static_cast<float>(lamp.radius_m), lamp.colour.x,
          lamp.colour.y, lamp.colour.z};
}

// The lamps of one batch make one node for each shape, so that memory does not grow with the map.
// Each shape is written once.
class LampModels {
 public:
  LampModels(SceneWriter& writer, const Georeference& georeference, std::uint32_t post_material)
      : writer_(writer), georeference_(georeference), post_material_(post_material) {}

  // `first` is the number of lamps[0] in city.lights.
  void add(std::span<const lights::PlacedLamp> lamps, std::size_t first);

 private:
  void add_balls(std::span<const lights::PlacedLamp> lamps, std::size_t first,
                 std::span<const glm::mat4> places);
  void add_node(SceneNode& node, std::optional<std::uint32_t>& mesh, const char* name,
                const std::function<ScenePrimitive()>& shape) {
    if (node.instances.empty()) return;
    if (!mesh) mesh = writer_.add_mesh({name, {shape()}});
    node.mesh = *mesh;
    writer_.add_node(node);
  }

  SceneWriter& writer_;
  const Georeference& georeference_;
  std::uint32_t post_material_;
  std::optional<std::uint32_t> post_, arm_, housing_;
  std::map<LampLook, std::uint32_t> balls_;
};

void LampModels::add_balls(std::span<const lights::PlacedLamp> lamps, std::size_t first,
                           std::span<const glm::mat4> places) {
  std::map<LampLook, SceneNode> nodes;
  for (std::size_t i = 0; i < lamps.size(); ++i)
    if (lamps[i].radius_m > 0)  // a point has no size to show
      nodes[to_lamp_look(lamps[i])].instances.push_back(
          {glm::scale(places[i], glm::vec3(static_cast<float>(lamps[i].radius_m))),
           static_cast<std::uint32_t>(first + i)});
  for (auto& [look, node] : nodes) {
    const auto [known, is_new] = balls_.try_emplace(look, 0);
    if (is_new) {
      const auto [flux, radius, r, g, b] = look;
      const double luminance = double{flux} / (4 * pi * pi * double{radius} * double{radius});
      const SceneMaterial material{
          .name = "luminaire",
          .base_colour = glm::vec3(0.8f),
          .emission_cd_m2 = glm::vec3(r, g, b) * static_cast<float>(luminance),
          .double_sided = false};
      known->second = writer_.add_mesh({"luminaire", {ball(writer_.add_material(material))}});
    }
    node.name = "luminaires";
    node.kind = "lamp";
    node.casts_shadow = false;
    node.mesh = known->second;
    writer_.add_node(node);
  }
}

void LampModels::add(std::span<const lights::PlacedLamp> lamps, std::size_t first) {
  SceneNode posts{"lamp posts", "lamp", 0, true, {}}, arms{"lamp arms", "lamp", 0, true, {}};
  SceneNode housings{"lamp housings", "lamp", 0, false, {}};
  std::vector<glm::mat4> centres;
  std::set<std::tuple<double, double, float>> known_posts;
  for (const lights::PlacedLamp& lamp : lamps) {
    const glm::vec3 foot(georeference_.to_model(lamp.foot));
    const glm::dvec3 luminous = lamp.foot + glm::dvec3(lamp.outreach, lamp.mounting_height_m);
    centres.push_back(glm::translate(glm::mat4(1), glm::vec3(georeference_.to_model(luminous))));
    // The housing lies on the ball, so that the ball is seen below it; an arm meets it from behind.
    // Without an arm the post ends under the ball, because a light inside its post would light
    // nothing.
    const auto radius = static_cast<float>(std::max(lamp.radius_m, 0.0));
    const double reach = glm::length(lamp.outreach);
    const bool has_arm = reach > double{post_radius} + double{radius} + arm_clearance;
    const glm::dvec2 direction = has_arm ? lamp.outreach / reach : lamp.aim;
    const float clearance = radius * 0.3f;
    const float arm_height = static_cast<float>(lamp.mounting_height_m) + clearance;
    const float height =
        has_arm ? arm_height : static_cast<float>(lamp.mounting_height_m - arm_clearance) - radius;
    const bool new_post = known_posts.emplace(lamp.foot.x, lamp.foot.y, height).second;
    if (height > 0 && new_post && !lamp.hung)  // several luminaires may share a post
      posts.instances.push_back(
          {glm::scale(glm::translate(glm::mat4(1), foot), {1, height, 1}), no_id});
    if (has_arm) {
      const glm::mat4 place =
          glm::translate(glm::mat4(1), foot + glm::vec3(0, height, 0)) * heading(direction);
      arms.instances.push_back({glm::scale(place, {static_cast<float>(reach), 1, 1}), no_id});
    }
    glm::mat4 housing = centres.back() * heading(direction);
    housing = glm::rotate(housing, static_cast<float>(glm::radians(lamp.tilt_degrees)), {0, 0, 1});
    housing = glm::translate(housing, {-housing_length / 2, clearance, 0});
    housings.instances.push_back({housing, no_id});
  }
  add_node(posts, post_, "lamp post", [&] { return make_prism(post_radius, 8, post_material_); });
  add_node(arms, arm_, "lamp arm",
           [&] { return box(1, 2 * arm_radius, 2 * arm_radius, post_material_); });
  add_node(housings, housing_, "lamp housing",
           [&] { return box(housing_length, housing_height, housing_width, post_material_); });
  add_balls(lamps, first, centres);
}

}  // namespace

void add_lamp_models(SceneWriter& writer, std::span<const lights::PlacedLamp> lamps,
                     const Georeference& georeference, std::uint32_t post_material) {
  LampModels models(writer, georeference, post_material);
  for (std::size_t first = 0; first < lamps.size();) {
    std::size_t end = std::min(lamps.size(), first + lamps_in_node);
    while (end < lamps.size() && lamps[end].foot == lamps[end - 1].foot)
      ++end;  // one post, several luminaires
    models.add(lamps.subspan(first, end - first), first);
    first = end;
  }
}

}  // namespace nightcity::bake
