// Kinds of barriers, what they are made of and how large they are where no tag says so: one table
// each, with its sources.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string_view>

#include "tools/osm/osm_data.h"

namespace nightcity::barriers {

enum class BarrierMaterial : std::uint8_t {
  masonry,
  brick,
  stone,
  concrete,
  wood,
  painted_metal,
  steel,
  foliage,
  count
};
constexpr std::size_t barrier_material_count = static_cast<std::size_t>(BarrierMaterial::count);

struct MaterialRow {
  const char* name;
  float reflectance;  // diffuse, of visible light: the luminance of the colour
  glm::vec3 hue;      // its tint, linear Rec. 709 on any scale
  float roughness;
};
const MaterialRow& find_material(BarrierMaterial material);

struct BarrierKind {
  std::string_view value;  // of the tag `barrier`
  double height_m;
  double width_m;  // 0: a sheet, which light passes where it has a gap
  BarrierMaterial material;
  double gap = 0;  // the share of light that passes it
  int rails = 0;   // of a sheet with a gap; 0: one every rail_spacing_m
};

/// Distance of the rails of a sheet whose kind does not count them, m.
constexpr double rail_spacing_m = 0.25;

/// Returns the kinds that are drawn: solid ones first, then sheets.
std::span<const BarrierKind> barrier_kinds();

/// A barrier as its tags describe it.
struct BarrierDesign {
  BarrierKind kind;
  bool assumed_height = false, assumed_width = false, assumed_material = false;
};

/// Returns the design of a way's barrier; none where it is not drawn, and then `reason` says why.
/// Heights of 0.2 to 30 m and widths of 0.05 to 10 m count, others say nonsense.
std::optional<BarrierDesign> read_design(const osm::OsmTags& tags, const char*& reason);

}  // namespace nightcity::barriers
