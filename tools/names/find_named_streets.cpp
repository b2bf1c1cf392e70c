#include "tools/names/find_named_streets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "formats/finite.h"
#include "formats/scene_places_json.h"
#include "tools/ground_cover/clip_segment.h"
#include "tools/ground_cover/join_lines.h"
#include "tools/ground_cover/way_line.h"
#include "tools/in_ring.h"
#include "tools/names/lines_apart.h"
#include "tools/osm/osm_selection.h"
#include "tools/osm/tag_values.h"
#include "tools/ring_area.h"
#include "tools/roads/road_class.h"
#include "tools/simplify_line.h"

namespace nightcity::names {
namespace {

using ground_cover::Box;

// A centreline is good enough within a metre: one looks along a street, and does not drive there.
constexpr double tolerance_m = 1;

bool is_area(const osm::OsmTags& tags) {
  return osm::says_area(tags) || osm::find_tag(tags, "type") == "multipolygon";
}

bool lies_below_ground(const osm::OsmTags& tags) {
  const std::string tunnel = osm::find_tag(tags, "tunnel");
  return (!tunnel.empty() && tunnel != "no" && tunnel != "building_passage") ||
         osm::find_tag(tags, "indoor") == "yes" || osm::find_tag(tags, "location") == "underground";
}

// Returns a point inside a ring: its centroid, else the middle of the widest part of the line from
// west to east through that.
glm::dvec2 find_inner_point(const Line& ring) {
  const double area = signed_area(ring);
  glm::dvec2 centroid(0);
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const glm::dvec2 a = ring[k] - ring[0], b = ring[(k + 1) % ring.size()] - ring[0];
    centroid += (a + b) * (a.x * b.y - a.y * b.x);
  }
  centroid = area != 0 ? ring[0] + centroid / (6 * area) : ring[0];
  if (area == 0 || in_ring(ring, centroid)) return centroid;
  std::vector<double> crossings;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const glm::dvec2 &a = ring[k], &b = ring[(k + 1) % ring.size()];
    if ((a.y > centroid.y) != (b.y > centroid.y))
      crossings.push_back(a.x + (centroid.y - a.y) / (b.y - a.y) * (b.x - a.x));
  }
  std::sort(crossings.begin(), crossings.end());
  double widest = 0;
  for (std::size_t i = 0; i + 1 < crossings.size(); i += 2)
    if (const double width = crossings[i + 1] - crossings[i]; width > widest) {
      widest = width;
      centroid.x = crossings[i] + width / 2;
    }
  return centroid;
}

// Returns whether text is "en", "zh-Hant" or "sr-Latn": a code of ISO 639 and what narrows it down.
bool is_language(std::string_view text) {
  const std::size_t letters = std::min(text.find_first_of("-_"), text.size());
  return (letters == 2 || letters == 3) &&
         std::all_of(text.begin(), text.begin() + std::ptrdiff_t(letters),
                     [](char c) { return c >= 'a' && c <= 'z'; });
}

// Returns whether a tag of a street is another name of it. Keys such as name:etymology:wikidata and
// name:pronunciation begin alike and hold something else.
bool is_other_name(const std::string& key) {
  constexpr std::array keys{"alt_name", "int_name", "loc_name", "nat_name",  "official_name",
                            "old_name", "ref",      "reg_name", "short_name"};
  constexpr std::string_view in_language = "name:";
  return std::find(keys.begin(), keys.end(), key) != keys.end() ||
         (key.starts_with(in_language) &&
          is_language(std::string_view(key).substr(in_language.size())));
}

class Finder {
 public:
  Finder(const place::LonLatToFrame& to_frame, const Box& bounds, const Georeference& georeference)
      : to_frame_(to_frame), bounds_(bounds), georeference_(georeference) {}

  void add_way(const osm::OsmWay& way) {
    if (is_area(way.tags) || !roads::find_road_class(osm::find_tag(way.tags, "highway"))) return;
    Lines* lines = find_lines(way.tags);
    if (!lines) return;
    for (Line& part :
         ground_cover::clip_line(ground_cover::find_line(way.lon_lat, to_frame_, bounds_), bounds_))
      lines->streets.push_back(std::move(part));
  }

  void add_area(const osm::MapArea& area) {
    Lines* lines = find_lines(area.tags);
    for (const osm::MapRings& rings : area.rings) {
      const Line ring = ground_cover::find_line(rings.outer, to_frame_, bounds_);
      if (lines && ring.size() >= 3) add_square(find_inner_point(ring), *lines);
    }
  }

  void add_node(const osm::OsmPoint& point) {
    if (Lines* lines = find_lines(point.tags)) add_square(to_frame_(point.lon_lat), *lines);
  }

  NamedStreets finish() && {
    for (auto& [name, lines] : by_name_) add(name, std::move(lines));
    return std::move(result_);
  }

 private:
  struct Lines {
    std::vector<Line> streets, squares;
    std::set<std::string> also;  // names, some of which may be none
  };

  // Returns the lines of the name that the tags hold; nothing where they hold none to be found.
  Lines* find_lines(const osm::OsmTags& tags) {
    const std::string& name = osm::find_raw_tag(tags, "name");
    if (name.empty()) return nullptr;
    if (lies_below_ground(tags)) {
      ++result_.left_out["below the ground"];
      return nullptr;
    }
    if (!is_street_name(name)) {
      ++result_.left_out["name of over 1020 bytes or with control characters"];
      return nullptr;
    }
    Lines& lines = by_name_[name];
    for (const auto& [key, value] : tags)
      if (is_other_name(key))
        for (const std::string_view part : osm::split_list(value)) lines.also.emplace(part);
    return &lines;
  }

  void add_square(const glm::dvec2& place, Lines& lines) const {
    if (finite(place) && bounds_.holds(place)) lines.squares.push_back({place});
  }

  Line to_model(const Line& line) const {
    Line model;
    for (const glm::dvec2& p : line) {
      const glm::dvec3 at = georeference_.to_model({p.x, p.y, 0});
      model.emplace_back(at.x, at.z);
    }
    return model;
  }

  void add(const std::string& name, Lines&& named) {
    std::vector<Line> lines;
    for (const Line& line : ground_cover::join_lines(std::move(named.squares)))
      lines.push_back(line);
    for (const Line& line : ground_cover::join_lines(std::move(named.streets)))
      lines.push_back(simplify_line(line, tolerance_m));
    if (lines.empty()) return;
    ++result_.names;
    std::vector<std::string> also;
    for (const std::string& other : named.also) {
      if (other == name || !is_street_name(other)) continue;
      if (also.size() < max_other_names)
        also.push_back(other);
      else
        ++result_.left_out["beyond 32 other names of a street"];
    }
    for (const std::vector<Line>& group : group_lines_apart(lines)) {
      NamedStreet street{name, {}, also};
      std::size_t points = 0;
      for (const Line& line : group) {
        street.lines.push_back(to_model(line));
        points += line.size();
      }
      if (result_.points + points > max_street_points) {
        ++result_.left_out["beyond 1,000,000 points"];
        continue;
      }
      result_.points += points;
      result_.other_names += also.size();
      result_.streets.push_back(std::move(street));
    }
  }

  const place::LonLatToFrame& to_frame_;
  const Box& bounds_;
  const Georeference& georeference_;
  std::map<std::string, Lines> by_name_;
  NamedStreets result_;
};

}  // namespace

osm::AreaSelection select_squares() {
  return {{"place", "highway", "area:highway"}, [](const osm::OsmTags& tags) {
            const bool is_street = tags.contains("highway") && is_area(tags);
            return tags.contains("name") &&
                   (is_street || tags.contains("area:highway") || osm::is_square(tags));
          }};
}

NamedStreets find_named_streets(const NamedThings& things, const place::LonLatToFrame& to_frame,
                                const Box& bounds, const Georeference& georeference) {
  Finder finder(to_frame, bounds, georeference);
  for (const osm::OsmWay& way : things.highways) finder.add_way(way);
  for (const osm::MapArea& area : things.squares) finder.add_area(area);
  for (const osm::OsmPoint& node : things.square_nodes) finder.add_node(node);
  return std::move(finder).finish();
}

}  // namespace nightcity::names
