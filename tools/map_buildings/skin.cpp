#include "tools/map_buildings/skin.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include "tools/osm/colour_words.h"
#include "tools/osm/tag_values.h"

namespace nightcity::map_buildings {
namespace {

constexpr float white_paint = 0.75f;

struct Made {
  std::string_view name;
  float reflectance;  // Oke 1987, table 8.2, the middle of the range beside it
  glm::vec3 hue;      // an assumption
};
constexpr std::array materials{
    Made{"brick", 0.30f, {1.0f, 0.55f, 0.42f}},       // 0.20-0.40
    Made{"stone", 0.28f, {1.0f, 0.96f, 0.88f}},       // 0.20-0.35
    Made{"sandstone", 0.30f, {1.0f, 0.86f, 0.66f}},   // stone 0.20-0.35
    Made{"limestone", 0.33f, {1.0f, 0.97f, 0.88f}},   // stone 0.20-0.35, pale
    Made{"concrete", 0.22f, {1.0f, 0.98f, 0.95f}},    // 0.10-0.35
    Made{"plaster", 0.50f, {1.0f, 0.96f, 0.88f}},     // white paint 0.50-0.90, aged
    Made{"wood", 0.25f, {1.0f, 0.78f, 0.56f}},        // red, brown, green paint 0.20-0.35
    Made{"glass", 0.08f, {0.9f, 1.0f, 1.05f}},        // clear glass 0.08
    Made{"metal", 0.13f, {1.0f, 1.0f, 1.0f}},         // corrugated iron 0.10-0.16
    Made{"roof_tiles", 0.22f, {1.0f, 0.55f, 0.42f}},  // tile 0.10-0.35
    Made{"slate", 0.10f, {0.95f, 1.0f, 1.05f}},       // 0.10
    Made{"tar_paper", 0.13f, {1.0f, 1.0f, 1.0f}},     // tar and gravel 0.08-0.18
    Made{"gravel", 0.13f, {1.0f, 0.98f, 0.95f}},      // tar and gravel 0.08-0.18
    Made{"copper", 0.25f, {0.55f, 1.0f, 0.80f}},      // green paint 0.20-0.35
    Made{"thatch", 0.18f, {1.0f, 0.85f, 0.60f}},      // 0.15-0.20
    Made{"grass", 0.10f, {0.75f, 1.0f, 0.45f}},       // by light: see tools/ground_cover
    Made{"clay", 0.14f, {1.0f, 0.82f, 0.62f}},        // as soil of tools/ground_cover
};

// Other words of the map (OSM wiki, "Key:building:material", "Key:roof:material") for a surface of
// one of the materials above: what is seen of timber framing is plaster, of asbestos its cement.
struct OtherWord {
  std::string_view word, name;
};
constexpr std::array other_words{
    OtherWord{"bricks", "brick"},
    OtherWord{"red_brick", "brick"},
    OtherWord{"masonry", "stone"},
    OtherWord{"granite", "stone"},
    OtherWord{"natural_stone", "stone"},
    OtherWord{"tiles", "stone"},
    OtherWord{"marble", "limestone"},
    OtherWord{"cement_block", "concrete"},
    OtherWord{"cement", "concrete"},
    OtherWord{"reinforced_concrete", "concrete"},
    OtherWord{"timber_framing", "plaster"},
    OtherWord{"half_timbered", "plaster"},
    OtherWord{"plaster_brick", "plaster"},
    OtherWord{"stucco", "plaster"},
    OtherWord{"render", "plaster"},
    OtherWord{"pebbledash", "plaster"},
    OtherWord{"log", "wood"},
    OtherWord{"timber", "wood"},
    OtherWord{"bamboo", "wood"},
    OtherWord{"vinyl", "plaster"},
    OtherWord{"mirror", "glass"},
    OtherWord{"metal_plates", "metal"},
    OtherWord{"metal_sheet", "metal"},
    OtherWord{"corrugated_metal", "metal"},
    OtherWord{"steel", "metal"},
    OtherWord{"tin", "metal"},
    OtherWord{"zinc", "metal"},
    OtherWord{"aluminium", "metal"},
    OtherWord{"adobe", "clay"},
    OtherWord{"rammed_earth", "clay"},
    OtherWord{"mud", "clay"},
};
constexpr std::array other_roof_words{
    OtherWord{"tile", "roof_tiles"},     OtherWord{"tiles", "roof_tiles"},
    OtherWord{"clay", "roof_tiles"},     OtherWord{"clay_tiles", "roof_tiles"},
    OtherWord{"asphalt", "tar_paper"},   OtherWord{"asphalt_shingle", "tar_paper"},
    OtherWord{"bitumen", "tar_paper"},   OtherWord{"eternit", "concrete"},
    OtherWord{"asbestos", "concrete"},   OtherWord{"fibre_cement", "concrete"},
    OtherWord{"reed", "thatch"},         OtherWord{"palm_leaves", "thatch"},
    OtherWord{"plants", "grass"},        OtherWord{"shingle", "wood"},
    OtherWord{"acrylic_glass", "glass"}, OtherWord{"solar_panels", "glass"},
};

template <std::size_t N>
std::string_view find_other(const std::array<OtherWord, N>& words, std::string_view word) {
  for (const OtherWord& row : words)
    if (row.word == word) return row.name;
  return word;
}

const Made* find_made(std::string_view word, Skin skin) {
  if (skin == Skin::roof) word = find_other(other_roof_words, word);
  word = find_other(other_words, word);
  for (const Made& made : materials)
    if (made.name == word) return &made;
  return nullptr;
}

// IEC 61966-2-1.
float to_linear(float srgb) {
  return srgb <= 0.04045f ? srgb / 12.92f : std::pow((srgb + 0.055f) / 1.055f, 2.4f);
}
float to_srgb(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

template <class Change>
glm::vec3 for_each_channel(const glm::vec3& colour, const Change& change) {
  return {change(colour.x), change(colour.y), change(colour.z)};
}

}  // namespace

std::optional<glm::vec3> find_skin(const osm::OsmTags& tags, Skin skin) {
  const std::string part = skin == Skin::walls ? "building" : "roof";
  for (const std::string& key : {part + ":colour", part + ":color"})
    if (const auto found = tags.find(key); found != tags.end())
      if (const auto rgb = osm::parse_colour(found->second)) {
        const glm::vec3 srgb = glm::vec3(*rgb >> 16 & 255u, *rgb >> 8 & 255u, *rgb & 255u) / 255.0f;
        return for_each_channel(srgb, [](float v) { return to_srgb(white_paint * to_linear(v)); });
      }
  const auto found = tags.find(part + ":material");
  if (found == tags.end()) return std::nullopt;
  for (const std::string_view one : osm::split_list(found->second))
    if (const Made* made = find_made(osm::normalise_tag(one), skin)) {
      const float luminance =
          0.2126f * made->hue.x + 0.7152f * made->hue.y + 0.0722f * made->hue.z;  // Rec. 709
      return for_each_channel(made->hue * (made->reflectance / luminance),
                              [](float v) { return to_srgb(std::min(v, 1.0f)); });
    }
  return std::nullopt;
}

std::vector<std::string> find_unread_skins(const osm::OsmTags& tags) {
  std::vector<std::string> unread;
  for (const Skin skin : {Skin::walls, Skin::roof}) {
    if (find_skin(tags, skin)) continue;
    const std::string part = skin == Skin::walls ? "building" : "roof";
    for (const char* key : {":colour", ":color", ":material"})
      if (const auto found = tags.find(part + key); found != tags.end())
        unread.push_back(found->first + "=" + found->second + ", not understood");
  }
  return unread;
}

}  // namespace nightcity::map_buildings
