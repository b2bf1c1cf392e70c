// Writes the lights of a scene for other programs: KHR_lights_punctual and EXT_lights_ies.
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "formats/finite.h"
#include "formats/gltf_constants.h"
#include "formats/scene_writer_state.h"

namespace nightcity {
namespace {

using nlohmann::json;

// Returns the rotation that turns -z, along which a spot of KHR_lights_punctual shines, to
// `direction`.
glm::dquat turn_spot_to(const glm::dvec3& direction) {
  const glm::dvec3 from(0, 0, -1), to = glm::normalize(direction);
  const double cosine = glm::dot(from, to);
  if (cosine < -0.999999) return {0, 0, 1, 0};  // half a turn: the cross product below vanishes
  const glm::dvec3 axis = glm::cross(from, to);
  return glm::normalize(glm::dquat(1 + cosine, axis.x, axis.y, axis.z));
}

}  // namespace

void SceneWriter::add_punctual(const ScenePunctual& light) {
  State& s = *state_;
  s.check(light);
  json node = {
      {"translation", gltf::to_json(light.position)},
      {"extensions", {{gltf::lights_punctual, {{"light", s.write_light_description(light)}}}}}};
  if (light.outer_rad != 0) node["rotation"] = gltf::to_json(turn_spot_to(light.direction));
  s.stream.extensions_used.insert(gltf::lights_punctual);
  s.nodes.add(node);
}

void SceneWriter::State::check(const ScenePunctual& light) const {
  const std::string place = "punctual light " + std::to_string(nodes.count());
  if (!finite(light.position) || !finite(light.direction) || !finite(light.colour) ||
      !(max_of(light.colour) > 0) || min_of(light.colour) < 0 ||
      !std::isfinite(light.intensity_cd) || !(light.intensity_cd > 0))
    fail(place, "a value is not finite or not positive");
  constexpr double max_cone = 1.5708;  // pi / 2 and what rounding may add to it
  if (light.outer_rad != 0 &&
      !(light.inner_rad >= 0 && light.inner_rad < light.outer_rad && light.outer_rad < max_cone))
    fail(place, "the cone's angles are out of order");
}

std::size_t SceneWriter::State::write_light_description(const ScenePunctual& light) {
  const bool is_spot = light.outer_rad != 0;
  // The extension's colour channels end at 1, so a stronger channel scales the intensity.
  const double strongest = max_of(light.colour);
  json description = {{"type", is_spot ? "spot" : "point"},
                      {"color", gltf::to_json(glm::dvec3(light.colour) / strongest)},
                      {"intensity", light.intensity_cd * strongest}};
  if (is_spot)
    description["spot"] = {{"innerConeAngle", light.inner_rad},
                           {"outerConeAngle", light.outer_rad}};
  const auto [known, is_new] = known_punctual.try_emplace(description.dump(), punctual.count());
  if (is_new) punctual.add(description);
  return known->second;
}

std::uint32_t SceneWriter::add_ies_profile(std::string_view text) {
  State& s = *state_;
  const std::size_t view = s.stream.write_view(std::span<const char>(text));
  return static_cast<std::uint32_t>(
      s.ies.add({{"bufferView", view}, {"mimeType", "application/x-ies-lm-63"}}));
}

void SceneWriter::add_ies_light(const SceneIesLight& light) {
  State& s = *state_;
  const std::string place = "light " + std::to_string(s.nodes.count());
  if (light.profile >= s.ies.count()) s.fail(place, "its profile is not there");
  const double strongest = max_of(light.colour);
  if (!finite(light.position) || !finite(light.axis) || !finite(light.tangent) ||
      !finite(light.colour) || min_of(light.colour) < 0 || !(strongest > 0) ||
      !std::isfinite(light.multiplier) || !(light.multiplier > 0))
    s.fail(place, "a value is not finite or not positive");
  // The extension aims a light along -z, and has C = 0 towards x.
  const glm::dvec3 x = glm::normalize(glm::dvec3(light.tangent)),
                   z = -glm::normalize(glm::dvec3(light.axis));
  const glm::dquat rotation(glm::dmat3(x, glm::cross(z, x), z));
  s.nodes.add({{"translation", gltf::to_json(light.position)},
               {"rotation", gltf::to_json(glm::normalize(rotation))},
               {"extensions",
                {{gltf::lights_ies,
                  {{"light", light.profile},
                   {"multiplier", light.multiplier * strongest},
                   {"color", gltf::to_json(glm::dvec3(light.colour) / strongest)}}}}}});
  s.stream.extensions_used.insert(gltf::lights_ies);
}

}  // namespace nightcity
