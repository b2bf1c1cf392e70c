// Bridges of the map through a whole bake: what stands and drives on them meets what is drawn.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "formats/scene_reader.h"
#include "formats/traffic_pose.h"
#include "support/temp_folder.h"
#include "tests/tools/bake/whole_and_parts.h"
#include "tools/bake/bake.h"
#include "tools/bake/city/road_consumer.h"
#include "tools/bake/scene/ground_facets.h"
#include "tools/bake/stages/lamp_stage.h"
#include "tools/bake/stages/traffic_stage.h"
#include "tools/bridges/bridge_way.h"

namespace nightcity::bake {
namespace {

using test::TempFolder;

constexpr double clear_m = 4.5, top_m = clear_m + bridges::deck_m;

// Writes a map: houses around a street that a bridge of 220 m takes over another street, with lamps
// on the bridge, below it and beside it, and a tram on it. `reversed`: the ways run the other way.
// `path_below`: a path runs below the whole bridge, beside its middle. Returns the recipe, which
// ends in `more`.
fs::path write_map_with_bridge(const fs::path& folder, const std::string& more = {},
                               bool reversed = false, bool path_below = false) {
  std::vector<std::string> nodes, ways;
  const auto add_node = [&](const glm::dvec2& metres, const std::string& tags = {}) {
    char place[80];
    std::snprintf(place, sizeof place, "lon='%.7f' lat='%.7f'", 13.4 + metres.x / 67'900,
                  52.5 + metres.y / 111'300);
    nodes.push_back("<node id='" + std::to_string(nodes.size() + 1) + "' " + place + ">" + tags +
                    "</node>\n");
    return static_cast<int>(nodes.size());
  };
  const auto add_way = [&](std::vector<int> refs, const std::string& tags) {
    if (reversed) std::reverse(refs.begin(), refs.end());
    std::string text = "<way id='" + std::to_string(ways.size() + 1) + "'>";
    for (const int ref : refs) text += "<nd ref='" + std::to_string(ref) + "'/>";
    ways.push_back(text + tags + "</way>\n");
  };
  for (const double x : {-250.0, 0.0, 240.0})
    for (const double y : {-90.0, 80.0}) {
      std::vector<int> refs;
      for (const glm::dvec2& corner : {glm::dvec2(20, 0), {30, 0}, {30, 10}, {20, 10}})
        refs.push_back(add_node(glm::dvec2(x, y) + corner));
      refs.push_back(refs.front());
      add_way(refs, "<tag k='building' v='yes'/>");
    }
  const std::string street = "<tag k='highway' v='secondary'/><tag k='sidewalk' v='both'/>",
                    lifted = "<tag k='bridge' v='yes'/><tag k='layer' v='1'/>";
  const int west = add_node({-240, 0}), first = add_node({-110, 0}), middle = add_node({20, 0}),
            last = add_node({110, 0}), east = add_node({240, 0});
  add_way({west, first}, street);
  add_way({first, middle}, street + lifted);
  add_way({last, middle}, street + lifted);
  add_way({last, east}, street);
  add_way({add_node({0, -90}), add_node({0, 90})}, street);
  add_way({add_node({-105, 2}), add_node({105, 2})}, "<tag k='railway' v='tram'/>" + lifted);
  if (path_below)
    add_way({add_node({-100, 2}), add_node({100, 2})}, "<tag k='highway' v='footway'/>");
  const std::string lamp = "<tag k='highway' v='street_lamp'/>";
  for (const glm::dvec2& place : {glm::dvec2(-40, 7), {50, -7}, {4.2, 5.4}, {5.5, 60}, {-150, 7}})
    add_node(place, lamp);
  std::ofstream map(folder / "bridge.osm");
  map << "<osm version='0.6'>\n";
  for (const auto* texts : {&nodes, &ways})
    for (const std::string& text : *texts) map << text;
  map << "</osm>\n";
  std::ofstream(folder / "bridge.toml")
      << "[osm]\nfiles = ['bridge.osm']\n[traffic]\nvehicles = 20\n"
      << more;
  return folder / "bridge.toml";
}

// The triangles of a kind of node, E, N, H.
class DrawnSurface {
 public:
  DrawnSurface(const fs::path& glb, const std::string& kind) {
    const Scene scene = read_scene(glb);
    georeference = scene.georeference;
    for (const SceneNode& node : scene.nodes) {
      if (node.kind != kind) continue;
      for (const ScenePrimitive& primitive : scene.meshes[node.mesh].primitives)
        for (const std::uint32_t i : primitive.indices)
          corners_.push_back(scene.georeference.from_model(
              glm::dvec3(node.instances.at(0).to_model * glm::vec4(primitive.positions[i], 1))));
    }
  }
  bool empty() const { return corners_.empty(); }
  // Returns the height of the highest surface that looks up at a place.
  std::optional<double> find_top(const glm::dvec2& place) const {
    std::optional<double> top;
    for (std::size_t i = 0; i + 2 < corners_.size(); i += 3) {
      const glm::dvec3 &a = corners_[i], &b = corners_[i + 1], &c = corners_[i + 2];
      const auto area = [](const glm::dvec2& u, const glm::dvec2& v) {
        return u.x * v.y - u.y * v.x;
      };
      const glm::dvec2 p = place - glm::dvec2(a), u(b - a), v(c - a);
      const double whole = area(u, v);
      if (!(whole > 1e-9)) continue;
      const double at_b = area(p, v) / whole, at_c = area(u, p) / whole;
      if (at_b < 0 || at_c < 0 || at_b + at_c > 1) continue;
      const double height = a.z + at_b * (b.z - a.z) + at_c * (c.z - a.z);
      top = std::max(top.value_or(height), height);
    }
    return top;
  }
  Georeference georeference;

 private:
  std::vector<glm::dvec3> corners_;
};

// A bake, and the city that it is made of.
struct BakedBridge {
  TempFolder folder;
  BakeOptions options = make_bake_options(read_recipe(write_map_with_bridge(folder.path())));
  BakeReport report = bake(options, folder / "out");
  DrawnSurface bridge{folder / "out/city.glb", "bridge"},
      ground{folder / "out/city.glb", "terrain"};
  City city{options.city};
  BakedBridge() { read_ground_and_streets(city, true, {}); }
  // Returns a place of the map in the frame.
  glm::dvec2 find(const glm::dvec2& metres) const {
    return city.frame().from_lon_lat({13.4 + metres.x / 67'900, 52.5 + metres.y / 111'300});
  }
};

const BakedBridge& baked() {
  static const BakedBridge bridge;
  return bridge;
}

TEST(BakeBridges, TheDeckClearsTheStreetBelowItAndTheGroundIsNoStreet) {
  // The carriageway lies lower by a kerb, and tracks are flush with it.
  EXPECT_NEAR(baked().bridge.find_top(baked().find({0.5, 2})).value(), top_m - 0.12, 0.02);
  EXPECT_NEAR(baked().ground.find_top(baked().find({0.5, 2})).value(), -0.12, 1e-3) << "below it";
  EXPECT_NEAR(baked().ground.find_top(baked().find({-50, 2})).value(), 0, 1e-3);
  EXPECT_FALSE(baked().bridge.find_top(baked().find({-111, 0})));
  // The street goes on at the abutment without a step.
  EXPECT_NEAR(baked().bridge.find_top(baked().find({-109.9, 0})).value(),
              baked().ground.find_top(baked().find({-110.1, 0})).value(), 0.03);
}

TEST(BakeBridges, TheReportSaysHowLongTheyAre) {
  const BridgesReport& report = baked().report.bridges;
  EXPECT_EQ(report.found.built.at("streets").bridges, 1u);
  EXPECT_NEAR(report.found.built.at("streets").length_m, 220, 1);
  const bridges::Deck& deck = baked().city.bridges().decks().decks()[0];
  EXPECT_NEAR(report.deck_m2, deck.length_m() * 2 * deck.half_m, 1);
  EXPECT_EQ(report.bare_decks, 0u);
  EXPECT_NEAR(baked().report.cover.tracks_m.at("tram in a street"), 210, 2);
}

TEST(BakeBridges, NoPierStandsOnAPathThatPassesBetweenItsMiddleAndItsEnd) {
  EXPECT_GT(baked().report.bridges.piers, 5u);
  const TempFolder folder;
  const fs::path recipe = write_map_with_bridge(folder.path(), {}, false, true);
  const BakeReport report = bake(make_bake_options(read_recipe(recipe)), folder / "out");
  EXPECT_EQ(report.bridges.found.built.at("streets").bridges, 1u);
  EXPECT_EQ(report.bridges.piers, 0u);
}

TEST(BakeBridges, LampsStandOnTheDeckOrBelowIt) {
  const lights::LampSet lamps = place_city_lamps(baked().city, baked().options.lights.lamps).set;
  std::size_t above = 0, lowered = 0;
  for (const lights::PlacedLamp& lamp : lamps.lamps) {
    const glm::dvec2 foot(lamp.foot);
    const auto deck = baked().bridge.find_top(foot);
    const double ground = baked().ground.find_top(foot).value();
    if (lamp.foot.z > 0.05) {
      ASSERT_TRUE(deck) << "it floats at " << foot.x << ", " << foot.y;
      EXPECT_NEAR(lamp.foot.z, *deck, 0.02);
      ++above;
      continue;
    }
    if (deck && std::abs(*deck - lamp.foot.z) < 0.15) continue;  // at an abutment
    EXPECT_NEAR(lamp.foot.z, ground, 0.02);
    const auto over = baked().bridge.find_top(foot + lamp.outreach);
    if (!over) continue;
    EXPECT_LT(lamp.foot.z + lamp.mounting_height_m, *over - bridges::deck_m) << "through the deck";
    ++lowered;
  }
  EXPECT_GE(above, 4u);
  EXPECT_GE(lowered, 1u);
}

TEST(BakeBridges, WheelsStandOnWhatIsDrawn) {
  const Georeference& georeference = baked().bridge.georeference;
  const traffic::TrafficSet traffic =
      make_city_traffic(baked().city, baked().options.traffic, georeference, {});
  TrafficContent content = traffic.content();
  for (float& share : content.cycle.density) share = 1;
  std::size_t on_deck = 0, below = 0;
  double worst_m = 0;
  for (const Trip& trip : content.trips)
    for (double t = 0; t < baked().options.traffic.cycle_s; t += 1.7)
      if (const auto pose = pose_at(content, trip, t)) {
        const glm::dvec3 place = georeference.from_model(glm::dvec3(pose->position));
        const auto deck = baked().bridge.find_top(glm::dvec2(place)),
                   ground = baked().ground.find_top(glm::dvec2(place));
        double off_m = std::numeric_limits<double>::infinity();
        for (const auto& surface : {deck, ground})
          if (surface) off_m = std::min(off_m, std::abs(place.z - *surface));
        worst_m = std::max(worst_m, off_m);
        on_deck += deck && place.z > 2;
        below += deck && *deck > 2 && place.z < 0.1;
      }
  EXPECT_GT(on_deck, 20u);
  EXPECT_GT(below, 5u);
  // Two axles bridge the kinks at the abutments, and knots are within 4 cm.
  EXPECT_LT(worst_m, 0.15);
}

TEST(BakeBridges, OneWordTurnsThemOff) {
  const TempFolder folder;
  const BakeReport report =
      bake(read_recipe(write_map_with_bridge(folder.path(), "[ground]\nbridges = false\n")),
           folder / "o");
  EXPECT_TRUE(report.bridges.found.built.empty());
  EXPECT_TRUE(DrawnSurface(folder / "o/city.glb", "bridge").empty());
}

TEST(BakeBridges, PartsGiveTheBytesOfTheWholeBake) {
  const TempFolder folder;
  expect_parts_as_whole(write_map_with_bridge(folder.path()), folder.path(), {3});
}

TEST(BakeBridges, TheDirectionOfWaysDoesNotMatter) {
  const TempFolder folder;
  bake(read_recipe(write_map_with_bridge(folder.path(), {}, true)), folder / "o");
  const DrawnSurface other(folder / "o/city.glb", "bridge");
  for (double x = -105; x < 110; x += 7)
    for (double y = -6; y <= 6; y += 3)
      EXPECT_NEAR(other.find_top(baked().find({x, y})).value(),
                  baked().bridge.find_top(baked().find({x, y})).value(), 4 * facet_tolerance_m);
}

// Writes a city model around the map: four houses, and something of another class between them.
void write_model(const fs::path& folder, const std::string& class_name) {
  const glm::dvec2 middle(391'370, 5'817'830);  // EPSG:25833
  const auto write_square = [&](const glm::dvec2& at, double height) {
    std::string text;
    for (const glm::dvec2& corner :
         {glm::dvec2(0, 0), {10, 0}, {10, 10}, {0, 10}, glm::dvec2(0, 0)}) {
      const glm::dvec2 p = middle + at + corner;
      text += std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(height) + " ";
    }
    return "<gml:surfaceMember><gml:Polygon><gml:exterior><gml:LinearRing><gml:posList>" + text +
           "</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember>";
  };
  std::ofstream file(folder / "model.gml");
  file << "<CityModel xmlns='http://www.opengis.net/citygml/2.0' "
          "xmlns:bldg='http://www.opengis.net/citygml/building/2.0' "
          "xmlns:brid='http://www.opengis.net/citygml/bridge/2.0' "
          "xmlns:gen='http://www.opengis.net/citygml/generics/2.0' "
          "xmlns:gml='http://www.opengis.net/gml'><gml:boundedBy><gml:Envelope "
          "srsName='EPSG:25833' srsDimension='3'/></gml:boundedBy>";
  for (const glm::dvec2& at : {glm::dvec2(-350, -200), {350, -200}, {350, 200}, {-350, 200}})
    file << "<cityObjectMember><bldg:Building><bldg:boundedBy><bldg:GroundSurface>"
            "<bldg:lod2MultiSurface><gml:MultiSurface>"
         << write_square(at, 30)
         << "</gml:MultiSurface></bldg:lod2MultiSurface></bldg:GroundSurface></bldg:boundedBy>"
            "</bldg:Building></cityObjectMember>";
  file << "<cityObjectMember><" << class_name << "><" << class_name.substr(0, 5)
       << "lod2MultiSurface><gml:MultiSurface>" << write_square({200, 150}, 34)
       << "</gml:MultiSurface></" << class_name.substr(0, 5) << "lod2MultiSurface></" << class_name
       << "></cityObjectMember></CityModel>";
}

TEST(BakeBridges, BridgesOfTheModelGoBeforeThoseOfTheMap) {
  for (const std::string class_name : {"bldg:Building", "brid:Bridge"}) {
    const TempFolder folder;
    write_model(folder.path(), class_name);
    const fs::path recipe = write_map_with_bridge(folder.path(), "[city]\nfiles = ['model.gml']\n");
    const BakeReport report = bake(read_recipe(recipe), folder / "out");
    EXPECT_EQ(report.bridges.found.built.empty(), class_name == "brid:Bridge") << class_name;
  }
}

}  // namespace
}  // namespace nightcity::bake
