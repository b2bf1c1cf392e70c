// Materials of the ground and how much light they reflect: one table with its sources, and the
// words of OSM's tag `surface` that name its rows.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string_view>

namespace nightcity::ground_cover {

enum class GroundKind : std::uint8_t {
  asphalt,
  concrete,
  paving_stones,
  sett,
  gravel,
  sand,
  soil,
  wood,
  metal,
  tartan,
  turf,
  grass,
  scrub,
  woodland,
  farmland,
  water,
  ice,
  snow,
  kerb,
  paint,
  ballast,
  rail,
  count
};
constexpr std::size_t ground_kind_count = static_cast<std::size_t>(GroundKind::count);

struct GroundMaterial {
  const char* name;
  float reflectance;  // diffuse, of visible light: the luminance of the colour
  glm::vec3 hue;      // its tint, linear Rec. 709 on any scale
  float roughness;    // below 0.1 it mirrors as a water film does
};

/// Returns the rows of all kinds, in order.
std::span<const GroundMaterial> ground_materials();
const GroundMaterial& find_material(GroundKind kind);

/// Returns the kind that a value of the tag `surface` names; none where there is none.
std::optional<GroundKind> find_surface(std::string_view value);

}  // namespace nightcity::ground_cover
