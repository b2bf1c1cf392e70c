#include "tools/citygml/heights.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "formats/to_lower.h"
#include "tools/city/attributes.h"
#include "tools/citygml/tag_scanner.h"
#include "tools/citygml/xlinks.h"

namespace nightcity::citygml {
namespace {

// Values of ElevationReferenceValue (CityGML 3.0, code list of INSPIRE), the fittest first. The
// bottom of a construction may lie below the ground.
constexpr std::array<std::string_view, 8> tops{
    "highestRoofEdge", "topOfConstruction", "highestPoint", "generalRoofEdge",
    "generalRoof",     "highestEave",       "generalEave",  "lowestRoofEdge"};
constexpr std::array<std::string_view, 6> feet{"lowestGroundPoint",      "generalGround",
                                               "entrancePoint",          "highestGroundPoint",
                                               "lowestFloorAboveGround", "bottomOfConstruction"};

template <std::size_t N>
std::size_t rank_of(const std::array<std::string_view, N>& names, std::string_view name) {
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

// A code may be written with the list that it is of.
std::string_view to_code(std::string_view text) {
  text = city::trim(text);
  return text.substr(std::min(text.find_last_of("/:#") + 1, text.size()));
}

// A position of one number is a height, of three one with its place.
std::optional<double> to_height(std::string_view text) {
  text = city::trim(text);
  const std::size_t blank = text.find_last_of(" \t\r\n");
  const auto z = city::parse_number(blank == text.npos ? text : text.substr(blank + 1));
  return z && !city::is_sentinel(*z) ? z : std::nullopt;
}

}  // namespace

void read_height(const pugi::xml_node& property, city::CityObject& object) {
  for (const pugi::xml_node& height : property.children()) {
    for (const pugi::xml_node& part : height.children()) {
      if (local_name(part.name()) != "value") continue;
      city::CityObject one;
      city::set_attribute(one, "measuredheight", part.child_value(), find_attribute(part, "uom"));
      if (one.measured_height_m > object.measured_height_m)
        object.measured_height_m = one.measured_height_m;
    }
  }
}

bool read_generic(const pugi::xml_node& property, city::NamedHeights& heights) {
  const std::string_view kind = local_name(property.name());
  std::string_view name = find_attribute(property, "name"), value, unit;
  bool takes_all = true;
  for (const pugi::xml_node& part : property.children()) {
    if (part.type() != pugi::node_element) continue;
    const std::string_view here = local_name(part.name());
    if (here == "name") name = part.child_value();
    if (here == "value") {
      value = part.child_value();
      unit = find_attribute(part, "uom");
    } else if (here.ends_with("Attribute")) {
      takes_all = read_generic(part, heights) && takes_all;
    }
  }
  if (kind == "genericAttributeSet" || kind == "genericAttribute") return takes_all;
  const std::string lower = to_lower(name);
  if (!kind.ends_with("Attribute") || !city::NamedHeights::knows(lower)) return false;
  heights.take(lower, value, unit);
  return true;
}

void Elevations::read(const pugi::xml_node& property) {
  for (const pugi::xml_node& elevation : property.children()) {
    std::string_view reference;
    std::optional<double> z;
    for (const pugi::xml_node& part : elevation.children()) {
      if (local_name(part.name()) == "elevationReference") reference = to_code(part.child_value());
      if (local_name(part.name()) == "elevationValue") z = to_height(part.child_value());
    }
    if (!z) continue;
    if (const std::size_t rank = rank_of(tops, reference); rank < std::min(tops.size(), top_.rank))
      top_ = {rank, *z};
    if (const std::size_t rank = rank_of(feet, reference); rank < std::min(feet.size(), foot_.rank))
      foot_ = {rank, *z};
  }
}

std::optional<double> Elevations::span() const {
  const bool knows_both = top_.rank < tops.size() && foot_.rank < feet.size();
  return knows_both && top_.z > foot_.z ? std::optional(top_.z - foot_.z) : std::nullopt;
}

}  // namespace nightcity::citygml
