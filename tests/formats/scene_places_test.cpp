// Latitudes, longitudes and street names in city.glb: there and back, and what is unsound.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "formats/error.h"
#include "formats/gltf_samples.h"
#include "formats/scene_places_json.h"
#include "formats/scene_reader.h"
#include "formats/scene_writer.h"
#include "support/temp_folder.h"

namespace nightcity {
namespace {

using nlohmann::json;

// 13 to 14 degrees east and 52 to 53 degrees north over 68 x 111 km: linear, so that it has closed
// forms.
GeographicFit linear_fit() {
  return {{0, 0}, {68'000, 111'000}, 2, {52.5, 0.5, 0, 0}, {13.5, 0, 0.5, 0}};
}

ScenePlaces make_places() {
  ScenePlaces places;
  places.geographic = linear_fit();
  places.streets = {{"Straße \"A\"", {{{0, 1}, {2.26, -3}}, {{5, 5}}}}, {"東京", {{{7, 8}}}}};
  return places;
}

TEST(ScenePlaces, GoThroughTheFileAndBack) {
  const test::TempFolder folder;
  SceneWriter writer(folder / "city.glb", {});
  writer.finish({"EPSG:28992", {1, 2, 3}, {}, {}}, make_places());
  const Scene scene = read_scene(folder / "city.glb");
  EXPECT_TRUE(scene.skipped.empty());
  ASSERT_TRUE(scene.places.geographic);
  EXPECT_EQ(scene.places.geographic->latitude, linear_fit().latitude);
  EXPECT_EQ(scene.places.geographic->longitude, linear_fit().longitude);
  EXPECT_EQ(scene.places.geographic->high, linear_fit().high);
  ASSERT_EQ(scene.places.streets.size(), 2u);
  EXPECT_EQ(scene.places.streets[0].name, "Straße \"A\"");
  EXPECT_EQ(scene.places.streets[0].lines[0][1], glm::dvec2(2.3, -3));  // to a decimetre
  EXPECT_EQ(scene.places.streets[0].lines[1].size(), 1u);
  EXPECT_EQ(scene.places.streets[1].name, "東京");
}

TEST(ScenePlaces, OtherNamesGoThroughTheFileAndUnsoundOnesAreNotUsed) {
  ScenePlaces places = make_places();
  places.streets[1].also = {"Tokyo", "とうきょう"};
  json extras = json::object();
  add_to_json(places, extras);
  EXPECT_FALSE(extras["streets"][0].contains("also"));
  std::vector<std::string> skipped;
  EXPECT_EQ(places_from_json(extras, skipped).streets[1].also, places.streets[1].also);
  for (const json& unsound : {json("Tokyo"), json{"Tokyo", 7}, json{"Tokyo", "\x1b[31m"},
                              json(std::vector<std::string>(33, "Tokyo"))}) {
    extras["streets"][1]["also"] = unsound;
    const ScenePlaces read = places_from_json(extras, skipped);
    ASSERT_EQ(read.streets.size(), 2u);
    EXPECT_TRUE(read.streets[1].also.empty());
  }
  EXPECT_TRUE(skipped.empty());
  places.streets[1].also.assign(33, "Tokyo");
  EXPECT_THROW(add_to_json(places, extras), Error);
}

TEST(ScenePlaces, ASceneWithoutThemHasNone) {
  const test::TempFolder folder;
  SceneWriter writer(folder / "city.glb", {});
  writer.finish({});
  const Scene scene = read_scene(folder / "city.glb");
  EXPECT_FALSE(scene.places.geographic);
  EXPECT_TRUE(scene.places.streets.empty());
  EXPECT_TRUE(scene.skipped.empty());
}

// A reader leaves out unsound places, says so, and reads the scene all the same.
TEST(ScenePlaces, UnsoundDegreesAreLeftOutAndSaid) {
  const auto read_changed = [](const std::function<void(json&)>& change) {
    json document = test::foreign();
    json& extras = document["asset"]["extras"]["nightcity"];
    extras = json::object();
    add_to_json(make_places(), extras);
    change(extras["geographic"]);
    return test::read(document);
  };
  EXPECT_TRUE(read_changed([](json&) {}).places.geographic);
  const std::vector<std::function<void(json&)>> faults{
      [](json& fit) { fit = 7; },
      [](json& fit) {
        fit["low"] = {1, 2, 3};
      },
      [](json& fit) {
        fit["low"] = {"x", 2};
      },
      [](json& fit) {
        fit["low"] = {1e300, 0};
      },
      [](json& fit) { fit["low"] = fit["high"]; },
      [](json& fit) { fit.erase("high"); },
      [](json& fit) { fit["terms"] = 0; },
      [](json& fit) { fit["terms"] = 1; },
      [](json& fit) { fit["terms"] = -2; },
      [](json& fit) { fit["terms"] = 1'000'000'000; },
      [](json& fit) { fit["terms"] = 2.5; },
      [](json& fit) { fit["latitude"].push_back(0); },
      [](json& fit) {
        fit["latitude"] = {nullptr, 0, 0, 0};
      },
      [](json& fit) {
        fit["longitude"] = {1e200, 0, 0, 0};
      },
      [](json& fit) {
        fit["longitude"] = {13.5, 0, 0, 0};
      },  // no inverse
      [](json& fit) {
        fit["longitude"] = {13.5, 0, -0.5, 0};
      },                                                      // a mirror
      [](json& fit) { fit["longitude"] = fit["latitude"]; },  // one direction alone
      [](json& fit) {
        fit["longitude"] = {13.5, 0, 0.1, 0.5};
      },  // folded
      [](json& fit) {
        fit["latitude"] = {89.9, 0.5, 0, 0};
      },  // beyond the pole
      [](json& fit) {
        fit["high"] = {1e-3, 1e-3};
      },  // a degree in a millimetre
  };
  for (std::size_t i = 0; i < faults.size(); ++i) {
    const Scene scene = read_changed(faults[i]);
    EXPECT_FALSE(scene.places.geographic) << i;
    ASSERT_FALSE(scene.skipped.empty()) << i;
    EXPECT_NE(scene.skipped.back().find("latitude and longitude are left out"), std::string::npos);
    EXPECT_EQ(scene.places.streets.size(), 2u);
  }
}

TEST(ScenePlaces, UnsoundStreetsAreLeftOutAndCounted) {
  json document = test::foreign();
  json& streets = document["asset"]["extras"]["nightcity"]["streets"];
  streets = {{{"name", "good"}, {"lines", {{1, 2, 3, 4}}}},
             {{"name", ""}, {"lines", {{1, 2}}}},
             {{"name", "bell\a"}, {"lines", {{1, 2}}}},
             {{"name", std::string(1021, 'x')}, {"lines", {{1, 2}}}},
             {{"name", 7}, {"lines", {{1, 2}}}},
             {{"name", "no line"}, {"lines", json::array()}},
             {{"name", "odd"}, {"lines", {{1, 2, 3}}}},
             {{"name", "empty"}, {"lines", {json::array()}}},
             {{"name", "far"}, {"lines", {{1e300, 0}}}},
             {{"name", "far, too"}, {"lines", {{0, 2e6}}}},
             {{"name", "word"}, {"lines", {{"x", 0}}}},
             {{"name", "flat"}, {"lines", {7}}},
             json("text")};
  const Scene scene = test::read(document);
  ASSERT_EQ(scene.places.streets.size(), 1u);
  EXPECT_EQ(scene.places.streets[0].name, "good");
  ASSERT_EQ(scene.skipped.size(), 1u);
  EXPECT_EQ(scene.skipped[0].substr(0, 3), "12 ");
  streets = 7;
  EXPECT_EQ(test::read(document).skipped.size(), 1u);
  // Names without end.
  json line = json::array();
  for (int i = 0; i < 200'000; ++i) line.push_back(1);
  streets = json::array();
  for (int i = 0; i < 11; ++i) streets.push_back({{"name", "long"}, {"lines", {line}}});
  EXPECT_EQ(test::read(document).places.streets.size(), 10u);
}

TEST(ScenePlaces, WritersRefuseWhatReadersLeaveOut) {
  const auto refused = [](const std::function<void(ScenePlaces&)>& change) {
    const test::TempFolder folder;
    ScenePlaces places = make_places();
    change(places);
    SceneWriter writer(folder / "city.glb", {});
    try {
      writer.finish({}, places);
    } catch (const Error& error) {
      return std::string(error.what()).find("city.glb") != std::string::npos;
    }
    return false;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(refused([](ScenePlaces&) {}));
  EXPECT_TRUE(refused([&](ScenePlaces& places) { places.geographic->latitude[1] = nan; }));
  EXPECT_TRUE(refused([&](ScenePlaces& places) { places.geographic->low.x = nan; }));
  EXPECT_TRUE(refused([&](ScenePlaces& places) { places.streets[0].lines[0][0].y = nan; }));
  EXPECT_TRUE(refused([&](ScenePlaces& places) { places.streets[0].name = "\x1b"; }));
}

TEST(GeographicFit, IsItsOwnInverseWithinItsRectangleAndNothingOutside) {
  const GeographicFit fit = linear_fit();
  const auto degrees = to_degrees(fit, {17'000, 27'750});
  ASSERT_TRUE(degrees);
  EXPECT_NEAR(degrees->x, 52.25, 1e-12);
  EXPECT_NEAR(degrees->y, 13.25, 1e-12);
  const auto plane = to_plane(fit, 52.25, 13.25 + 360);
  ASSERT_TRUE(plane);
  EXPECT_NEAR(plane->x, 17'000, 1e-4);
  EXPECT_NEAR(plane->y, 27'750, 1e-4);
  for (const glm::dvec2& outside : {glm::dvec2(-1, 0), {0, 111'001}, {1e300, 0}, {NAN, 0}})
    EXPECT_FALSE(to_degrees(fit, outside));
  for (const glm::dvec2& outside :
       {glm::dvec2(51.99, 13.5), {52.5, 14.01}, {-52, 13.5}, {NAN, 13}, {52, INFINITY}})
    EXPECT_FALSE(to_plane(fit, outside.x, outside.y));
}

}  // namespace
}  // namespace nightcity
