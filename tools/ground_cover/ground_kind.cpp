#include "tools/ground_cover/ground_kind.h"

#include <array>
#include <string>

#include "tools/osm/tag_values.h"

namespace nightcity::ground_cover {
namespace {

// Sources: [O] T. R. Oke, Boundary Layer Climates, 2nd ed. (1987), tables 1.1 and 8.2, which give
// ranges of albedo; a value is the middle of the range unless its row says otherwise. [B] D. E.
// Bowker et al., Spectral Reflectances of Natural Targets for Use in Remote Sensing Studies, NASA
// RP-1139 (1985): plants reflect much of the sun's infrared and little of its light, so their
// albedo does not serve by night. Around 0.55 um most curves of green plants lie between 0.05 and
// 0.15; the place of a row within that is an estimate. Hues and roughness are assumptions.
constexpr std::array<GroundMaterial, ground_kind_count> materials{{
    {"asphalt", 0.10f, {1.0f, 1.0f, 1.0f}, 0.85f},          // [O] 0.05-0.20, worn: lower half
    {"concrete", 0.22f, {1.0f, 0.98f, 0.95f}, 0.9f},        // [O] 0.10-0.35
    {"paving stones", 0.22f, {1.0f, 0.97f, 0.93f}, 0.9f},   // [O] of concrete: 0.10-0.35
    {"sett", 0.20f, {1.0f, 0.98f, 0.97f}, 0.9f},            // [O] stone 0.20-0.35, joints are dark
    {"gravel", 0.20f, {1.0f, 0.95f, 0.88f}, 1.0f},          // [O] soil 0.05-0.40
    {"sand", 0.32f, {1.0f, 0.88f, 0.70f}, 1.0f},            // [O] desert 0.20-0.45
    {"soil", 0.14f, {1.0f, 0.82f, 0.62f}, 1.0f},            // [O] dark to half light: 0.05-0.22
    {"wood", 0.20f, {1.0f, 0.85f, 0.68f}, 0.9f},            // as soil's lighter half
    {"metal", 0.20f, {1.0f, 1.0f, 1.0f}, 0.6f},             // [O] paint 0.20-0.35, worn
    {"tartan", 0.15f, {1.0f, 0.45f, 0.35f}, 0.9f},          // [O] red paint 0.20-0.35, worn
    {"artificial turf", 0.08f, {0.6f, 1.0f, 0.45f}, 1.0f},  // [B] as grass, darker
    {"grass", 0.10f, {0.75f, 1.0f, 0.45f}, 1.0f},           // [B]
    {"scrub", 0.08f, {0.75f, 1.0f, 0.5f}, 1.0f},            // [B] its own shadows in it
    {"woodland floor", 0.07f, {1.0f, 0.9f, 0.6f}, 1.0f},    // [B] leaf litter, lower end
    {"farmland", 0.12f, {0.95f, 1.0f, 0.6f}, 1.0f},         // [B] crops and bare soil
    {"water", 0.04f, {0.8f, 1.0f, 1.1f}, 0.05f},            // [O] high sun 0.03-0.10, deep
    {"ice", 0.30f, {0.92f, 1.0f, 1.05f}, 0.5f},             // [O] of glaciers 0.20-0.40
    {"snow", 0.68f, {1.0f, 1.0f, 1.0f}, 1.0f},              // [O] old 0.40, fresh 0.95
    {"kerb", 0.27f, {1.0f, 0.99f, 0.97f}, 0.9f},            // [O] stone 0.20-0.35
    {"road marking",
     0.50f,
     {1.0f, 1.0f, 1.0f},
     0.8f},  // EN 1436: class Q4, Qd 0.16 cd/(m2 lx) times pi
    // An assumption: stone of [O] 0.20-0.35, dark between its pieces and brown with rust.
    {"ballast", 0.16f, {1.0f, 0.93f, 0.85f}, 1.0f},
    // An assumption: as weathered steel elsewhere; a head is bright in its middle, rusty beside it.
    {"rail", 0.35f, {1.0f, 0.97f, 0.93f}, 0.4f},
}};

struct Word {
  std::string_view value;  // normalised
  GroundKind kind;
};
// OSM wiki, "Key:surface".
constexpr std::array words{
    Word{"asphalt", GroundKind::asphalt},
    Word{"chipseal", GroundKind::asphalt},
    Word{"paved", GroundKind::asphalt},
    Word{"tarmac", GroundKind::asphalt},
    Word{"bitumen", GroundKind::asphalt},
    Word{"concrete", GroundKind::concrete},
    Word{"concrete:plates", GroundKind::concrete},
    Word{"concrete:lanes", GroundKind::concrete},
    Word{"cement", GroundKind::concrete},
    Word{"paving_stones", GroundKind::paving_stones},
    Word{"paving_stones:lanes", GroundKind::paving_stones},
    Word{"bricks", GroundKind::paving_stones},
    Word{"brick", GroundKind::paving_stones},
    Word{"stone", GroundKind::paving_stones},
    Word{"stepping_stones", GroundKind::paving_stones},
    Word{"tiles", GroundKind::paving_stones},
    Word{"sett", GroundKind::sett},
    Word{"cobblestone", GroundKind::sett},
    Word{"cobblestone:flattened", GroundKind::sett},
    Word{"unhewn_cobblestone", GroundKind::sett},
    Word{"gravel", GroundKind::gravel},
    Word{"fine_gravel", GroundKind::gravel},
    Word{"pebblestone", GroundKind::gravel},
    Word{"compacted", GroundKind::gravel},
    Word{"grit", GroundKind::gravel},
    Word{"pebbles", GroundKind::gravel},
    Word{"shingle", GroundKind::gravel},
    Word{"crushed_limestone", GroundKind::gravel},
    Word{"shells", GroundKind::gravel},
    Word{"sand", GroundKind::sand},
    Word{"ground", GroundKind::soil},
    Word{"dirt", GroundKind::soil},
    Word{"earth", GroundKind::soil},
    Word{"mud", GroundKind::soil},
    Word{"clay", GroundKind::soil},
    Word{"unpaved", GroundKind::soil},
    Word{"rock", GroundKind::gravel},
    Word{"ice", GroundKind::ice},
    Word{"snow", GroundKind::snow},
    Word{"grass", GroundKind::grass},
    Word{"grass_paver", GroundKind::grass},
    Word{"artificial_turf", GroundKind::turf},
    Word{"tartan", GroundKind::tartan},
    Word{"rubber", GroundKind::tartan},
    Word{"acrylic", GroundKind::tartan},
    Word{"wood", GroundKind::wood},
    Word{"woodchips", GroundKind::wood},
    Word{"metal", GroundKind::metal},
    Word{"metal_grid", GroundKind::metal},
};

}  // namespace

std::span<const GroundMaterial> ground_materials() {
  return materials;
}

const GroundMaterial& find_material(GroundKind kind) {
  return materials[static_cast<std::size_t>(kind)];
}

std::optional<GroundKind> find_surface(std::string_view value) {
  // The first of several values is that of most of the way.
  const auto parts = osm::split_list(value);
  if (parts.empty()) return std::nullopt;
  const std::string word = osm::normalise_tag(parts.front());
  // Behind a colon stands how something is laid, or the size of its stones: "paving_stones:30".
  for (const std::string_view wanted :
       {std::string_view(word), std::string_view(word).substr(0, word.find(':'))})
    for (const Word& row : words)
      if (row.value == wanted) return row.kind;
  return std::nullopt;
}

}  // namespace nightcity::ground_cover
