#include "tools/town/osm_lamps.h"

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>

#include "tools/random.h"
#include "tools/town/roads.h"

namespace nightcity::town {
namespace {

using glm::dvec2;

constexpr std::int64_t first_lamp_id = 4000000000;

/// A luminaire post before it is written.
struct Post {
  dvec2 at;
  double bearing_degrees;  // from the post to the road, clockwise from north
  StreetClass street;
  int luminaires;
  std::int64_t number;
};

class LampWriter {
 public:
  LampWriter(OsmElements& out, const StreetPlan& streets, const TownOptions& options)
      : out_(out), streets_(streets), options_(options) {}

  std::size_t write() {
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
      write_stretch(s, static_cast<int>(due - given), stretch++ % 2 == 0, number);
      given = due;
    });
    return total;
  }

 private:
  /// Returns the number of lamps that a stretch needs: its length over the spacing of its class.
  static double count_needed(const Stretch& s) {
    return glm::distance(s.from, s.to) / size_of(s.street).lamp_spacing_m;
  }

  void write_stretch(const Stretch& s, int luminaires, bool left_first, std::int64_t& number) {
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
    out_.open_node(first_lamp_id + post.number, post.at) << ">\n";
    out_.tag("highway", "street_lamp");
    const bool old_lantern = post.street == StreetClass::pedestrian ||
                             post.street == StreetClass::footway ||
                             post.street == StreetClass::living_street;
    if (post.luminaires > 1) out_.tag("light:count", std::to_string(post.luminaires));
    if (random.chance(0.15)) {
      constexpr const char* electric[] = {
          "LED", "led",         "high_pressure_sodium", "electric", "High Pressure Sodium",
          "SON", "metal_halide"};
      constexpr const char* gas[] = {"gaslight", "gas", "LED", "electric"};
      out_.tag("lamp_type",
               old_lantern ? gas[random.integer(0, 3)] : electric[random.integer(0, 6)]);
    }
    if (random.chance(0.10)) {
      constexpr const char* mounts[] = {"straight_mast", "bent_mast", "pole", "wall_mounted"};
      out_.tag("lamp_mount", mounts[old_lantern ? 0 : random.integer(0, 3)]);
    }
    if (random.chance(0.04)) {
      constexpr const char* low[] = {"4", "4.5 m", "13'", "3,5"};
      constexpr const char* high[] = {"8", "9 m", "8.5", "30 ft", "10m"};
      out_.tag("height", old_lantern ? low[random.integer(0, 3)] : high[random.integer(0, 4)]);
    }
    if (random.chance(0.03)) {
      constexpr const char* colours[] = {"warm_white", "3000 K", "orange",
                                         "white",      "4000K",  "#ffd9a0"};
      out_.tag("light:colour", colours[random.integer(0, 5)]);
    }
    if (random.chance(0.05)) {
      constexpr const char* points[] = {"N", "NNE", "NE", "ENE", "E", "ESE", "SE", "SSE",
                                        "S", "SSW", "SW", "WSW", "W", "WNW", "NW", "NNW"};
      const auto degrees = static_cast<int>(std::lround(post.bearing_degrees));
      out_.tag("direction", random.chance(0.5) ? points[(degrees * 16 + 180) / 360 % 16]
                                               : std::to_string(degrees));
    }
    if (random.chance(0.04)) out_.tag("ref", std::to_string(1000 + post.number));
    out_ << "</node>\n";
  }

  OsmElements& out_;
  const StreetPlan& streets_;
  const TownOptions& options_;
};

}  // namespace

std::size_t write_lamps(OsmElements& out, const StreetPlan& streets, const TownOptions& options) {
  return LampWriter(out, streets, options).write();
}

}  // namespace nightcity::town
