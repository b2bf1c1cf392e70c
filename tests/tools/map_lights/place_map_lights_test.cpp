#include "tools/map_lights/place_map_lights.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <set>

#include "tests/tools/map_lights/flat_ground.h"
#include "tests/tools/map_lights/map_of_things.h"

namespace nightcity::map_lights {
namespace {

using lights::minute_of;

TEST(MapLights, APetrolStationThatIsOpenByDayAloneIsDark) {
  const auto lit = [](const char* hours) {
    const MapLightSet set =
        place({area(3, {0, 0}, {60, 40}, {{"amenity", "fuel"}, {"opening_hours", hours}})});
    return kind_of(set, MapLightKind::petrol_station).lit;
  };
  EXPECT_EQ(lit("Mo-Su 06:00-22:00"), 1u);
  EXPECT_EQ(lit("08:00-16:00"), 0u);
  EXPECT_EQ(lit("Sa-Su 08:00-20:00"), 0u);
  EXPECT_EQ(lit("by appointment"), 1u);  // by the rule, and told
}

TEST(MapLights, OnlyWhatATagSaysIsLitIsFloodlit) {
  const MapLightSet set = place(
      {area(1, {0, 0}, {105, 68}, {{"leisure", "pitch"}}), area(2, {200, 0}, {305, 68}, soccer),
       area(3, {0, 200}, {20, 240}, {{"building", "church"}, {"lit", "no"}}),
       area(4, {0, 300}, {20, 340}, {{"building", "church"}, {"floodlit", "yes"}}),
       node(5, {400, 0},
            {{"historic", "memorial"}, {"memorial", "stolperstein"}, {"lit", "yes"}})});
  EXPECT_EQ(kind_of(set, MapLightKind::pitch).mapped, 2u);
  EXPECT_EQ(kind_of(set, MapLightKind::pitch).lit, 1u);
  EXPECT_EQ(kind_of(set, MapLightKind::floodlit).lit, 1u);
  EXPECT_EQ(set.report.left_out.at("that no tag says is lit"), 1u);
  EXPECT_EQ(set.report.left_out.at("plaque, mural or the like"), 1u);
  for (const lights::PlacedLamp& lamp : set.luminaires) {
    EXPECT_EQ(lamp.foot.z, 5);
    EXPECT_EQ(lamp.provenance.flux, ValueSource::standard);
  }
}

TEST(MapLights, FloodlightsThatTheMapKnowsServeTheirPitch) {
  osm::OsmData map;
  map.lamps = {{9, {110, 30}, {{"man_made", "floodlight"}}}};
  const MapLightSet set =
      place({area(2, {0, 0}, {105, 68}, soccer)}, {}, test::make_flat_ground(), map);
  EXPECT_TRUE(set.luminaires.empty());
  EXPECT_EQ(set.report.left_out.at("lit by floodlights of the map"), 1u);
}

TEST(MapLights, EachKindHasItsHoursUnlessItsTagsOrTheRecipeSayOtherwise) {
  osm::OsmTags late = soccer;
  late["lit"] = "sunset-23:30";
  MapLightOptions options;
  options.off[MapLightKind::advertising] = {minute_of(1, 0), minute_of(6, 0)};
  const std::vector<Thing> things{node(1, {500, 0}, {{"advertising", "screen"}}),
                                  area(2, {0, 0}, {105, 68}, soccer),
                                  area(3, {0, 200}, {105, 268}, late)};
  const MapLightSet set = place(things), asked = place(things, options);
  EXPECT_TRUE(set.signs[0].hours.lit_at(minute_of(3, 0)));
  EXPECT_FALSE(asked.signs[0].hours.lit_at(minute_of(3, 0)));
  EXPECT_TRUE(asked.signs[0].hours.lit_at(minute_of(0, 30)));
  for (const lights::PlacedLamp& lamp : set.luminaires) {
    EXPECT_TRUE(lamp.hours->lit_at(minute_of(21, 0)));
    EXPECT_EQ(lamp.hours->lit_at(minute_of(23, 0)), lamp.provenance.source_id == 3);
    EXPECT_EQ(lamp.provenance.schedule == ValueSource::tag, lamp.provenance.source_id == 3);
  }
}

TEST(MapLights, APetrolStationIsLitBelowItsCanopyWhileItIsOpen) {
  osm::OsmData map;
  map.buildings = {{4, {{10, 10}, {30, 10}, {30, 20}, {10, 20}, {10, 10}}, {{"building", "roof"}}}};
  const Thing station = area(3, {0, 0}, {60, 40}, {{"amenity", "fuel"}, {"opening_hours", "24/7"}});
  const MapLightSet set = place({station}, {}, test::make_flat_ground(), map);
  ASSERT_FALSE(set.luminaires.empty());
  for (const lights::PlacedLamp& lamp : set.luminaires) {
    EXPECT_TRUE(lamp.foot.x > 10 && lamp.foot.x < 30 && lamp.foot.y > 10 && lamp.foot.y < 20);
    EXPECT_TRUE(lamp.hours->lit_at(minute_of(3, 0)));
    EXPECT_EQ(lamp.tilt_degrees, 0);
  }
  Thing closed = station;
  closed.tags["disused"] = "yes";
  const MapLightSet none = place({closed}, {}, test::make_flat_ground(), map);
  EXPECT_TRUE(none.luminaires.empty());
  EXPECT_EQ(none.report.left_out.at("disused or abandoned"), 1u);
  // Without a canopy the area is lit as a driveway, with less light on each square metre.
  const MapLightSet open = place({station});
  EXPECT_GT(open.luminaires.size(), set.luminaires.size());
  EXPECT_LT(open.luminaires[0].flux_lm, set.luminaires[0].flux_lm);
}

TEST(MapLights, KindsAndAllOfThemCanBeSwitchedOff) {
  const std::vector<Thing> things{node(1, {500, 0}, {{"advertising", "screen"}}),
                                  area(2, {0, 0}, {105, 68}, soccer)};
  MapLightOptions options;
  options.without = {MapLightKind::pitch};
  const MapLightSet signs = place(things, options);
  EXPECT_EQ(signs.signs.size(), 1u);
  EXPECT_TRUE(signs.luminaires.empty());
  options.lit = false;
  EXPECT_TRUE(place(things, options).signs.empty());
}

TEST(MapLights, WhatLiesBeyondTheModelIsCountedOnce) {
  const MapLightSet set = place({node(1, {5000, 0}, {{"advertising", "screen"}}),
                                 area(2, {5000, 0}, {5105, 68}, soccer),
                                 node(3, {1e300, 1e300}, {{"advertising", "screen"}}),
                                 area(4, {-900, -900}, {900, 900}, soccer)});
  EXPECT_TRUE(set.signs.empty() && set.luminaires.empty());
  EXPECT_EQ(set.report.left_out.at("outside the model"), 3u);
  EXPECT_EQ(set.report.left_out.at("larger than 250 m"), 1u);
}

TEST(MapLights, AThingHasTheSameLightsWhateverElseIsInTheMap) {
  const Thing pitch = area(2, {0, 0}, {105, 68}, soccer);
  const MapLightSet alone = place({pitch});
  const MapLightSet among = place({node(1, {500, 0}, {{"advertising", "screen"}}),
                                   node(2, {500, 90}, {{"advertising", "screen"}}), pitch});
  ASSERT_EQ(alone.luminaires.size(), among.luminaires.size());
  for (std::size_t n = 0; n < alone.luminaires.size(); ++n) {
    EXPECT_EQ(alone.luminaires[n].id, among.luminaires[n].id);
    EXPECT_EQ(alone.luminaires[n].foot, among.luminaires[n].foot);
    EXPECT_EQ(alone.luminaires[n].flux_lm, among.luminaires[n].flux_lm);
  }
  std::set<std::uint32_t> ids;
  for (const auto& lamp : among.luminaires) ids.insert(lamp.id);
  for (const auto& sign : among.signs) ids.insert(sign.id);
  EXPECT_EQ(ids.size(), among.luminaires.size() + among.signs.size());
}

TEST(MapLights, AMonumentThatIsANodeHasABodyToBeLit) {
  const osm::OsmTags tags{{"historic", "monument"}, {"lit", "yes"}, {"height", "6"}};
  const MapLightSet set = place({node(1, {0, 0}, tags)});
  ASSERT_EQ(set.bodies.size(), 1u);
  EXPECT_EQ(set.bodies[0].height_m, 6);
  EXPECT_EQ(set.luminaires.size(), 4u);
  for (const lights::PlacedLamp& lamp : set.luminaires) {
    EXPECT_GT(lamp.tilt_degrees, 90);
    EXPECT_LT(glm::dot(lamp.aim, glm::dvec2(lamp.foot)), 0);
    EXPECT_EQ(lamp.provenance.height, ValueSource::tag);
  }
  osm::OsmTags nonsense = tags;
  nonsense["height"] = "1e9";
  const MapLightSet usual = place({node(1, {0, 0}, nonsense)});
  EXPECT_EQ(usual.bodies[0].height_m, 4);
  EXPECT_EQ(usual.report.notes.at("tag not understood: height=1e9"), 1u);
}

TEST(MapLights, WhatShinesBelowTheGroundOrInABuildingIsNotSeen) {
  for (const auto& [key, value] : {std::pair{"indoor", "yes"},
                                   {"level", "-1"},
                                   {"location", "underground"},
                                   {"layer", "-2"}}) {
    const MapLightSet set = place({node(1, {0, 12}, {{"advertising", "screen"}, {key, value}})}, {},
                                  test::make_flat_ground(), make_street());
    EXPECT_EQ(set.signs.size(), 0u) << key;
    EXPECT_EQ(set.report.left_out.at("below the ground or in a building"), 1u) << key;
  }
  osm::OsmTags hall = soccer;
  hall["covered"] = "yes";
  EXPECT_EQ(kind_of(place({area(2, {0, 0}, {100, 60}, hall)}), MapLightKind::pitch).lit, 0u);
}

TEST(MapLights, LitGroundsOfSportsAreLitAsPitchesWhereTheyHoldNoneThatIs) {
  for (const char* leisure : {"stadium", "sports_centre", "ice_rink", "skatepark", "track"}) {
    const Thing ground = area(1, {0, 0}, {120, 90}, {{"leisure", leisure}, {"lit", "yes"}});
    const MapLightSet set = place({ground});
    EXPECT_EQ(kind_of(set, MapLightKind::pitch).lit, 1u) << leisure;
    EXPECT_GE(set.luminaires.size(), 4u) << leisure;
  }
  const osm::OsmTags stadium{{"leisure", "stadium"}, {"lit", "yes"}};
  const MapLightSet both =
      place({area(1, {-20, -20}, {125, 90}, stadium), area(2, {0, 0}, {105, 68}, soccer)});
  EXPECT_EQ(kind_of(both, MapLightKind::pitch).lit, 1u);
  EXPECT_EQ(both.report.left_out.at("sports ground whose pitches are lit by themselves"), 1u);
  osm::OsmTags dark = soccer;
  dark["lit"] = "no";
  EXPECT_EQ(
      kind_of(place({area(1, {-20, -20}, {125, 90}, stadium), area(2, {0, 0}, {105, 68}, dark)}),
              MapLightKind::pitch)
          .lit,
      1u);
  // A hall is lit inside, a stadium that is a building is open above its pitch.
  const auto with_building = [](osm::OsmTags tags) {
    tags["building"] = "yes";
    return kind_of(place({area(1, {0, 0}, {120, 90}, std::move(tags))}), MapLightKind::pitch).lit;
  };
  EXPECT_EQ(with_building({{"leisure", "sports_centre"}, {"lit", "yes"}}), 0u);
  EXPECT_EQ(with_building(stadium), 1u);
}

TEST(MapLights, TowersWithWallsAreFloodlitAndMastsAreTold) {
  const auto floodlights = [](osm::OsmTags tags) {
    return place({node(1, {0, 0}, std::move(tags))}).luminaires.size();
  };
  EXPECT_GT(floodlights({{"man_made", "tower"}, {"lit", "yes"}, {"height", "40"}}), 0u);
  EXPECT_GT(floodlights({{"man_made", "chimney"}, {"lit", "sunset-23:00"}}), 0u);
  EXPECT_EQ(floodlights({{"man_made", "chimney"}, {"lit", "no"}}), 0u);
  const auto reason = [](osm::OsmTags tags) {
    const MapLightSet set = place({node(1, {0, 0}, std::move(tags))});
    EXPECT_TRUE(set.luminaires.empty());
    return set.report.left_out.empty() ? "" : set.report.left_out.begin()->first;
  };
  EXPECT_EQ(reason({{"man_made", "mast"}, {"lit", "yes"}}),
            "mast or lattice tower, which has no walls");
  EXPECT_EQ(reason({{"man_made", "tower"}, {"tower:construction", "lattice"}, {"lit", "yes"}}),
            "mast or lattice tower, which has no walls");
  EXPECT_EQ(reason({{"aeroway", "obstruction_light"}, {"lit", "yes"}}),
            "obstruction light, which no kind of light here stands for");
}

}  // namespace
}  // namespace nightcity::map_lights
