// Lamps on a model, beside it and where no source has heights.
#include "tools/elevation/elevate.h"

#include <gtest/gtest.h>

#include <array>

#include "support/temp_folder.h"
#include "tools/elevation/rasters.h"
#include "tools/elevation/stand_in.h"

namespace nightcity::elevation {
namespace {

using test::StandIn;

/// A frame of 100 km per degree, so that places are easy to read.
glm::dvec2 to_frame(const glm::dvec2& lon_lat) {
  return (lon_lat - glm::dvec2(13, 52)) * 100'000.0;
}

osm::OsmLampNode lamp(std::int64_t id, double east, double north) {
  return {id, glm::dvec2(13, 52) + glm::dvec2(east, north) / 100'000.0, {}};
}

mesh::TriangleMesh square(double x0, double y0, double x1, double y1, double height) {
  mesh::TriangleMesh mesh;
  mesh.positions = {{x0, y0, height}, {x1, y0, height}, {x1, y1, height}, {x0, y1, height}};
  for (const auto& corners : {std::array<std::uint32_t, 3>{0, 1, 2}, {0, 2, 3}}) {
    mesh::MeshTriangle triangle{};
    for (std::size_t k = 0; k < 3; ++k) triangle.vertex[k] = corners[k];
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

TEST(Elevate, TerrainAndRoadsWinOverBuildings) {
  terrain::Terrain terrain;
  terrain.add(square(0, 0, 100, 100, 30), terrain::SurfaceClass::terrain);
  terrain.add(square(100, 0, 200, 100, 33), terrain::SurfaceClass::road);
  terrain.add(square(40, 40, 60, 60, 30.5), terrain::SurfaceClass::ground_surface);
  terrain.add(square(40, 40, 60, 60, 45), terrain::SurfaceClass::roof);
  terrain.add(square(140, 40, 160, 60, 60), terrain::SurfaceClass::roof);
  terrain.add(square(240, 40, 260, 60, 50), terrain::SurfaceClass::roof);
  terrain.build(0);
  const std::vector<osm::OsmLampNode> lamps = {lamp(1, 10, 10),  lamp(2, 50, 50),
                                               lamp(3, 150, 50), lamp(4, 250, 50),
                                               lamp(5, 900, 50), lamp(6, 10.1, 10.1)};
  const Elevations found = elevate_lamps(lamps, {&terrain, to_frame, nullptr, nullptr});
  EXPECT_NEAR(found.heights.at(1), 30, 1e-9);
  EXPECT_NEAR(found.heights.at(2), 30, 1e-9);
  EXPECT_NEAR(found.heights.at(3), 33, 1e-9);
  EXPECT_NEAR(found.heights.at(4), 50, 1e-9);
  EXPECT_FALSE(found.heights.contains(5));
  EXPECT_EQ(found.sources, (std::map<std::string, std::size_t>{
                               {"nothing", 1}, {"road", 1}, {"roof", 1}, {"terrain", 3}}));
  EXPECT_EQ(found.outside_model, 1u);
  EXPECT_EQ(found.inside_buildings, 3u);
  EXPECT_EQ(found.duplicates, 1u);
}

TEST(Elevate, RasterAndServiceAreBroughtToTheModelsHeightsByOneRobustNumber) {
  terrain::Terrain terrain;
  terrain.add(square(0, 0, 1000, 1000, 30), terrain::SurfaceClass::terrain);
  terrain.build(0);
  // The raster says 75 m where the model says 30, but for one cell of nonsense; it ends at 1500 m.
  const test::TempFolder folder;
  test::write_raster(
      folder / "dem.tif", 4326, 13, 52.01, 0.001, 15, 10,
      [](int column, int row) { return column == 0 && row == 9 ? 500.0 : 75.0; }, -9999);
  const DemRaster dem(folder / "dem.tif");
  const StandIn server([](const std::string& body) {
    return StandIn::heights(body, [](double, double lon) -> nlohmann::json {
      if (lon > 13.0245) return 0;  // no data there
      return lon > 13.0195 ? 52.0 : 50.0;
    });
  });
  ElevationServiceOptions service;
  service.url = server.url();
  std::vector<osm::OsmLampNode> lamps;
  for (int n = 0; n < 9; ++n) lamps.push_back(lamp(n, 50 + 100 * n, 50));  // on the model
  lamps.push_back(lamp(20, 1250, 500));                                    // on the raster
  lamps.push_back(lamp(21, 2000, 500));                                    // beyond both
  lamps.push_back(lamp(22, 2500, 500));  // where no source has heights
  const Elevations found = elevate_lamps(lamps, {&terrain, to_frame, &dem, &service});
  EXPECT_NEAR(found.raster_offset.metres, -45, 1e-9);
  EXPECT_EQ(found.raster_offset.samples, 9u);
  EXPECT_NEAR(found.raster_offset.deviation, 0, 1e-9);
  EXPECT_NEAR(found.heights.at(20), 30, 1e-9);
  EXPECT_NEAR(found.service_offset.metres, -20, 1e-9);
  EXPECT_NEAR(found.heights.at(21), 32, 1e-9);
  EXPECT_FALSE(found.heights.contains(22));
  EXPECT_EQ(found.sources.at("nothing"), 1u);
}

TEST(Elevate, WithoutAModelHeightsStayAsTheSourceHasThem) {
  const StandIn server([](const std::string& body) {
    return StandIn::heights(body, [](double, double) -> nlohmann::json { return 42; });
  });
  ElevationServiceOptions service;
  service.url = server.url();
  const Elevations found =
      elevate_lamps({lamp(1, 0, 0), lamp(2, 100, 0)}, {nullptr, {}, nullptr, &service});
  EXPECT_EQ(found.heights.at(2), 42);
  EXPECT_EQ(found.service_offset.samples, 0u);
  EXPECT_EQ(found.outside_model, 0u);
}

}  // namespace
}  // namespace nightcity::elevation
