#include "tools/bake/scene/materials.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

namespace nightcity::bake {
namespace {

// `albedo` is the luminance of the colour; `hue` gives its tint, on any scale.
SceneMaterial diffuse(const char* name, float albedo, glm::vec3 hue, float roughness) {
  const float luminance = 0.2126f * hue.x + 0.7152f * hue.y + 0.0722f * hue.z;  // Rec. 709
  return {.name = name, .base_colour = hue * (albedo / luminance), .roughness = roughness};
}

constexpr MaterialCode coloured = 0x80, kind_bits = 0x7F;
static_assert(bake_material_count + ground_cover::ground_kind_count +
                  barriers::barrier_material_count <=
              coloured);
constexpr std::size_t max_colours = 2000;
constexpr MaterialCode first_barrier = to_code(barriers::BarrierMaterial{});

std::optional<Skin> to_skin(MaterialCode code) {
  const MaterialCode bits = code >> 8;
  if ((code & coloured) != 0 || bits == 0) return std::nullopt;
  return Skin{static_cast<Finish>((bits - 1) / 256), static_cast<std::uint8_t>((bits - 1) % 256)};
}

// Returns "roof tiles 2" for the second shade of tiles.
SceneMaterial make_skin_material(const SceneMaterial& kind, Skin skin) {
  const FinishRow& row = find_finish(skin.finish);
  const std::string name = kind.name + " " + row.name + " " + std::to_string(skin.shade + 1);
  return diffuse(name.c_str(), find_reflectance(skin), row.tints[skin.shade], kind.roughness);
}

glm::vec3 to_srgb(MaterialCode code) {
  return glm::vec3(code >> 8 & 0xFFu, code >> 16 & 0xFFu, code >> 24 & 0xFFu) / 255.0f;
}

// IEC 61966-2-1.
float linear(float srgb) {
  return srgb <= 0.04045f ? srgb / 12.92f : std::pow((srgb + 0.055f) / 1.055f, 2.4f);
}

}  // namespace

MaterialCode to_code(BakeMaterial kind, const glm::vec3& colour) {
  MaterialCode code = to_code(kind) | coloured;
  for (int i = 0; i < 3; ++i) {
    const float value = std::clamp(colour[i], 0.0f, 1.0f);  // NaN becomes 0
    code |= static_cast<MaterialCode>(std::lround((value > 0 ? value : 0) * 255)) << (8 + 8 * i);
  }
  return code;
}

std::optional<ground_cover::GroundKind> to_ground_kind(MaterialCode code) {
  const MaterialCode kind = code & kind_bits;
  if (kind < bake_material_count || kind >= first_barrier) return std::nullopt;
  return static_cast<ground_cover::GroundKind>(kind - bake_material_count);
}

SceneMaterial find_material(MaterialCode code) {
  const MaterialCode kind = code & kind_bits;
  if (kind >= first_barrier) {
    const auto material = static_cast<barriers::BarrierMaterial>(kind - first_barrier);
    const barriers::MaterialRow& row = barriers::find_material(material);
    return diffuse(row.name, row.reflectance, row.hue, row.roughness);
  }
  const auto ground = to_ground_kind(code);
  if (!ground) return bake_materials()[kind];
  const ground_cover::GroundMaterial& row = ground_cover::find_material(*ground);
  return diffuse(row.name, row.reflectance, row.hue, row.roughness);
}

bool is_of_kind(MaterialCode code, BakeMaterial kind) {
  return (code & kind_bits) == to_code(kind);
}

bool is_of_kind(std::string_view name, std::string_view kind) {
  return name.starts_with(kind) && (name.size() == kind.size() || name[kind.size()] == ' ');
}

MaterialTable::MaterialTable(SceneWriter& writer) : writer_(writer) {
  for (const SceneMaterial& material : bake_materials()) writer_.add_material(material);
}

std::uint32_t MaterialTable::find_index(MaterialCode code) {
  if ((code & coloured) != 0) return find_coloured(code);
  const auto skin = to_skin(code);
  if (!skin && code < bake_material_count) return code;
  const auto [known, is_new] = plain_.try_emplace(code, 0);
  if (is_new) {
    const SceneMaterial kind = find_material(code);
    known->second = writer_.add_material(skin ? make_skin_material(kind, *skin) : kind);
  }
  return known->second;
}

std::uint32_t MaterialTable::add_pictured(MaterialCode code, std::uint32_t picture) {
  SceneMaterial material = find_material(code);
  material.name += " picture " + std::to_string(picture);
  material.texture.emplace();
  material.texture->picture = picture;
  material.texture->wrap_u = material.texture->wrap_v = TextureWrap::clamp;
  return writer_.add_material(material);
}

std::uint32_t MaterialTable::find_coloured(MaterialCode code) {
  const auto found = coloured_.find(code);
  if (found != coloured_.end()) return found->second;
  if (coloured_.size() >= max_colours) {
    const auto distance = [code](MaterialCode other) {
      const glm::vec3 d = to_srgb(code) - to_srgb(other);
      return glm::dot(d, d) + (((code ^ other) & kind_bits) == 0 ? 0.0f : 4.0f);
    };
    return std::min_element(
               coloured_.begin(), coloured_.end(),
               [&](const auto& a, const auto& b) { return distance(a.first) < distance(b.first); })
        ->second;
  }
  const glm::vec3 srgb = to_srgb(code);
  SceneMaterial material = find_material(code);
  char name[16];
  std::snprintf(name, sizeof name, " #%02X%02X%02X", code >> 8 & 0xFFu, code >> 16 & 0xFFu,
                code >> 24 & 0xFFu);
  material.name += name;
  material.base_colour = {linear(srgb.x), linear(srgb.y), linear(srgb.z)};
  return coloured_[code] = writer_.add_material(material);
}

// Albedos: T. R. Oke, Boundary Layer Climates, 2nd ed. (1987), tables 1.1 and 8.2, which give
// ranges; the value here is the middle of the range unless a comment says otherwise. Hues and
// roughness are assumptions: a city by night shows little of either.
const std::array<SceneMaterial, bake_material_count>& bake_materials() {
  static const std::array<SceneMaterial, bake_material_count> materials{
      diffuse("wall", 0.35f, {1.0f, 0.94f, 0.85f},
              0.9f),  // brick 0.20-0.40, stone 0.20-0.35, white paint 0.50-0.90
      diffuse("roof", 0.20f, {1.0f, 0.78f, 0.68f},
              0.9f),  // tile 0.10-0.35, tar and gravel 0.08-0.18
      diffuse("ground", 0.20f, {1.0f, 0.98f, 0.95f}, 0.95f),  // concrete 0.10-0.35
      diffuse("window", 0.08f, {0.9f, 1.0f, 1.05f},
              0.1f),  // clear glass, zenith angle under 40 degrees
      diffuse("door", 0.25f, {1.0f, 0.85f, 0.7f}, 0.8f),  // red, brown, green paint 0.20-0.35
      diffuse("road", 0.10f, {1.0f, 1.0f, 1.0f},
              0.85f),  // asphalt 0.05-0.20, worn town streets in the lower half
      diffuse("pavement", 0.20f, {1.0f, 0.98f, 0.95f}, 0.9f),  // concrete 0.10-0.35
      diffuse("terrain", 0.18f, {0.85f, 1.0f, 0.65f},
              1.0f),  // grass 0.16-0.26, dark wet soil 0.05, dry 0.40
      diffuse("water", 0.05f, {0.8f, 1.0f, 1.1f}, 0.05f),      // small zenith angle 0.03-0.10
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
    case NodeKind::barrier:
      return "barrier";
    case NodeKind::bridge:
      return "bridge";
  }
  return "";
}

SurfaceUse find_use(city::ObjectType object, city::SurfaceType surface) {
  using M = BakeMaterial;
  switch (object) {
    case city::ObjectType::relief:
    case city::ObjectType::land_use:
      return {M::terrain, NodeKind::terrain};
    case city::ObjectType::water:
      return {M::water, NodeKind::terrain};
    case city::ObjectType::road:
      return {surface == city::SurfaceType::auxiliary_traffic_area ? M::pavement : M::road,
              NodeKind::road};
    case city::ObjectType::railway:
      return {M::pavement, NodeKind::road};
    case city::ObjectType::vegetation:
      return {M::vegetation, NodeKind::city};
    case city::ObjectType::furniture:
      return {M::furniture, NodeKind::city};
    default:
      break;
  }
  switch (surface) {
    case city::SurfaceType::wall:
    case city::SurfaceType::closure:
    case city::SurfaceType::outer_ceiling:
      return {M::wall, NodeKind::city};
    case city::SurfaceType::roof:
    case city::SurfaceType::outer_floor:
      return {M::roof, NodeKind::city};
    case city::SurfaceType::ground:
      return {M::ground, NodeKind::city};
    case city::SurfaceType::window:
      return {M::window, NodeKind::city};
    case city::SurfaceType::door:
      return {M::door, NodeKind::city};
    case city::SurfaceType::traffic_area:
      return {M::road, NodeKind::city};  // a bridge's carriageway: the bridge is one piece
    case city::SurfaceType::auxiliary_traffic_area:
      return {M::pavement, NodeKind::city};
    case city::SurfaceType::terrain:
      return {M::terrain, NodeKind::terrain};
    case city::SurfaceType::water:
      return {M::water, NodeKind::terrain};
    case city::SurfaceType::unknown:
      break;
  }
  return {M::other, NodeKind::city};
}

}  // namespace nightcity::bake
