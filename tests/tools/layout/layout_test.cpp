// Layouts on a plane, for which the places of lamps are known.
#include "tools/layout/layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "tools/layout/layout_design.h"
#include "tools/layout/street_plane.h"

namespace nightcity::layout {
namespace {

using test::street;

struct Laid {
  lights::LampSet set;
  LayoutReport report;
};

Laid lay_out(std::vector<osm::OsmWay> ways, const place::InsideBuilding& inside = {},
             const LayoutOptions& options = {}, std::vector<osm::OsmLampNode> mapped = {}) {
  osm::OsmData osm;
  osm.highways = std::move(ways);
  osm.lamps = std::move(mapped);
  Laid result;
  result.set = lights::place_lamps(osm, test::to_plane, test::plane, inside);
  result.report = lay_out_lamps(osm, test::to_plane, test::plane, inside, {}, options, result.set);
  return result;
}

osm::OsmTags tags(const char* highway, osm::OsmTags more = {}) {
  more["highway"] = highway;
  return more;
}

std::vector<double> eastings(const lights::LampSet& set) {
  std::vector<double> x;
  for (const lights::PlacedLamp& lamp : set.lamps) x.push_back(lamp.foot.x);
  std::sort(x.begin(), x.end());
  return x;
}

double min_distance(const lights::LampSet& set) {
  double least = 1e9;
  for (std::size_t a = 0; a < set.lamps.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      least = std::min(least, glm::distance(set.lamps[a].foot, set.lamps[b].foot));
  return least;
}

TEST(Layout, LampsStandEvenlyBehindOneKerbAndLookAtTheRoad) {
  const Laid laid = lay_out({street(1, {{-300, 0}, {300, 0}}, tags("residential"))});
  const lights::RoadLighting road = *lights::find_road_lighting("residential");
  ASSERT_EQ(laid.report.streets.size(), 1u);
  const double designed = laid.report.streets[0].spacing_m;
  EXPECT_GE(designed, 2.5 * road.mounting_m - 1e-9);
  EXPECT_LE(designed, 3.0 * road.mounting_m + 1e-9);
  const std::vector<double> x = eastings(laid.set);
  ASSERT_GE(x.size(), 600 / designed);
  EXPECT_NEAR(x.front(), -300, 1e-6);
  EXPECT_NEAR(x.back(), 300, 1e-6);
  const double step = 600.0 / static_cast<double>(x.size() - 1);
  EXPECT_NEAR(step, designed, 0.1 * designed);
  for (std::size_t n = 1; n < x.size(); ++n) EXPECT_NEAR(x[n] - x[n - 1], step, 1e-6);
  for (const lights::PlacedLamp& lamp : laid.set.lamps) {
    EXPECT_NEAR(lamp.foot.y, laid.set.lamps[0].foot.y, 1e-6);
    EXPECT_NEAR(std::abs(lamp.foot.y), laid.report.streets[0].width_m / 2 + setback_m(road), 1e-6);
    EXPECT_NEAR(lamp.aim.y, lamp.foot.y > 0 ? -1 : 1, 1e-9);
    EXPECT_EQ(lamp.foot.z, 40);
    EXPECT_EQ(lamp.mounting_height_m, road.mounting_m);
    EXPECT_EQ(lamp.provenance.source_id, 1u);
    EXPECT_EQ(lamp.provenance.position, ValueSource::rule);
    EXPECT_EQ(lamp.provenance.flux, ValueSource::standard);
  }
}

TEST(Layout, WideStreetsHaveLampsOnBothSides) {
  const double mounting = lights::find_road_lighting("primary")->mounting_m;
  const Laid staggered = lay_out({street(
      1, {{-300, 0}, {300, 0}}, tags("primary", {{"width", std::to_string(mounting * 1.5)}}))});
  EXPECT_EQ(staggered.report.streets[0].arrangement, Arrangement::staggered);
  const auto left = std::count_if(staggered.set.lamps.begin(), staggered.set.lamps.end(),
                                  [](const lights::PlacedLamp& l) { return l.foot.y > 0; });
  EXPECT_NEAR(static_cast<double>(left) / static_cast<double>(staggered.set.lamps.size()), 0.5,
              0.1);
  const Laid opposite = lay_out({street(
      1, {{-300, 0}, {300, 0}}, tags("primary", {{"width", std::to_string(mounting * 2)}}))});
  EXPECT_EQ(opposite.report.streets[0].arrangement, Arrangement::opposite);
  const std::vector<double> x = eastings(opposite.set);
  ASSERT_EQ(x.size() % 2, 0u);
  for (std::size_t n = 0; n < x.size(); n += 2) EXPECT_NEAR(x[n], x[n + 1], 1e-6);
}

TEST(Layout, EveryClassOfRoadLandsInItsLightingClass) {
  for (const char* highway :
       {"primary", "secondary", "tertiary", "residential", "living_street", "pedestrian"}) {
    const Laid laid = lay_out({street(1, {{-400, 0}, {400, 0}}, tags(highway))});
    const RoadClassReport& sum = laid.report.classes.at(highway);
    EXPECT_GE(sum.average_lx * lights::maintenance_factor, sum.wanted_lx) << highway;
    EXPECT_LE(sum.average_lx * lights::maintenance_factor, sum.wanted_lx * lights::max_excess)
        << highway;
    EXPECT_EQ(sum.in_class, 1) << highway;
    EXPECT_GT(sum.uniformity, 0.1) << highway;
  }
}

TEST(Layout, TheRecipesClassReplacesTheTables) {
  LayoutOptions options;
  options.class_of["residential"] = "P1";
  const Laid laid = lay_out({street(1, {{-400, 0}, {400, 0}}, tags("residential"))}, {}, options);
  const RoadClassReport& sum = laid.report.classes.at("residential");
  EXPECT_EQ(sum.wanted, "P1");
  EXPECT_GE(sum.average_lx * lights::maintenance_factor, 15);
  EXPECT_LE(sum.average_lx * lights::maintenance_factor, 22.5);
}

TEST(Layout, UnlitStreetsStayDark) {
  EXPECT_EQ(
      lay_out({street(1, {{0, 0}, {300, 0}}, tags("residential", {{"lit", "no"}}))}).report.lamps,
      0u);
  const Laid laid = lay_out({street(1, {{0, 0}, {300, 0}}, tags("primary", {{"tunnel", "yes"}}))});
  EXPECT_EQ(laid.report.lamps, 0u);
  EXPECT_EQ(laid.report.unlit_ways.at("tunnel or under cover"), 1u);
}

TEST(Layout, LampsKeepTheHoursOfTheirWay) {
  const auto laid = [](const char* lit) {
    return lay_out({street(1, {{-100, 0}, {100, 0}}, tags("residential", {{"lit", lit}}))});
  };
  for (const char* lit : {"20:00-06:00", "limited", "interval", "Mo-Su 18:00-23:00"}) {
    const Laid result = laid(lit);
    ASSERT_FALSE(result.set.lamps.empty()) << lit;
    for (const lights::PlacedLamp& lamp : result.set.lamps) {
      EXPECT_TRUE(lamp.hours) << lit;
      EXPECT_EQ(lamp.provenance.schedule, ValueSource::tag);
    }
    EXPECT_TRUE(result.report.notes.empty());
  }
  for (const char* lit : {"yes", "automatic", "unknown"})
    EXPECT_FALSE(laid(lit).set.lamps.at(0).hours) << lit;
  EXPECT_TRUE(laid("none").set.lamps.empty());
  EXPECT_EQ(laid("operating_times").report.notes.size(), 1u);
}

TEST(Layout, NeverMeansNever) {
  LayoutOptions options;
  options.mode = LayoutOptions::Mode::never;
  EXPECT_TRUE(
      lay_out({street(1, {{0, 0}, {300, 0}}, tags("residential"))}, {}, options).set.lamps.empty());
}

/// A town of blocks, its streets mapped as ways of two blocks each.
std::vector<osm::OsmWay> grid(double block) {
  std::vector<osm::OsmWay> ways;
  std::int64_t id = 10;
  for (int row = -2; row <= 2; ++row)
    for (int part = -1; part <= 0; ++part) {
      const char* highway = row == 0 ? "secondary" : "residential";
      ways.push_back(street(id++,
                            {{2 * part * block, row * block},
                             {(2 * part + 1) * block, row * block},
                             {(2 * part + 2) * block, row * block}},
                            tags(highway)));
      ways.push_back(street(id++,
                            {{row * block, 2 * part * block},
                             {row * block, (2 * part + 1) * block},
                             {row * block, (2 * part + 2) * block}},
                            tags("residential")));
    }
  return ways;
}

TEST(Layout, EveryJunctionIsLitOnce) {
  const double block = 90;
  const Laid laid = lay_out(grid(block));
  const double near = 8;
  for (int x = -2; x <= 2; ++x)
    for (int y = -2; y <= 2; ++y) {
      const auto lamps = std::count_if(
          laid.set.lamps.begin(), laid.set.lamps.end(), [&](const lights::PlacedLamp& l) {
            return glm::distance(glm::dvec2(l.foot), glm::dvec2(x * block, y * block)) < near + 4;
          });
      EXPECT_EQ(lamps, 1) << x << "," << y;
    }
  EXPECT_GT(min_distance(laid.set), 8);
}

TEST(Layout, NoLampStandsOnACarriageway) {
  const double block = 90;
  const Laid laid = lay_out(grid(block));
  for (const lights::PlacedLamp& lamp : laid.set.lamps)
    for (int line = -2; line <= 2; ++line) {
      if (std::abs(lamp.foot.x) <= 2 * block) {
        EXPECT_GT(std::abs(lamp.foot.y - line * block), 3.0) << lamp.foot.x << "," << lamp.foot.y;
      }
      if (std::abs(lamp.foot.y) <= 2 * block) {
        EXPECT_GT(std::abs(lamp.foot.x - line * block), 3.0) << lamp.foot.x << "," << lamp.foot.y;
      }
    }
}

TEST(Layout, LampsKeepClearOfBuildings) {
  // Houses 3.3 m from the centreline on both sides of one stretch, and over the whole street in
  // another.
  const place::InsideBuilding inside = [](const glm::dvec2& p) {
    if (p.x > 0 && p.x < 100) return p.y > 3.7 || p.y < -3.7;
    return p.x > 150 && p.x < 200;
  };
  const Laid laid = lay_out({street(1, {{-300, 0}, {300, 0}}, tags("residential"))}, inside);
  std::size_t between = 0;
  for (const lights::PlacedLamp& lamp : laid.set.lamps) {
    EXPECT_FALSE(lamp.foot.x > 149.5 && lamp.foot.x < 200.5);
    if (lamp.foot.x > 0 && lamp.foot.x < 100) {
      ++between;
      if (!lamp.hung) {
        EXPECT_LE(std::abs(lamp.foot.y), 3.2 + 1e-6);
      }
    }
    for (int n = 0; n < 16; ++n) {
      const double a = n * 0.39269908169872414;
      EXPECT_FALSE(inside(glm::dvec2(lamp.foot) + 0.4 * glm::dvec2(std::cos(a), std::sin(a))));
    }
  }
  EXPECT_GE(between, 5u);
  EXPECT_GE(laid.report.left_out.at("no room before a building"), 2u);
}

TEST(Layout, ANarrowLaneHasItsLampsHungOverItsMiddle) {
  const place::InsideBuilding inside = [](const glm::dvec2& p) {
    return std::abs(p.y) > 3.05 && std::abs(p.y) < 20;
  };
  const Laid laid = lay_out({street(1, {{-200, 0}, {200, 0}}, tags("residential"))}, inside);
  ASSERT_FALSE(laid.set.lamps.empty());
  EXPECT_EQ(laid.report.streets[0].arrangement, Arrangement::central);
  for (const lights::PlacedLamp& lamp : laid.set.lamps) {
    EXPECT_TRUE(lamp.hung);
    EXPECT_NEAR(lamp.foot.y, 0, 1e-9);
    EXPECT_EQ(lamp.outreach, glm::dvec2(0, 0));
  }
  EXPECT_EQ(laid.report.classes.at("residential").in_class, 1);
}

TEST(Layout, MappedLampsWinWithinOneAndAHalfSpacings) {
  std::vector<osm::OsmLampNode> mapped;
  for (int n = 0; n < 12; ++n)
    mapped.push_back(
        {100 + n, glm::dvec2(-300 + 25 * n, 4) / test::metres_per_degree, tags("street_lamp")});
  const Laid laid =
      lay_out({street(1, {{-300, 0}, {300, 0}}, tags("residential"))}, {}, {}, mapped);
  const double spacing = laid.report.streets[0].spacing_m;
  std::size_t laid_out = 0;
  for (const lights::PlacedLamp& lamp : laid.set.lamps)
    if (lamp.provenance.position == ValueSource::rule) {
      ++laid_out;
      EXPECT_GT(lamp.foot.x, -25 + 1.4 * spacing);
    }
  EXPECT_EQ(laid_out, laid.report.lamps);
  EXPECT_GT(laid_out, 10u);
  EXPECT_GT(laid.report.left_out.at("mapped lamps near"), 10u);
}

TEST(Layout, TwinCarriagewaysHaveTheirLampsOutside) {
  // No lamp stands on a median of 2 m.
  const Laid laid = lay_out(
      {street(1, {{-300, 0}, {300, 0}}, tags("primary", {{"oneway", "yes"}, {"lanes", "2"}})),
       street(2, {{300, 9}, {-300, 9}}, tags("primary", {{"oneway", "yes"}, {"lanes", "2"}}))});
  for (const lights::PlacedLamp& lamp : laid.set.lamps)
    if (std::abs(lamp.foot.x) < 299) {
      EXPECT_TRUE(lamp.foot.y < -3 || lamp.foot.y > 12) << lamp.foot.y;
    }
  EXPECT_EQ(laid.report.streets.size(), 2u);
}

TEST(Layout, TheSameWhateverTheOrderOfTheFileAndItsIdsAreNotRepeated) {
  std::vector<osm::OsmWay> ways = grid(90);
  const Laid first = lay_out(ways);
  std::reverse(ways.begin(), ways.end());
  const Laid second = lay_out(ways);
  ASSERT_EQ(first.set.lamps.size(), second.set.lamps.size());
  std::set<std::uint32_t> ids;
  for (std::size_t n = 0; n < first.set.lamps.size(); ++n) {
    const lights::PlacedLamp &a = first.set.lamps[n], &b = second.set.lamps[n];
    EXPECT_EQ(a.id, b.id);
    EXPECT_EQ(a.foot, b.foot);
    EXPECT_EQ(a.flux_lm, b.flux_lm);
    EXPECT_TRUE(ids.insert(a.id).second);
  }
}

// The places of lamps and their fluxes, in an order of their own.
std::vector<std::array<double, 3>> places_and_fluxes(const Laid& laid) {
  std::vector<std::array<double, 3>> out;
  for (const lights::PlacedLamp& lamp : laid.set.lamps)
    out.push_back({lamp.foot.x, lamp.foot.y, lamp.flux_lm});
  std::sort(out.begin(), out.end());
  return out;
}

// Streets of one class that meet at odd distances and angles, so that whoever comes first takes the
// places of others.
std::vector<osm::OsmWay> fan() {
  std::vector<osm::OsmWay> ways;
  for (int k = 0; k < 9; ++k) {
    const double angle = 0.35 * k, away = 130 + 17 * k;
    const glm::dvec2 end(std::round(100 * away * std::cos(angle)) / 100,
                         std::round(100 * away * std::sin(angle)) / 100);
    ways.push_back(street(20 + k, {{0, 0}, end / 2.0, end}, tags("residential")));
    ways.push_back(street(40 + k, {end / 2.0, end / 2.0 + glm::dvec2(31, 47)}, tags("service")));
  }
  return ways;
}

TEST(Layout, TheSameWhateverTheIdsOfWaysTheirOrderAndDirectionAndWhereTheyAreCut) {
  for (const std::vector<osm::OsmWay>& ways : {grid(83), fan()}) {
    const auto expected = places_and_fluxes(lay_out(ways));
    std::uint32_t state = 7;
    const auto draw = [&](std::size_t below) {
      state = state * 1664525u + 1013904223u;
      return (state >> 8) % below;
    };
    for (int round = 0; round < 6; ++round) {
      std::vector<osm::OsmWay> other;
      for (const osm::OsmWay& way : ways) {
        const bool is_cut = way.lon_lat.size() > 2 && draw(3) == 0;
        other.push_back(way);
        if (is_cut) {
          other.back().lon_lat.pop_back();
          other.push_back(way);
          other.back().lon_lat.erase(other.back().lon_lat.begin());
        }
      }
      for (std::size_t n = other.size(); n > 1; --n) std::swap(other[n - 1], other[draw(n)]);
      for (osm::OsmWay& way : other)
        if (draw(2) == 0) std::reverse(way.lon_lat.begin(), way.lon_lat.end());
      for (std::size_t n = 0; n < other.size(); ++n)
        other[n].id = (round % 2 ? -1 : 1) * static_cast<std::int64_t>(100 + n);
      const auto got = places_and_fluxes(lay_out(other));
      ASSERT_EQ(got.size(), expected.size()) << round;
      for (std::size_t n = 0; n < got.size(); ++n)
        for (std::size_t k = 0; k < 3; ++k)
          EXPECT_NEAR(got[n][k], expected[n][k], 1e-6) << round << ", lamp " << n;
    }
  }
}

TEST(Layout, ALampKeepsItsNameWhenAnotherStreetIsAddedFarAway) {
  const osm::OsmWay here = street(7, {{-300, 0}, {0, 0}}, tags("residential"));
  const Laid alone = lay_out({here});
  const Laid more = lay_out({street(3, {{-300, 500}, {300, 500}}, tags("primary")), here});
  std::set<std::uint32_t> ids;
  for (const lights::PlacedLamp& lamp : more.set.lamps) ids.insert(lamp.id);
  for (const lights::PlacedLamp& lamp : alone.set.lamps) EXPECT_TRUE(ids.contains(lamp.id));
}

TEST(Layout, StreetsEndAtTheModelsEdge) {
  const Laid laid = lay_out({street(1, {{500, 0}, {3000, 0}}, tags("residential")),
                             street(2, {{5000, 0}, {6000, 0}}, tags("residential"))});
  ASSERT_FALSE(laid.set.lamps.empty());
  for (const lights::PlacedLamp& lamp : laid.set.lamps) EXPECT_LE(lamp.foot.x, 1000);
  ASSERT_EQ(laid.report.streets.size(), 1u);
  EXPECT_NEAR(laid.report.streets[0].length_m, 500, 5);
}

TEST(Layout, TheReportsAverageIsThatOfTheLampsWritten) {
  const Laid laid = lay_out({street(1, {{-300, 0}, {300, 0}}, tags("tertiary"))});
  const StreetReport& report = laid.report.streets[0];
  lights::Photometry profile;
  const LightProfile& stored = laid.set.profiles[laid.set.lamps[0].profile];
  profile.c_count = stored.c_count;
  profile.gamma_count = stored.gamma_count;
  profile.values.assign(
      laid.set.profile_data.begin() + stored.data_offset,
      laid.set.profile_data.begin() + stored.data_offset + stored.c_count * stored.gamma_count);
  double sum = 0;
  constexpr int along = 600, across = 14;
  for (int i = 0; i < along; ++i)
    for (int j = 0; j < across; ++j)
      for (const lights::PlacedLamp& lamp : laid.set.lamps)
        sum += illuminance({glm::dvec2(lamp.foot) + lamp.outreach, lamp.mounting_height_m, lamp.aim,
                            0, lamp.flux_lm, &profile},
                           {-300 + i + 0.5, ((j + 0.5) / across - 0.5) * report.width_m});
  EXPECT_NEAR(report.field.average_lx, sum / (along * across), 0.02 * report.field.average_lx);
}

}  // namespace
}  // namespace nightcity::layout
