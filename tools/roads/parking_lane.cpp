#include "tools/roads/parking_lane.h"

#include <array>
#include <string_view>

#include "tools/osm/tag_values.h"

namespace nightcity::roads {
namespace {

// Parallel: 2.00 m wide (RASt 06), 5.70 m long (an assumption: a car of 4.75 m, RASt 06, and the
// room to leave). The others are bays of 2.50 m without the 0.70 m by which cars reach over the
// kerb. Diagonal: at 70 gon 4.60 m deep (RASt 06), 2.81 m along the street (RAR); that is 63
// degrees, and OSM wiki, "Key:orientation", says 45 to 60. Perpendicular: 4.30 m deep (RAR).
constexpr std::array bays{ParkingBay{2.00, 5.70, 0}, ParkingBay{4.60, 2.81, 4.60 * 0.510},
                          ParkingBay{4.30, 2.50, 0}};
constexpr std::array orientation_names{"parallel", "diagonal", "perpendicular"};
constexpr std::array place_names{"lane", "street side", "half on kerb", "on kerb"};
// A tag may give a width from that of a narrow car to that of a lorry across the street.
constexpr double min_width_m = 1.5, max_parked_m = 10;

// Returns PREFIX:right SUFFIX, else PREFIX:both SUFFIX, else "", as written.
std::string text_at(const osm::OsmTags& tags, const std::string& prefix, const char* side,
                    const std::string& suffix) {
  for (const char* name : {side, "both"})
    if (const auto found = tags.find(prefix + ":" + name + suffix); found != tags.end())
      return found->second;
  return {};
}

std::string value_at(const osm::OsmTags& tags, const std::string& prefix, const char* side,
                     const std::string& suffix = {}) {
  return osm::normalise_tag(text_at(tags, prefix, side, suffix));
}

std::optional<ParkingOrientation> find_orientation(const std::string& value) {
  if (value == "parallel" || value == "inline") return ParkingOrientation::parallel;
  if (value == "diagonal") return ParkingOrientation::diagonal;
  if (value == "perpendicular" || value == "orthogonal") return ParkingOrientation::perpendicular;
  return std::nullopt;
}

// The words of both schemes.
std::optional<ParkingPlace> find_place(const std::string& value) {
  if (value == "lane" || value == "yes" || value == "shoulder" || value == "on_street" ||
      value == "painted_area_only")
    return ParkingPlace::lane;
  if (value == "street_side" || value == "lay_by") return ParkingPlace::street_side;
  if (value == "half_on_kerb") return ParkingPlace::half_on_kerb;
  if (value == "on_kerb") return ParkingPlace::on_kerb;
  return std::nullopt;
}

// OSM wiki, "Street parking".
std::optional<ParkingLane> read_new(const osm::OsmTags& tags, const char* side) {
  const auto place = find_place(value_at(tags, "parking", side));
  if (!place) return std::nullopt;
  ParkingLane lane{*place};
  const auto orientation = find_orientation(value_at(tags, "parking", side, ":orientation"));
  lane.orientation = orientation.value_or(ParkingOrientation::parallel);
  lane.orientation_assumed = !orientation;
  lane.marked = value_at(tags, "parking", side, ":markings") == "yes";
  if (const auto m = osm::parse_length_m(text_at(tags, "parking", side, ":width"));
      m && *m >= min_width_m && *m <= max_parked_m)
    lane.width_m = *m;
  lane.surface = text_at(tags, "parking", side, ":surface");
  return lane;
}

// OSM wiki, "Key:parking:lane".
std::optional<ParkingLane> read_old(const osm::OsmTags& tags, const char* side) {
  const std::string key = "parking:lane", value = value_at(tags, key, side);
  const auto orientation = find_orientation(value);
  const bool marked = value == "marked";
  if (!orientation && !marked) return std::nullopt;
  std::string place = value_at(tags, key, side, ":" + value);
  if (place.empty()) place = value_at(tags, key, side, ":inline");
  if (place.empty()) place = value_at(tags, key, side, ":type");
  ParkingLane lane{find_place(place).value_or(ParkingPlace::lane)};
  lane.orientation = orientation.value_or(ParkingOrientation::parallel);
  lane.orientation_assumed = !orientation;
  lane.marked = marked || place == "painted_area_only";
  return lane;
}

}  // namespace

ParkingBay ParkingLane::bay() const {
  ParkingBay bay = bays[static_cast<std::size_t>(orientation)];
  if (width_m) bay.set_depth(*width_m);
  return bay;
}

double ParkingLane::within_edge_m() const {
  switch (place) {
    case ParkingPlace::lane:
      return bay().depth_m;
    case ParkingPlace::half_on_kerb:
      return bay().depth_m / 2;
    default:
      return 0;
  }
}

double ParkingLane::beyond_edge_m() const {
  switch (place) {
    case ParkingPlace::lane:
      return 0;
    case ParkingPlace::half_on_kerb:
      return bay().depth_m / 2;
    default:
      return bay().depth_m;
  }
}

std::string ParkingLane::name() const {
  return std::string(place_names[static_cast<std::size_t>(place)]) + ", " +
         orientation_names[static_cast<std::size_t>(orientation)];
}

std::optional<ParkingLane> read_parking_lane(const osm::OsmTags& tags, const char* side) {
  if (!value_at(tags, "parking", side).empty()) return read_new(tags, side);
  return read_old(tags, side);
}

void drop_parking(osm::OsmTags& tags) {
  std::erase_if(tags, [](const auto& tag) { return tag.first.starts_with("parking:"); });
}

bool is_parking_separate(const osm::OsmTags& tags, const char* side) {
  return value_at(tags, "parking", side) == "separate" ||
         value_at(tags, "parking:lane", side) == "separate";
}

}  // namespace nightcity::roads
