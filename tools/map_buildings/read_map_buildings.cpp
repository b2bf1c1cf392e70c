#include "tools/map_buildings/read_map_buildings.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <optional>
#include <string>
#include <utility>

#include "formats/median.h"
#include "tools/city/attributes.h"
#include "tools/city/merge_parts.h"
#include "tools/city/skip_counter.h"
#include "tools/in_order.h"
#include "tools/map_buildings/building_tags.h"
#include "tools/map_buildings/drawn_twice.h"
#include "tools/map_buildings/file_buildings.h"
#include "tools/map_buildings/local_plane.h"
#include "tools/map_buildings/part_index.h"
#include "tools/map_buildings/roofs.h"
#include "tools/map_buildings/skin.h"
#include "tools/map_buildings/tall_things.h"
#include "tools/osm/days.h"
#include "tools/osm/first_nodes.h"
#include "tools/osm/map_areas.h"
#include "tools/osm/tag_values.h"
#include "tools/place/longitude.h"
#include "tools/ring_area.h"
#include "tools/today.h"

namespace nightcity::map_buildings {
namespace {

using osm::MapArea;
using osm::MapRings;

constexpr std::size_t batch_size = 256;

// Vertices on the line between their neighbours, within 2 cm, make no corner: mappers set them
// where a neighbour joins. Four corners are then four.
void drop_straight_vertices(std::vector<glm::dvec2>& ring) {
  constexpr double tolerance_m = 0.02;
  for (std::size_t i = 0; i < ring.size() && ring.size() > 3;) {
    const glm::dvec2& a = ring[(i + ring.size() - 1) % ring.size()];
    const glm::dvec2& b = ring[(i + 1) % ring.size()];
    const glm::dvec2 line = b - a, from = ring[i] - a;
    const double length = std::hypot(line.x, line.y);
    const double along = length > 0 ? (line.x * from.x + line.y * from.y) / length : -1;
    const bool straight = length > 0 && along > 0 && along < length &&
                          std::abs(line.x * from.y - line.y * from.x) <= tolerance_m * length;
    if (straight)
      ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(i));
    else
      ++i;
  }
}

Outline to_outline(const MapRings& rings, const LocalPlane& plane) {
  const auto flatten = [&](const std::vector<glm::dvec2>& ring, bool anticlockwise) {
    std::vector<glm::dvec2> out;
    for (const glm::dvec2& p : ring) out.push_back(plane.to_metres(p));
    if ((signed_area(out) > 0) != anticlockwise) std::reverse(out.begin(), out.end());
    drop_straight_vertices(out);
    return out;
  };
  Outline outline{flatten(rings.outer, true), {}};
  for (const std::vector<glm::dvec2>& hole : rings.holes)
    if (hole.size() >= 3) outline.holes.push_back(flatten(hole, false));
  return outline;
}

// Returns the year in which a building was begun, as text: of "1880..1890" the first, of "before
// 1950" that.
std::string find_year(const std::string& start_date) {
  const auto days = osm::parse_days(start_date);
  if (!days) return {};
  const osm::Day day = days->first == osm::Day::min() ? days->last : days->first;
  return std::to_string(static_cast<int>(std::chrono::year_month_day(day).year()));
}

class ObjectMaker {
 public:
  ObjectMaker(city::SkipCounter& skipped, city::SkipCounter& assumed, bool coloured)
      : skipped_(skipped), assumed_(assumed), coloured_(coloured) {}

  // Returns none where nothing of the building stands above the ground.
  std::optional<city::RawObject> make(const MapArea& building,
                                      const std::vector<const MapArea*>& parts) {
    if (is_absent(building.tags, today_)) {
      skipped_.add("building below the ground, not built or gone");
      return {};
    }
    city::RawObject raw;
    raw.object.id = building.id;
    raw.object.type = city::ObjectType::building;
    raw.object.class_name = "Building";
    raw.object.of_map = true;
    raw.object.function = name_tall_function(building.tags);
    raw.object.year = find_year(osm::find_raw_tag(building.tags, "start_date"));
    raw.object.address =
        city::to_text(city::Address{osm::find_raw_tag(building.tags, "addr:street"),
                                    osm::find_raw_tag(building.tags, "addr:housenumber"),
                                    osm::find_raw_tag(building.tags, "addr:postcode"),
                                    osm::find_raw_tag(building.tags, "addr:city"),
                                    osm::find_raw_tag(building.tags, "addr:country")});
    const LocalPlane plane(building.rings.front().outer.front());
    bool has_parts = false;
    for (const MapArea* part : parts) {
      if (is_absent(part->tags, today_)) {
        skipped_.add("part of a building below the ground, not built or gone");
        continue;
      }
      has_parts = true;
      add_shells(*part, building, plane, raw);
    }
    if (has_parts)
      skipped_.add("outline of a building that has parts");
    else
      add_shells(building, building, plane, raw);
    if (const auto said = find_sizes(building.tags, unused_).storeys)
      raw.object.storeys_above_ground = *said;
    return raw;
  }

 private:
  // `building` is the whole of which the area is a part, or the area itself.
  void add_shells(const MapArea& area, const MapArea& building, const LocalPlane& plane,
                  city::RawObject& raw) {
    const auto inherited =
        &area == &building ? std::nullopt : inherit_height(area.tags, building.tags);
    const BuildingSizes said = find_sizes(inherited ? *inherited : area.tags, skipped_);
    if (inherited) assumed_.add("height of a part of a building, as the building's");
    const auto walls = find_colour(area, building, Skin::walls),
               roof = find_colour(area, building, Skin::roof);
    double highest_m = 0;
    if (coloured_)
      for (const std::string& note : find_unread_skins(area.tags)) skipped_.add(note);
    if (said.assumed) assumed_.add("height of a building that the map does not say");
    for (const MapRings& rings : area.rings) {
      const Outline outline = to_outline(rings, plane);
      BuildingSizes sizes = said;
      fit_slope(outline, sizes);
      highest_m = std::max(highest_m, sizes.top_m);
      bool made_flat = false;
      for (city::Polygon& polygon : make_shell(outline, sizes, made_flat)) {
        const auto place = [&](city::Ring& ring) {
          for (glm::dvec3& p : ring) p = plane.to_degrees(p);
        };
        place(polygon.exterior);
        for (city::Ring& hole : polygon.interiors) place(hole);
        if (polygon.surface == city::SurfaceType::wall) polygon.diffuse_colour = walls;
        if (polygon.surface == city::SurfaceType::roof) polygon.diffuse_colour = roof;
        raw.polygons.add(std::move(polygon), {});
      }
      if (made_flat) skipped_.add("roof whose shape does not fit its outline, shown flat");
    }
    city::CityObject& object = raw.object;
    object.measured_height_m = std::max(object.measured_height_m.value_or(0), highest_m);
    if (said.storeys)
      object.storeys_above_ground =
          std::max(object.storeys_above_ground.value_or(0), *said.storeys);
  }

  std::optional<glm::vec3> find_colour(const MapArea& area, const MapArea& building,
                                       Skin skin) const {
    if (!coloured_) return std::nullopt;
    const auto own = find_skin(area.tags, skin);
    return own ? own : find_skin(building.tags, skin);
  }

  city::SkipCounter &skipped_, &assumed_;
  bool coloured_;
  city::SkipCounter unused_;
  const osm::Day today_ = today();
};

struct Batch {
  city::ReadReport report;
  city::SkipCounter skipped, assumed;
  std::function<void()> rest;
};

}  // namespace

city::CityHead read_map_head(const std::filesystem::path& file, const city::ReadOptions&) {
  constexpr std::size_t nodes = 100'000;
  city::CityHead head;
  head.srs_name = "EPSG:4326";
  std::vector<double> lon, lat;
  for (const glm::dvec2& p : osm::read_first_nodes(file, nodes)) {
    lon.push_back(place::count_on(p.x, lon.empty() ? p.x : lon.front()));
    lat.push_back(p.y);
  }
  if (lon.empty()) return head;
  // A square round the middle that faces up: it shows longitude and latitude in their order.
  const double x = median(std::move(lon)), y = median(std::move(lat)), half = 0.0005;
  head.sample = {{x - half, y - half, 0},
                 {x + half, y - half, 0},
                 {x + half, y + half, 0},
                 {x - half, y + half, 0},
                 {x - half, y - half, 0}};
  return head;
}

city::ReadReport read_map_buildings(const std::filesystem::path& file,
                                    const city::ReadOptions& options,
                                    const city::ObjectStage& stage) {
  const FileBuildings map = read_file_buildings(file, options);
  const osm::MapAreas& counts = map.counts;
  city::ReadReport report;
  report.srs_name = "EPSG:4326";
  if (const std::size_t bad = counts.broken + counts.open_ways)
    report.skipped["outline that crosses itself, is open or incomplete"] = bad;
  if (counts.too_long > 0)
    report.skipped["building of more nodes than [osm] max_way_nodes = " +
                   std::to_string(options.max_way_nodes)] = counts.too_long;

  for (const auto& [reason, number] : map.left_out) report.skipped[reason] += number;

  const PartIndex index(map.buildings);
  const std::vector<std::size_t> standing = find_standing(map.buildings, today());
  std::vector<std::vector<const MapArea*>> parts(map.buildings.size());
  std::vector<const MapArea*> alone;  // parts of no building, chimneys, tanks and the like
  for (std::size_t n = 0; n < map.parts.size(); ++n) {
    if (const auto building = index.find_building(map.parts[n]))
      parts[standing[*building]].push_back(&map.parts[n]);
    else if (map.is_own_part[n])
      alone.push_back(&map.parts[n]);
  }
  for (const MapArea& thing : map.tall_things) alone.push_back(&thing);
  const std::size_t count = map.own + alone.size();
  std::size_t next = 0;
  in_order(
      options.threads,
      [&]() -> std::optional<std::size_t> {
        if (next >= count) return {};
        return std::exchange(next, next + batch_size);
      },
      [&](std::size_t first) {
        Batch batch;
        ObjectMaker maker(batch.skipped, batch.assumed, options.map_colours);
        std::vector<city::CityObject> objects;
        for (std::size_t i = first; i < std::min(first + batch_size, count); ++i) {
          const bool whole = i < map.own;
          if (whole && standing[i] != i) {
            batch.skipped.add("building that the map has twice, with the same corners");
            continue;
          }
          auto raw =
              whole ? maker.make(map.buildings[i], parts[i]) : maker.make(*alone[i - map.own], {});
          if (raw) objects.push_back(city::merge_parts(std::move(*raw), options, batch.report));
        }
        if (!objects.empty()) batch.rest = stage(std::move(objects));
        return batch;
      },
      [&](Batch&& batch) {
        if (batch.rest) batch.rest();
        batch.skipped.merge_into(batch.report.skipped);
        batch.assumed.merge_into(batch.report.assumed);
        report.merge(batch.report);
      });
  report.warnings.push_back(file.string() + ": the city model is the " +
                            std::to_string(report.objects) +
                            " buildings of the map, with the heights that it says or its levels "
                            "and kinds suggest");
  city::finish_report(file, report);
  return report;
}

}  // namespace nightcity::map_buildings
