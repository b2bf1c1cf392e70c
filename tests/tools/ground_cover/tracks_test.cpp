#include "tools/ground_cover/tracks.h"

#include <gtest/gtest.h>

namespace nightcity::ground_cover {
namespace {

Tracks read(osm::OsmTags tags, const char* railway = "rail") {
  const TrackKind* kind = find_track_kind(railway);
  EXPECT_EQ(find_reason_to_leave_out(tags, *kind), "");
  return read_tracks(tags, *kind);
}

TEST(Tracks, TheGaugeIsTaggedInMillimetres) {
  EXPECT_EQ(read({{"gauge", "1524"}}).gauges_m, std::vector{1.524});
  EXPECT_EQ(read({{"gauge", " 1000 mm"}}).gauges_m, std::vector{1.0});
  EXPECT_EQ(read({{"gauge", "standard"}}).gauges_m, std::vector{1.435});
  EXPECT_EQ(read({{"gauge", "1435;1000; 1435"}}).gauges_m, (std::vector{1.0, 1.435}));
  EXPECT_EQ(read({{"gauge", "760;nonsense"}}).gauges_m, std::vector{0.76});
}

TEST(Tracks, AGaugeThatNobodySaysOrThatMakesNoSenseIsTheUsualOne) {
  EXPECT_EQ(read({}).gauges_m, std::vector{1.435});
  EXPECT_TRUE(read({}).gauge_assumed);
  EXPECT_EQ(read({}, "narrow_gauge").gauges_m, std::vector{1.0});
  for (const char* text : {"0", "-1435", "1.435", "1e9", "nan", "inf", "1435 yd", ";", "wide",
                           "600;750;900;1000;1200"}) {
    const Tracks tracks = read({{"gauge", text}});
    EXPECT_EQ(tracks.gauges_m, std::vector{1.435}) << text;
    EXPECT_TRUE(tracks.gauge_refused) << text;
    EXPECT_FALSE(tracks.gauge_assumed) << text;
  }
}

TEST(Tracks, InnerFacesOfRailsLieTheGaugeApart) {
  const auto single = read({{"gauge", "1000"}}).find_rails();
  ASSERT_EQ(single.size(), 2u);
  EXPECT_NEAR(single[1] - (single[0] + rail_head_m), 1.0, 1e-12);
  EXPECT_NEAR(single[0] + single[1] + rail_head_m, 0, 1e-12) << "its middle is that of the way";
  const auto mixed = read({{"gauge", "1000;1435"}}).find_rails();
  ASSERT_EQ(mixed.size(), 3u) << "both gauges share a rail";
  EXPECT_NEAR(mixed[1] - (mixed[0] + rail_head_m), 1.0, 1e-12);
  EXPECT_NEAR(mixed[2] - (mixed[0] + rail_head_m), 1.435, 1e-12);
}

TEST(Tracks, TracksOfOneWayLieSideBySide) {
  const Tracks three = read({{"tracks", "3"}});
  ASSERT_EQ(three.count, 3);
  EXPECT_EQ(three.middle_m(0), -4);
  EXPECT_EQ(three.middle_m(1), 0);
  EXPECT_EQ(three.middle_m(2), 4);
  for (const char* text : {"0", "-2", "900", "nan", "many"})
    EXPECT_EQ(read({{"tracks", text}}).count, 1) << text;
}

TEST(Tracks, TagsSayWhatTheyLieOn) {
  EXPECT_EQ(read({}).bed->kind, GroundKind::ballast);
  EXPECT_TRUE(read({}).bed->assumed);
  EXPECT_EQ(read({{"surface", "gravel"}}).bed->kind, GroundKind::ballast);
  EXPECT_EQ(read({{"surface", "grass"}}).bed->kind, GroundKind::grass);
  EXPECT_EQ(read({{"railway:track:grass", "yes"}}).bed->kind, GroundKind::grass);
  EXPECT_EQ(read({{"railway:track", "grass"}}).bed->kind, GroundKind::grass);
  EXPECT_EQ(read({{"surface", "concrete"}}).bed->kind, GroundKind::concrete);
  EXPECT_FALSE(read({{"embedded", "yes"}}).bed);
  EXPECT_FALSE(read({{"embedded_rails", "tram"}}).bed);
  EXPECT_TRUE(read({{"embedded_rails", "no"}}).bed);
  // A sleeper of 2.60 m, twice 0.40 m, and slopes of 0.75 m where there is ballast.
  EXPECT_NEAR(read({}).bed->width_m(1.435), 4.90, 1e-12);
  EXPECT_NEAR(read({{"surface", "grass"}}).bed->width_m(1.435), 3.40, 1e-12);
}

TEST(Tracks, WhatLiesBelowGroundOrIsNoTrackIsLeftOutWithItsReason) {
  const auto reason = [](osm::OsmTags tags, const char* railway) {
    return find_reason_to_leave_out(tags, *find_track_kind(railway));
  };
  for (const char* railway :
       {"disused", "abandoned", "razed", "construction", "proposed", "monorail"})
    EXPECT_EQ(reason({}, railway), std::string("railway=") + railway);
  EXPECT_EQ(reason({{"tunnel", "yes"}}, "tram"), "tracks below ground");
  EXPECT_EQ(reason({{"tunnel", "building_passage"}}, "tram"), "");
  EXPECT_EQ(reason({{"level", "-1.5"}}, "subway"), "tracks below ground");
  EXPECT_EQ(reason({{"layer", "-1"}}, "subway"), "tracks below ground");
  EXPECT_EQ(reason({{"layer", "-1"}}, "rail"), "") << "it lies in a cutting";
  EXPECT_EQ(reason({{"layer", "-1"}, {"covered", "yes"}}, "rail"), "tracks below ground");
  EXPECT_EQ(reason({{"location", "underground"}}, "rail"), "tracks below ground");
  EXPECT_EQ(reason({{"service", "siding"}}, "rail"), "");
  for (const char* railway : {"platform", "station", "switch", "", "yes"})
    EXPECT_EQ(find_track_kind(railway), nullptr) << railway;
}

TEST(Tracks, BridgesAreElevated) {
  EXPECT_FALSE(read({}).elevated);
  EXPECT_FALSE(read({{"bridge", "no"}, {"layer", "0"}}).elevated);
  EXPECT_TRUE(read({{"bridge", "viaduct"}}).elevated);
  EXPECT_TRUE(read({{"layer", "2"}}).elevated);
  EXPECT_TRUE(read({{"level", "1"}}).elevated);
}

}  // namespace
}  // namespace nightcity::ground_cover
