#include "tools/bake/materials.h"

namespace nightcity {
namespace {

// `albedo` is the luminance of the colour; `hue` gives its tint (any scale).
SceneMaterial diffuse(const char* name, float albedo, glm::vec3 hue, float roughness) {
  const float luminance = 0.2126f * hue.x + 0.7152f * hue.y + 0.0722f * hue.z;  // Rec. 709
  return {.name = name, .base_colour = hue * (albedo / luminance), .roughness = roughness};
}

}  // namespace

// Albedos: T. R. Oke, Boundary Layer Climates, 2nd ed. (1987), tables 1.1 and 8.2, which give ranges; the
// value taken stands in the middle unless said otherwise. Hues and roughness are ours: a city by night shows
// little of either.
const std::array<SceneMaterial, bake_material_count>& bake_materials() {
  static const std::array<SceneMaterial, bake_material_count> materials{
      diffuse("wall", 0.35f, {1.0f, 0.94f, 0.85f},
              0.9f),  // brick 0.20-0.40, stone 0.20-0.35, white paint 0.50-0.90
      diffuse("roof", 0.20f, {1.0f, 0.78f, 0.68f}, 0.9f),     // tile 0.10-0.35, tar and gravel 0.08-0.18
      diffuse("ground", 0.20f, {1.0f, 0.98f, 0.95f}, 0.95f),  // concrete 0.10-0.35
      diffuse("window", 0.08f, {0.9f, 1.0f, 1.05f}, 0.1f),    // clear glass, zenith angle under 40 degrees
      diffuse("door", 0.25f, {1.0f, 0.85f, 0.7f}, 0.8f),      // red, brown, green paint 0.20-0.35
      diffuse("road", 0.10f, {1.0f, 1.0f, 1.0f},
              0.85f),  // asphalt 0.05-0.20, worn town streets in the lower half
      diffuse("pavement", 0.20f, {1.0f, 0.98f, 0.95f}, 0.9f),  // concrete 0.10-0.35
      diffuse("terrain", 0.18f, {0.85f, 1.0f, 0.65f}, 1.0f),  // grass 0.16-0.26, dark wet soil 0.05, dry 0.40
      diffuse("water", 0.05f, {0.8f, 1.0f, 1.1f}, 0.05f),     // small zenith angle 0.03-0.10
      diffuse("vegetation", 0.18f, {0.7f, 1.0f, 0.5f}, 1.0f),  // deciduous forest 0.15-0.20
      diffuse("furniture", 0.20f, {1.0f, 1.0f, 1.0f}, 0.7f),   // as painted metal, below
      diffuse("other", 0.25f, {1.0f, 1.0f, 1.0f}, 0.9f),       // urban areas 0.10-0.27
      diffuse("lamp post", 0.20f, {0.95f, 1.0f, 1.0f}, 0.6f),  // red, brown, green paint 0.20-0.35
  };
  return materials;
}

const char* name_of(NodeKind kind) {
  switch (kind) {
    case NodeKind::city:
      return "city";
    case NodeKind::terrain:
      return "terrain";
    case NodeKind::road:
      return "road";
  }
  return "";
}

SurfaceUse use_of(ObjectType object, SurfaceType surface) {
  using M = BakeMaterial;
  switch (object) {
    case ObjectType::relief:
    case ObjectType::land_use:
      return {M::terrain, NodeKind::terrain};
    case ObjectType::water:
      return {M::water, NodeKind::terrain};
    case ObjectType::road:
      return {surface == SurfaceType::auxiliary_traffic_area ? M::pavement : M::road, NodeKind::road};
    case ObjectType::railway:
      return {M::pavement, NodeKind::road};
    case ObjectType::vegetation:
      return {M::vegetation, NodeKind::city};
    case ObjectType::furniture:
      return {M::furniture, NodeKind::city};
    default:
      break;
  }
  switch (surface) {
    case SurfaceType::wall:
    case SurfaceType::closure:
    case SurfaceType::outer_ceiling:
      return {M::wall, NodeKind::city};
    case SurfaceType::roof:
    case SurfaceType::outer_floor:
      return {M::roof, NodeKind::city};
    case SurfaceType::ground:
      return {M::ground, NodeKind::city};
    case SurfaceType::window:
      return {M::window, NodeKind::city};
    case SurfaceType::door:
      return {M::door, NodeKind::city};
    case SurfaceType::traffic_area:
      return {M::road, NodeKind::city};  // a bridge's carriageway: the bridge is one piece
    case SurfaceType::auxiliary_traffic_area:
      return {M::pavement, NodeKind::city};
    case SurfaceType::terrain:
      return {M::terrain, NodeKind::terrain};
    case SurfaceType::water:
      return {M::water, NodeKind::terrain};
    case SurfaceType::unknown:
      break;
  }
  return {M::other, NodeKind::city};
}

}  // namespace nightcity
