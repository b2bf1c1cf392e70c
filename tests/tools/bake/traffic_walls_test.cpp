// The default town's traffic is compared with the town: no vehicle drives through a wall, or above
// or below the ground.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "formats/traffic_pose.h"
#include "support/temp_folder.h"
#include "tools/bake/bake_options.h"
#include "tools/bake/city/road_consumer.h"
#include "tools/bake/stages/traffic_stage.h"
#include "tools/osm/read_osm.h"
#include "tools/town/town.h"

namespace nightcity::bake {
namespace {

struct TownWithTraffic {
  std::unique_ptr<City> city;
  Georeference georeference;
  StreetReport streets;
  traffic::TrafficSet traffic;

  explicit TownWithTraffic(bool with_map) {
    const test::TempFolder folder;
    town::write_town({}, folder.path());
    BakeOptions options = to_bake_options(read_recipe(folder / "town.toml"));
    options.city.drops_roads = false;
    options.traffic.vehicles = 80;
    options.traffic.cycle_s = 200;
    if (!with_map) options.city.maps.clear();
    city = std::make_unique<City>(options.city);
    streets = read_ground_and_streets(*city, true, {});
    georeference = city->georeference();
    traffic = make_city_traffic(*city, options.traffic, georeference, {});
  }

  const terrain::Terrain& terrain() const { return city->terrain(); }

  /// Calls with every body at moments 0.9 s apart.
  template <class Visit>
  void for_each_body(const Visit& visit) const {
    TrafficContent content = traffic.content();
    for (float& share : content.cycle.density) share = 1;
    for (const Trip& trip : content.trips)
      for (double t = 0; t < 200; t += 0.9)
        if (const auto pose = pose_at(content, trip, t))
          visit(*pose, content.vehicles[trip.vehicle].half_size,
                georeference.from_model(pose->position));
  }
};

const TownWithTraffic& town_by_its_roads() {
  static const TownWithTraffic town(false);
  return town;
}

const TownWithTraffic& town_by_its_map() {
  static const TownWithTraffic town(true);
  return town;
}

class TownTraffic : public testing::TestWithParam<bool> {
 protected:
  static const TownWithTraffic& town() {
    return GetParam() ? town_by_its_map() : town_by_its_roads();
  }
};

TEST_P(TownTraffic, FillsTheStreets) {
  EXPECT_GT(town().traffic.trips.size(), 60u);
  EXPECT_GT(town().traffic.report.mean_vehicles, 50);
}

TEST_P(TownTraffic, NobodyDrivesThroughAWall) {
  std::size_t bodies = 0, in_walls = 0;
  town().for_each_body(
      [&](const VehiclePose& pose, const glm::vec3& half, const glm::dvec3& place) {
        ++bodies;
        const glm::dvec2 ahead(std::cos(pose.yaw), std::sin(pose.yaw)), right(ahead.y, -ahead.x);
        for (const double along : {-1.0, -0.5, 0.0, 0.5, 1.0})
          for (const double aside : {-1.0, 1.0})
            in_walls += town()
                            .terrain()
                            .height_of(terrain::SurfaceClass::ground_surface,
                                       glm::dvec2(place) + ahead * (along * double{half.x}) +
                                           right * (aside * double{half.z}))
                            .has_value();
      });
  EXPECT_GT(bodies, 5000u);
  EXPECT_EQ(in_walls, 0u);
}

TEST_P(TownTraffic, WheelsStandOnTheGroundOrTheRoadOnIt) {
  std::size_t bodies = 0, off = 0;
  double worst = 0;
  town().for_each_body([&](const VehiclePose&, const glm::vec3&, const glm::dvec3& place) {
    const auto ground =
                   town().terrain().height_of(terrain::SurfaceClass::terrain, glm::dvec2(place)),
               road = town().terrain().height_of(terrain::SurfaceClass::road, glm::dvec2(place));
    ASSERT_TRUE(ground);
    // Kerbs are a step of 12 cm beside the carriageway, the road itself lies on the ground.
    const double height = std::max(*ground, road.value_or(*ground)),
                 error = std::abs(place.z - height);
    ++bodies;
    off += error > 0.12;
    worst = std::max(worst, error);
  });
  EXPECT_LE(off, bodies / 200) << "of " << bodies;
  EXPECT_LT(worst, 0.4);
}

INSTANTIATE_TEST_SUITE_P(Streets, TownTraffic, testing::Bool(), [](const auto& with_map) {
  return with_map.param ? std::string("OfTheMap") : std::string("OfTheModel");
});

TEST(ModelStreets, AreAsLongAsTheMaps) {
  const test::TempFolder folder;
  town::write_town({}, folder.path());
  double map_km = 0, model_km = 0;
  for (const osm::OsmWay& way : osm::read_osm(folder / "town.osm").highways)
    if (const std::string& highway = way.tags.at("highway");
        highway != "footway" && highway != "pedestrian")
      for (std::size_t n = 1; n < way.lon_lat.size(); ++n) {
        const glm::dvec2 d = (way.lon_lat[n] - way.lon_lat[n - 1]) * 111.2;  // km a degree
        map_km += std::hypot(d.x * std::cos(way.lon_lat[n].y * 3.14159 / 180), d.y);
      }
  for (const auto& [highway, km] : town_by_its_roads().streets.km) model_km += km;
  EXPECT_NEAR(model_km, map_km, 0.05 * map_km);
}

}  // namespace
}  // namespace nightcity::bake
