#include "tools/town/osm_writer.h"

#include <GeographicLib/UTMUPS.hpp>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "tools/random.h"
#include "tools/town/approaches.h"
#include "tools/town/roads.h"

namespace nightcity::town {
namespace {

using glm::dvec2;

constexpr std::int64_t first_lamp_id = 4000000000, first_way_id = 90000000,
                       first_approach_id = 5000000000, first_corner_id = 7000000000,
                       first_area_id = 190000000;
/// A luminaire post before it is written.
struct Post {
  dvec2 at;
  double bearing_degrees;  // from the post to the road, clockwise from north
  StreetClass street;
  int luminaires;
  std::int64_t number;
};

class OsmWriter {
 public:
  OsmWriter(TextFile& out, const StreetPlan& streets, const TownOptions& options)
      : out_(out), streets_(streets), options_(options) {}

  std::size_t write() {
    out_ << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<osm version=\"0.6\" "
            "generator=\"nightbake town\">\n";
    for (int j = 0; j <= streets_.rows(); ++j)
      for (int i = 0; i <= streets_.columns(); ++i)
        open_node(crossing_id(i, j), streets_.node(i, j)) << "/>\n";
    for_each_stretch(streets_, [&](const Stretch& s) {
      if (s.axis != 2) return;
      open_node(path_node_id(s, 0), s.from) << "/>\n";
      open_node(path_node_id(s, 1), s.to) << "/>\n";
    });
    for_each_stretch(streets_, [&](const Stretch& s) {
      for (const Approach& approach : find_approaches(streets_, s, options_.seed))
        write_approach(s, approach);
    });
    for_each_area([&](int i, int j, BlockUse) {
      const Quad corners = streets_.kerb(i, j);
      for (int k = 0; k < 4; ++k)
        open_node(corner_id(i, j, k), corners[static_cast<std::size_t>(k)]) << "/>\n";
    });
    const std::size_t lamps = write_lamps();
    write_ways();
    for_each_area([&](int i, int j, BlockUse use) { write_area(i, j, use); });
    out_ << "</osm>\n";
    return lamps;
  }

 private:
  std::int64_t crossing_id(int i, int j) const {
    return 1000000000 + static_cast<std::int64_t>(j) * (streets_.columns() + 1) + i;
  }
  std::int64_t path_node_id(const Stretch& s, int end) const {
    return 2000000000 + 2 * (static_cast<std::int64_t>(s.j) * streets_.columns() + s.i) + end;
  }

  std::int64_t corner_id(int i, int j, int corner) const {
    return first_corner_id + (static_cast<std::int64_t>(j) * streets_.columns() + i) * 4 + corner;
  }

  std::int64_t approach_id(const Stretch& s, const Approach& approach) const {
    return first_approach_id +
           ((static_cast<std::int64_t>(s.axis) * (streets_.rows() + 1) + s.j) *
                (streets_.columns() + 1) +
            s.i) *
               max_approaches +
           approach.number;
  }

  void write_approach(const Stretch& s, const Approach& approach) {
    open_node(approach_id(s, approach), approach.at) << ">\n";
    const char* direction = approach.at_end ? "forward" : "backward";
    switch (approach.kind) {
      case Approach::Kind::zebra:
        tag("highway", "crossing");
        tag("crossing", "zebra");
        break;
      case Approach::Kind::crossing_at_signals:
        tag("highway", "crossing");
        tag("crossing", "traffic_signals");
        tag("crossing:markings", "zebra");
        break;
      case Approach::Kind::unmarked_crossing:
        tag("highway", "crossing");
        tag("crossing", "unmarked");
        tag("kerb", "lowered");
        break;
      case Approach::Kind::signals:
        tag("highway", "traffic_signals");
        tag("traffic_signals:direction", direction);
        break;
      case Approach::Kind::give_way:
        tag("highway", "give_way");
        tag("direction", direction);
        break;
    }
    out_ << "</node>\n";
  }

  /// Visits the blocks whose ground is not that of gardens and yards, which maps say nothing of.
  template <class Visit>
  void for_each_area(const Visit& visit) const {
    for (int j = 0; j < streets_.rows(); ++j)
      for (int i = 0; i < streets_.columns(); ++i)
        if (const BlockUse use = streets_.use(i, j);
            use == BlockUse::market || use == BlockUse::park || use == BlockUse::slabs ||
            use == BlockUse::hall)
          visit(i, j, use);
  }

  /// An area reaches to the kerbs of its block: pavements lie over it.
  void write_area(int i, int j, BlockUse use) {
    out_ << "<way id=\"" << first_area_id + static_cast<std::int64_t>(j) * streets_.columns() + i
         << "\" version=\"1\">\n";
    for (const int k : {0, 1, 2, 3, 0}) out_ << "<nd ref=\"" << corner_id(i, j, k) << "\"/>\n";
    switch (use) {
      case BlockUse::market:
        tag("highway", "pedestrian");
        tag("area", "yes");
        tag("name", "Market Square");
        tag("surface", "paving_stones");
        break;
      case BlockUse::park:
        tag("leisure", "park");
        break;
      case BlockUse::slabs:
        tag("landuse", "grass");
        break;
      default:
        tag("amenity", "parking");
        tag("surface", "concrete");
        break;
    }
    out_ << "</way>\n";
  }

  TextFile& open_node(std::int64_t id, const dvec2& p) {
    double latitude, longitude;
    GeographicLib::UTMUPS::Reverse(33, true, p.x + options_.origin_east_m,
                                   p.y + options_.origin_north_m, latitude, longitude);
    out_ << "<node id=\"" << id << "\" version=\"1\" lat=\"";
    out_.fixed(latitude, 7) << "\" lon=\"";
    return out_.fixed(longitude, 7) << "\"";
  }

  void tag(std::string_view key, std::string_view value) {
    out_ << "<tag k=\"" << key << "\" v=\"" << value << "\"/>\n";
  }

  /// Returns the number of lamps that a stretch needs: its length over the spacing of its class.
  static double count_needed(const Stretch& s) {
    return glm::distance(s.from, s.to) / size_of(s.street).lamp_spacing_m;
  }

  std::size_t write_lamps() {
    double needed = 0;
    for_each_stretch(streets_, [&](const Stretch& s) { needed += count_needed(s); });
    const auto total =
        options_.lamps ? options_.lamps : static_cast<std::size_t>(std::llround(needed));
    // Each stretch gets its share of the lamps: rounding the running sum gives out exactly `total`.
    double sum = 0;
    std::int64_t given = 0, number = 0;
    std::size_t stretch = 0;
    for_each_stretch(streets_, [&](const Stretch& s) {
      sum += count_needed(s);
      const auto due = sum >= needed ? static_cast<std::int64_t>(total)
                                     : std::llround(sum / needed * static_cast<double>(total));
      stretch_lamps(s, static_cast<int>(due - given), stretch++ % 2 == 0, number);
      given = due;
    });
    return total;
  }

  void stretch_lamps(const Stretch& s, int luminaires, bool left_first, std::int64_t& number) {
    Random random{static_cast<std::int64_t>(options_.seed), 11, s.axis, s.i, s.j};
    // Pedestrian streets have some posts with two lanterns.
    const bool twin = s.street == StreetClass::pedestrian && luminaires >= 2;
    const int posts = luminaires - (twin ? 1 : 0);
    const bool staggered = size_of(s.street).carriageway_m >= 7;
    for (int n = 0; n < posts; ++n) {
      const double f = (n + 0.5) / posts;
      const bool left = (left_first != (staggered && n % 2 == 1));
      const dvec2* kerb = left ? s.kerb_left : s.kerb_right;
      const dvec2 along = glm::normalize(kerb[1] - kerb[0]);
      const dvec2 outward = left ? dvec2(-along.y, along.x) : dvec2(along.y, -along.x);
      const double wobble = random.range(-0.8, 0.8);  // surveyed from aerial pictures
      Post post;
      post.at =
          kerb[0] + (kerb[1] - kerb[0]) * f + along * wobble + outward * random.range(0.45, 0.75);
      const double bearing = std::atan2(-outward.x, -outward.y) * 180 / std::numbers::pi;
      post.bearing_degrees = bearing < 0 ? bearing + 360 : bearing;
      post.street = s.street;
      post.luminaires = twin && n == posts / 2 ? 2 : 1;
      post.number = number++;
      write_post(post);
    }
  }

  /// Shares measured in extracts of Berlin, Helsinki and London: most posts have no further tag, 8
  /// % a type, 1 % a height.
  void write_post(const Post& post) {
    Random random{static_cast<std::int64_t>(options_.seed), 12, post.number};
    open_node(first_lamp_id + post.number, post.at) << ">\n";
    tag("highway", "street_lamp");
    const bool old_lantern = post.street == StreetClass::pedestrian ||
                             post.street == StreetClass::footway ||
                             post.street == StreetClass::living_street;
    if (post.luminaires > 1) tag("light:count", std::to_string(post.luminaires));
    if (random.chance(0.15)) {
      constexpr const char* electric[] = {
          "LED", "led",         "high_pressure_sodium", "electric", "High Pressure Sodium",
          "SON", "metal_halide"};
      constexpr const char* gas[] = {"gaslight", "gas", "LED", "electric"};
      tag("lamp_type", old_lantern ? gas[random.integer(0, 3)] : electric[random.integer(0, 6)]);
    }
    if (random.chance(0.10)) {
      constexpr const char* mounts[] = {"straight_mast", "bent_mast", "pole", "wall_mounted"};
      tag("lamp_mount", mounts[old_lantern ? 0 : random.integer(0, 3)]);
    }
    if (random.chance(0.04)) {
      constexpr const char* low[] = {"4", "4.5 m", "13'", "3,5"};
      constexpr const char* high[] = {"8", "9 m", "8.5", "30 ft", "10m"};
      tag("height", old_lantern ? low[random.integer(0, 3)] : high[random.integer(0, 4)]);
    }
    if (random.chance(0.03)) {
      constexpr const char* colours[] = {"warm_white", "3000 K", "orange",
                                         "white",      "4000K",  "#ffd9a0"};
      tag("light:colour", colours[random.integer(0, 5)]);
    }
    if (random.chance(0.05)) {
      constexpr const char* points[] = {"N", "NNE", "NE", "ENE", "E", "ESE", "SE", "SSE",
                                        "S", "SSW", "SW", "WSW", "W", "WNW", "NW", "NNW"};
      const auto degrees = static_cast<int>(std::lround(post.bearing_degrees));
      tag("direction",
          random.chance(0.5) ? points[(degrees * 16 + 180) / 360 % 16] : std::to_string(degrees));
    }
    if (random.chance(0.04)) tag("ref", std::to_string(1000 + post.number));
    out_ << "</node>\n";
  }

  void write_ways() {
    std::int64_t id = first_way_id;
    for (int j = 0; j <= streets_.rows(); ++j)
      runs(
          streets_.columns(), [&](int i) { return streets_.row_street(i, j); },
          [&](int i) { return crossing_id(i, j); }, 0, j, id);
    for (int i = 0; i <= streets_.columns(); ++i)
      runs(
          streets_.rows(), [&](int j) { return streets_.column_street(i, j); },
          [&](int j) { return crossing_id(i, j); }, 1, i, id);
    for_each_stretch(streets_, [&](const Stretch& s) {
      if (s.axis != 2) return;
      out_ << "<way id=\"" << id++ << "\" version=\"1\">\n<nd ref=\"" << path_node_id(s, 0)
           << "\"/>\n<nd ref=\"" << path_node_id(s, 1) << "\"/>\n";
      tag("highway", "footway");
      tag("lit", "yes");
      out_ << "</way>\n";
    });
  }

  /// Writes one way per run of equal class, at most eight blocks long. As in real extracts, names
  /// go on from way to way while other tags come and go.
  template <class ClassOf, class NodeOf>
  void runs(int count, ClassOf class_of, NodeOf node_of, int axis, int line, std::int64_t& id) {
    for (int first = 0; first < count;) {
      int end = first + 1;
      while (end < count && end - first < 8 && class_of(end) == class_of(first)) ++end;
      out_ << "<way id=\"" << id++ << "\" version=\"1\">\n";
      for (int n = first; n <= end; ++n) {
        out_ << "<nd ref=\"" << node_of(n) << "\"/>\n";
        if (n == end) break;
        const Stretch s = find_stretch(streets_, axis == 0 ? n : line, axis == 0 ? line : n, axis);
        for (const Approach& approach : find_approaches(streets_, s, options_.seed))
          out_ << "<nd ref=\"" << approach_id(s, approach) << "\"/>\n";
      }
      way_tags(class_of(first), axis, line, first);
      out_ << "</way>\n";
      first = end;
    }
  }

  void way_tags(StreetClass street, int axis, int line, int first) {
    Random random{static_cast<std::int64_t>(options_.seed), 13, axis, line, first};
    tag("highway", osm_name(street));
    tag("name", (axis == 0 ? "Row Street " : "Column Street ") + std::to_string(line + 1));
    if (random.chance(0.4)) tag("lit", random.chance(0.9) ? "yes" : "automatic");
    const StreetSize size = size_of(street);
    // A pedestrian street is paved from wall to wall.
    const bool driven = is_driven(street);
    const std::string metres = in_metres(size.carriageway_m + (driven ? 0 : 2 * size.pavement_m));
    tag("width", random.chance(0.6) ? metres : metres + " m");
    if (driven) {
      tag("sidewalk", "both");
      tag("sidewalk:both:width", in_metres(size.pavement_m));
    }
    if (random.chance(0.2))
      tag("lanes", size.carriageway_m > 10 ? "3" : size.carriageway_m > 5 ? "2" : "1");
    if (random.chance(0.35) && street != StreetClass::pedestrian) {
      constexpr const char* fast[] = {"50", "50 km/h", "30 mph", "DE:urban", "50;30"};
      constexpr const char* slow[] = {"30", "20 mph", "DE:zone:30", "walk", "30"};
      const bool main_road = street == StreetClass::primary || street == StreetClass::secondary;
      tag("maxspeed", main_road ? fast[random.integer(0, 4)] : slow[random.integer(0, 4)]);
    }
    const bool one_way = street == StreetClass::residential && random.chance(0.25);
    if (one_way) tag("oneway", random.chance(0.9) ? "yes" : "-1");
    parking_tags(street, one_way, random);
    if (random.chance(0.5)) tag("surface", random.chance(0.7) ? "asphalt" : "sett");
  }

  /// Cars park where a carriageway has room for them beside its lanes, in the tags of both schemes.
  void parking_tags(StreetClass street, bool one_way, Random& random) {
    const bool has_room = street == StreetClass::secondary || street == StreetClass::tertiary ||
                          street == StreetClass::residential;
    if (!has_room || !random.chance(0.7)) return;
    const std::string side = random.chance(0.5) ? "left" : "right";
    if (street == StreetClass::residential && !one_way) {
      tag("parking:" + side, "half_on_kerb");
      tag("parking:" + side + ":orientation", "parallel");
    } else if (random.chance(0.7)) {
      tag("parking:" + side, "lane");
      tag("parking:" + side + ":orientation", "parallel");
      if (random.chance(0.7)) tag("parking:" + side + ":markings", "yes");
    } else {
      tag("parking:lane:" + side, "parallel");
    }
  }

  static std::string in_metres(double metres) {
    const auto decimetres = static_cast<int>(std::lround(metres * 10));
    return std::to_string(decimetres / 10) + "." + std::to_string(decimetres % 10);
  }

  TextFile& out_;
  const StreetPlan& streets_;
  const TownOptions& options_;
};

}  // namespace

std::size_t write_osm(TextFile& out, const StreetPlan& streets, const TownOptions& options) {
  return OsmWriter(out, streets, options).write();
}

}  // namespace nightcity::town
