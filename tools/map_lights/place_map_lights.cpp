#include "tools/map_lights/place_map_lights.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <string_view>
#include <utility>

#include "formats/finite.h"
#include "tools/in_ring.h"
#include "tools/lights/lamp_state.h"
#include "tools/lights/lamp_tags.h"
#include "tools/lights/lit_tag.h"
#include "tools/lights/road_index.h"
#include "tools/map_lights/installation.h"
#include "tools/map_lights/light_collector.h"
#include "tools/map_lights/place_signs.h"
#include "tools/map_lights/thing.h"
#include "tools/osm/lifecycle.h"
#include "tools/osm/osm_selection.h"
#include "tools/osm/tag_values.h"
#include "tools/today.h"

namespace nightcity::map_lights {
namespace {

// Luminous radii: of a mast's cluster of floodlights, of one on the ground and of a downlight, m.
// Assumptions, which matter only close by.
constexpr double mast_radius_m = 0.4, spot_radius_m = 0.15, downlight_radius_m = 0.12;
// Floodlights of the map this near serve the thing.
constexpr double own_floodlights_m = 15;
// Heights of what neither a tag nor the model gives, and the size of what is a node: assumptions.
constexpr double usual_building_m = 12, usual_monument_m = 4, monument_m = 1.5;
constexpr double usual_canopy_m = 5, below_canopy_m = 0.3, least_canopy_m = 2.5;
constexpr double canopy_distance_m = 30;  // of a canopy from the node of its petrol station

struct KnownHeight {
  double m;
  ValueSource source;
};

class Placer {
 public:
  Placer(const osm::OsmData& map, const Ground& ground, const MapLightOptions& options)
      : map_(map),
        ground_(ground),
        options_(options),
        roads_(map.highways, ground.to_frame),
        signs_(ground, roads_, out_) {
    for (const osm::OsmLampNode& lamp : map.lamps)
      if (const glm::dvec2 place = ground.to_frame(lamp.lon_lat);
          finite(place) && lights::read_lamp_tags(lamp.tags).mast)
        floodlights_.push_back(place);
    if (options.makes(MapLightKind::petrol_station)) find_roofs();
  }

  MapLightSet place(std::span<const osm::OsmShiningThing> relations) {
    for (const auto& things : {std::span(map_.shining_things), relations})
      for (const osm::OsmShiningThing& thing : things) find_lit_pitch(thing);
    for (const osm::OsmShiningThing& thing : map_.shining_things) place(thing);
    for (const osm::OsmShiningThing& thing : relations) place(thing);
    return std::move(out_).take();
  }

 private:
  MapLightReport::Kind& counts(MapLightKind kind) {
    return out_.report().kinds[static_cast<std::size_t>(kind)];
  }

  void place(const osm::OsmShiningThing& thing) {
    const auto kind = find_kind(thing.tags);
    if (!kind || !options_.makes(*kind)) return;
    ++counts(*kind).mapped;
    if (osm::is_out_of_use(thing.tags, today())) return out_.leave_out("disused or abandoned");
    if (lights::is_below_ground(thing.tags))
      return out_.leave_out("below the ground or in a building");
    const std::vector<glm::dvec2> outline = find_outline(thing, ground_.to_frame);
    if (outline.empty()) return out_.leave_out("outside the projection");
    if (*kind == MapLightKind::advertising)
      signs_.place(thing, outline, options_);
    else
      place_floodlights(thing, *kind, outline);
  }

  void place_floodlights(const osm::OsmShiningThing& thing, MapLightKind kind,
                         const std::vector<glm::dvec2>& outline) {
    if (osm::is_obstruction_light(thing.tags))
      return out_.leave_out("obstruction light, which no kind of light here stands for");
    if (kind == MapLightKind::floodlit && is_flat(thing.tags))
      return out_.leave_out("plaque, mural or the like");
    if (kind == MapLightKind::floodlit && osm::is_open_tower(thing.tags))
      return out_.leave_out("mast or lattice tower, which has no walls");
    if (!is_lit(thing, kind)) return out_.leave_out("that no tag says is lit");
    if (kind == MapLightKind::pitch && is_roofed(thing.tags))
      return out_.leave_out("pitch below a roof");
    if (kind == MapLightKind::pitch && !is_pitch(thing.tags) && holds_lit_pitch(outline))
      return out_.leave_out("sports ground whose pitches are lit by themselves");
    std::optional<Box> box = find_box(outline);
    if (!box) box = Box{outline.front(), {1, 0}, monument_m, monument_m};
    if (box->length_m > max_box_m) return out_.leave_out("larger than 250 m");
    if (!ground_.height_at(box->centre)) return out_.leave_out("outside the model");
    if (has_floodlights(*box)) return out_.leave_out("lit by floodlights of the map");
    const LitThing lit{thing, kind, find_hours(kind, thing, options_, out_.report().notes)};
    if (lit.hours.night.never()) return out_.leave_out("lit at other times than in the night");
    const char* fault = kind == MapLightKind::pitch ? light_pitch(lit, outline, *box)
                        : kind == MapLightKind::petrol_station
                            ? light_petrol_station(lit, outline, *box)
                            : light_walls(lit, *box);
    if (fault) return out_.leave_out(fault);
    ++counts(kind).lit;
  }

  // Petrol stations are lit while they are open; other things where a tag says so.
  bool is_lit(const osm::OsmShiningThing& thing, MapLightKind kind) const {
    using Kind = lights::LitTag::Kind;
    const auto read = [&](const char* key) {
      return lights::read_lit_tags(thing.tags, key, half_of(thing)).lit.kind;
    };
    const Kind lit = read("lit"), floodlit = read("floodlit");
    if (kind == MapLightKind::petrol_station) return lit != Kind::dark;
    return lit == Kind::lit || floodlit == Kind::lit;
  }

  void find_lit_pitch(const osm::OsmShiningThing& thing) {
    if (!is_pitch(thing.tags) || !is_lit(thing, MapLightKind::pitch)) return;
    const std::vector<glm::dvec2> outline = find_outline(thing, ground_.to_frame);
    if (const auto box = outline.empty() ? std::nullopt : find_box(outline))
      lit_pitches_.push_back(box->centre);
  }

  bool holds_lit_pitch(const std::vector<glm::dvec2>& outline) const {
    return std::any_of(lit_pitches_.begin(), lit_pitches_.end(),
                       [&](const glm::dvec2& p) { return in_ring(outline, p); });
  }

  bool has_floodlights(const Box& box) const {
    return std::any_of(floodlights_.begin(), floodlights_.end(), [&](const glm::dvec2& p) {
      const glm::dvec2 d = p - box.centre;
      return std::abs(glm::dot(d, box.along)) < box.length_m / 2 + own_floodlights_m &&
             std::abs(glm::dot(d, box.across())) < box.width_m / 2 + own_floodlights_m;
    });
  }

  const char* light_pitch(LitThing lit, const std::vector<glm::dvec2>& outline, const Box& box) {
    if (!is_closed(lit.source.lon_lat)) return "pitch without an outline";
    lit.cct_k = pitch_cct_k;
    auto plan = plan_pitch(outline, box, ground_);
    if (!plan) return "pitch without room for masts";
    const double wanted_lx = find_pitch_lx(osm::find_raw_tag(lit.source.tags, "sport"));
    return out_.add(lit, std::move(*plan), wanted_lx, mast_radius_m)
               ? nullptr
               : "pitch that its masts cannot light";
  }

  const char* light_walls(LitThing lit, const Box& box) {
    lit.cct_k = facade_cct_k;
    const KnownHeight height = find_height(lit.source, box);
    lit.height = height.source;
    std::size_t lit_sides = 0;
    for (int side = 0; side < 4; ++side)
      if (auto plan = plan_wall(box, side, height.m, ground_))
        lit_sides += out_.add(lit, std::move(*plan), facade_lx, spot_radius_m);
    if (lit_sides == 0) return "building without room for floodlights";
    // Something must be there to be lit.
    if (!lit.source.is_way && !ground_.is_inside(box.centre))
      out_.add(Body{{box.centre, *ground_.height_at(box.centre)},
                    box.across(),
                    box.length_m,
                    height.m,
                    box.width_m});
    return nullptr;
  }

  // Returns a length within its bounds; counts one that is not, or cannot be read.
  std::optional<double> read_length(const osm::OsmTags& tags, const char* key, double low,
                                    double high) {
    const std::string text = osm::find_raw_tag(tags, key);
    const auto length = osm::parse_length_m(text);
    if (length && *length >= low && *length <= high) return length;
    if (!text.empty())
      ++out_.report().notes["tag not understood: " + std::string(key) + "=" + text];
    return std::nullopt;
  }

  KnownHeight find_height(const osm::OsmShiningThing& thing, const Box& box) {
    if (const auto tag = read_length(thing.tags, "height", 0.5, 200))
      return {*tag, ValueSource::tag};
    const double ground_m = *ground_.height_at(box.centre);
    double roofs = 0;
    int count = 0;
    for (const double u : {-0.6, -0.2, 0.2, 0.6})
      for (const double v : {-0.6, -0.2, 0.2, 0.6})
        if (const auto solid = ground_.find_solid(box.at(u, v))) {
          roofs += solid->high_m - ground_m;
          ++count;
        }
    if (count > 0 && roofs / count >= 2) return {roofs / count, ValueSource::attribute};
    const bool is_tall = thing.is_way || thing.tags.contains("man_made");
    return {is_tall ? usual_building_m : usual_monument_m, ValueSource::rule};
  }

  const char* light_petrol_station(LitThing lit, const std::vector<glm::dvec2>& outline,
                                   const Box& box) {
    lit.cct_k = canopy_cct_k;
    const std::vector<std::vector<glm::dvec2>> canopies = find_canopies(lit.source, outline, box);
    std::size_t lit_areas = 0;
    for (const std::vector<glm::dvec2>& canopy : canopies)
      lit_areas += light_area(lit, canopy, canopy_lx);
    if (lit_areas > 0) return nullptr;
    if (!canopies.empty()) return "petrol station whose canopy is a solid block in the model";
    if (!is_closed(lit.source.lon_lat)) return "petrol station without an area";
    return light_area(lit, outline, forecourt_lx)
               ? nullptr
               : "petrol station whose canopy is a solid block in the model";
  }

  bool light_area(LitThing lit, const std::vector<glm::dvec2>& outline, double wanted_lx) {
    const auto box = find_box(outline);
    if (!box || box->length_m > max_box_m) return false;
    const auto ground_m = ground_.height_at(box->centre);
    if (!ground_m) return false;
    KnownHeight height{usual_canopy_m, ValueSource::rule};
    if (const auto tag = read_length(lit.source.tags, "maxheight", least_canopy_m, 10))
      height = {*tag, ValueSource::tag};
    if (const auto solid = ground_.find_solid(box->centre);
        solid && solid->low_m - *ground_m >= least_canopy_m)
      height = {std::min(solid->low_m - *ground_m, 10.0), ValueSource::attribute};
    lit.height = height.source;
    auto plan = plan_downlights(outline, *box, height.m - below_canopy_m, ground_);
    return plan && out_.add(lit, std::move(*plan), wanted_lx, downlight_radius_m);
  }

  void find_roofs() {
    for (const osm::OsmWay& way : map_.buildings) {
      const std::string building = osm::find_tag(way.tags, "building");
      if ((building != "roof" && building != "canopy") || !is_closed(way.lon_lat)) continue;
      std::vector<glm::dvec2> outline =
          find_outline({way.id, true, way.lon_lat, {}}, ground_.to_frame);
      if (const auto box = find_box(outline))
        roofs_.push_back({way.id, box->centre, std::move(outline)});
    }
  }

  // Returns the outlines of the roofs that stand on the station's area, or near its node.
  std::vector<std::vector<glm::dvec2>> find_canopies(const osm::OsmShiningThing& thing,
                                                     const std::vector<glm::dvec2>& outline,
                                                     const Box& box) const {
    std::vector<std::vector<glm::dvec2>> canopies;
    for (const Roof& roof : roofs_) {
      const bool is_own = thing.is_way && roof.way_id == thing.id;
      const bool is_on_it = is_closed(thing.lon_lat)
                                ? in_ring(outline, roof.centre)
                                : glm::distance(roof.centre, box.centre) < canopy_distance_m;
      if (is_own || is_on_it) canopies.push_back(roof.outline);
    }
    return canopies;
  }

  struct Roof {
    std::int64_t way_id;
    glm::dvec2 centre;
    std::vector<glm::dvec2> outline;
  };

  const osm::OsmData& map_;
  const Ground& ground_;
  const MapLightOptions& options_;
  lights::RoadIndex roads_;
  std::vector<glm::dvec2> floodlights_;  // that the map knows
  std::vector<glm::dvec2> lit_pitches_;  // their middles
  std::vector<Roof> roofs_;              // on posts: the canopies are among them
  LightCollector out_;
  SignPlacer signs_;
};

}  // namespace

MapLightSet place_map_lights(const osm::OsmData& map, const Ground& ground,
                             const MapLightOptions& options,
                             std::span<const osm::OsmShiningThing> relations) {
  return Placer(map, ground, options).place(relations);
}

}  // namespace nightcity::map_lights
