#include "tools/barriers/barrier_kind.h"

#include <algorithm>
#include <array>
#include <string>

#include "tools/osm/tag_values.h"

namespace nightcity::barriers {
namespace {

using M = BarrierMaterial;

// Sources: [O] T. R. Oke, Boundary Layer Climates, 2nd ed. (1987), table 8.2, the middle of the
// range; [B] D. E. Bowker et al., NASA RP-1139 (1985): as scrub of the ground's table. Hues and
// roughness are assumptions.
constexpr std::array<MaterialRow, barrier_material_count> materials{{
    {"barrier masonry", 0.28f, {1.0f, 0.95f, 0.88f}, 0.9f},  // [O] brick 0.20-0.40, stone 0.20-0.35
    {"barrier brick", 0.30f, {1.0f, 0.72f, 0.58f}, 0.9f},    // [O] 0.20-0.40
    {"barrier stone", 0.27f, {1.0f, 0.98f, 0.94f}, 0.9f},    // [O] 0.20-0.35
    {"barrier concrete", 0.22f, {1.0f, 0.98f, 0.95f}, 0.9f},  // [O] 0.10-0.35
    {"barrier wood", 0.20f, {1.0f, 0.85f, 0.68f}, 0.9f},      // as wood of the ground's table
    {"barrier paint", 0.27f, {0.9f, 1.0f, 0.95f}, 0.6f},      // [O] red, brown, green 0.20-0.35
    {"barrier steel", 0.35f, {1.0f, 1.0f, 1.02f}, 0.5f},      // weathered zinc: an assumption
    {"hedge", 0.08f, {0.75f, 1.0f, 0.5f}, 1.0f},              // [B] its own shadows in it
}};

// A fence of bars: 12 cm between them, the most that building codes allow where children may climb
// (DIN 18065), bars of 2 cm, and two rails of 4 cm on 1.25 m: 0.12 / 0.14 * (1 - 0.08 / 1.25).
constexpr double bars_gap = 0.80;
// Chain link: meshes of 50 mm, wire of 3.1 mm (EN 10223-6): (1 - 3.1 / 50)^2.
constexpr double mesh_gap = 0.88;
// Boards of 9 cm, 3 cm apart; three poles of 10 cm on 1.2 m. Both are assumptions.
constexpr double boards_gap = 0.25, poles_gap = 0.75;

// Heights and widths, where no source is named, are assumptions.
constexpr std::array kinds{
    BarrierKind{"city_wall", 6.00, 1.00, M::stone},
    BarrierKind{"retaining_wall", 1.00, 0.30, M::concrete},
    // The highest that needs no permission (BauO Bln, section 61); a brick's length (DIN 105).
    BarrierKind{"wall", 2.00, 0.24, M::masonry},
    BarrierKind{"jersey_barrier", 0.81, 0.61, M::concrete},  // FHWA: 32 inches, 24 at its foot
    BarrierKind{"block", 0.50, 0.50, M::concrete},
    BarrierKind{"hedge", 1.50, 0.80, M::foliage},
    // Neighbours owe each other this where nothing else is usual (NachbG Bln, section 23).
    BarrierKind{"fence", 1.25, 0, M::painted_metal, bars_gap},
    // The single steel rail of RAL-RG 620: 0.31 m high, its top at 0.75 m.
    BarrierKind{"guard_rail", 0.75, 0, M::steel, 1 - 0.31 / 0.75, 1},
};

struct FenceType {
  std::string_view value;  // of the tags `fence_type` and `material`
  double gap;
  BarrierMaterial material;
};
// OSM wiki, "Key:fence_type".
constexpr std::array fence_types{
    FenceType{"metal", bars_gap, M::painted_metal},
    FenceType{"metal_bars", bars_gap, M::painted_metal},
    FenceType{"bars", bars_gap, M::painted_metal},
    FenceType{"railing", bars_gap, M::painted_metal},
    FenceType{"chain_link", mesh_gap, M::steel},
    FenceType{"mesh", mesh_gap, M::steel},
    FenceType{"wire_mesh", mesh_gap, M::steel},
    FenceType{"wood", boards_gap, M::wood},
    FenceType{"picket", boards_gap, M::wood},
    FenceType{"bamboo", boards_gap, M::wood},
    FenceType{"pole", poles_gap, M::wood},
    FenceType{"split_rail", poles_gap, M::wood},
    FenceType{"post_and_rail", poles_gap, M::wood},
    FenceType{"roundpole", poles_gap, M::wood},
    FenceType{"panel", 0, M::wood},
    FenceType{"corrugated_metal", 0, M::steel},
    FenceType{"concrete", 0, M::concrete},
    FenceType{"stone", 0, M::stone},
    FenceType{"slate", 0, M::stone},
    FenceType{"brick", 0, M::brick},
};
// Strands of 3 mm, 0.3 m apart, take 1 % of the light.
constexpr std::array<std::string_view, 5> strands{"wire", "barbed_wire", "electric", "rope",
                                                  "chain"};

struct WallMaterial {
  std::string_view value;  // of the tags `wall` and `material`
  BarrierMaterial material;
};
// OSM wiki, "Key:wall", "Key:material".
constexpr std::array wall_materials{
    WallMaterial{"brick", M::brick},
    WallMaterial{"bricks", M::brick},
    WallMaterial{"stone", M::stone},
    WallMaterial{"dry_stone", M::stone},
    WallMaterial{"natural_stone", M::stone},
    WallMaterial{"gabion", M::stone},
    WallMaterial{"castle_wall", M::stone},
    WallMaterial{"concrete", M::concrete},
    WallMaterial{"reinforced_concrete", M::concrete},
    WallMaterial{"wood", M::wood},
    WallMaterial{"metal", M::painted_metal},
    WallMaterial{"steel", M::steel},
};

template <class Rows>
auto find_row(const Rows& rows, const std::string& value) {
  const auto found =
      std::find_if(rows.begin(), rows.end(), [&](const auto& row) { return row.value == value; });
  return found == rows.end() ? nullptr : &*found;
}

bool lies_elsewhere(const osm::OsmTags& tags) {
  const std::string layer = osm::find_tag(tags, "layer"), level = osm::find_tag(tags, "level"),
                    place = osm::find_tag(tags, "location");
  // normalise_tag makes an underscore of a minus.
  return osm::is_tagged(tags, "tunnel") || osm::find_tag(tags, "indoor") == "yes" ||
         layer.starts_with("_") || (!level.empty() && level != "0") || place == "underground" ||
         place == "indoor" || place == "roof" || place == "rooftop";
}

const char* explain_unknown(const std::string& value) {
  if (value == "kerb") return "kerb: streets have theirs";
  if (value == "handrail" || value == "chain" || value == "rope" || value == "cable_barrier")
    return "rail, chain or rope, thinner than a surface is worth";
  if (value == "bollard" || value == "planter" || value == "log" || value == "tank_trap")
    return "row of bollards or the like";
  if (value.ends_with("gate") || value == "entrance") return "gate, which stands open";
  return "of a kind that is not drawn";
}

// Returns the first of some tags' values that the rows know.
template <class Rows>
auto find_first(const Rows& rows, const osm::OsmTags& tags, const char* key)
    -> decltype(find_row(rows, std::string())) {
  for (const char* name : {key, "material"})
    if (const auto* row = find_row(rows, osm::find_tag(tags, name))) return row;
  return nullptr;
}

void choose_fence(const osm::OsmTags& tags, BarrierDesign& design) {
  const FenceType* type = find_first(fence_types, tags, "fence_type");
  design.assumed_material = !type;
  if (!type) return;
  design.kind.gap = type->gap;
  design.kind.material = type->material;
}

void choose_wall(const osm::OsmTags& tags, BarrierDesign& design) {
  const WallMaterial* row = find_first(wall_materials, tags, "wall");
  design.assumed_material = !row;
  if (row) design.kind.material = row->material;
}

}  // namespace

const MaterialRow& find_material(BarrierMaterial material) {
  return materials[static_cast<std::size_t>(material)];
}

std::span<const BarrierKind> barrier_kinds() {
  return kinds;
}

std::optional<BarrierDesign> read_design(const osm::OsmTags& tags, const char*& reason) {
  // A list ("wall;fence") is the first of its kinds that is drawn.
  const std::string all = osm::find_tag(tags, "barrier");
  const BarrierKind* kind = nullptr;
  for (const std::string_view part : osm::split_list(all))
    if (!kind) kind = find_row(kinds, osm::normalise_tag(part));
  const std::string value = kind ? std::string(kind->value) : all;
  if (!kind) {
    reason = explain_unknown(value);
    return std::nullopt;
  }
  if (lies_elsewhere(tags)) {
    reason = "below the ground, in a building or on a roof";
    return std::nullopt;
  }
  if (std::find(strands.begin(), strands.end(), osm::find_tag(tags, "fence_type")) !=
      strands.end()) {
    reason = "fence of wires, thinner than a surface is worth";
    return std::nullopt;
  }
  BarrierDesign design{*kind};
  if (value == "fence")
    choose_fence(tags, design);
  else if (value != "hedge" && value != "guard_rail")
    choose_wall(tags, design);
  const auto height = osm::find_length_m(tags, {"height", "est_height"}, 0.2, 30);
  const auto width = osm::find_length_m(tags, {"width"}, 0.05, 10);
  design.assumed_height = !height;
  design.kind.height_m = height.value_or(kind->height_m);
  if (kind->width_m > 0) {
    design.assumed_width = !width;
    design.kind.width_m = width.value_or(kind->width_m);
  }
  return design;
}

}  // namespace nightcity::barriers
