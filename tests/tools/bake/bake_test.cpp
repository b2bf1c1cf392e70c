// Whole bakes of small made-up cities, for which the right result is known.
#include "tools/bake/bake.h"

#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <ogr_spatialref.h>
#include <zlib.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "formats/error.h"
#include "formats/light_edits.h"
#include "formats/light_file.h"
#include "formats/scene_reader.h"
#include "support/data.h"
#include "support/pack_zip.h"
#include "support/temp_folder.h"
#include "tests/tools/citygml/small_city.h"
#include "tools/bake/scene/materials.h"
#include "tools/georeference/frame.h"
#include "tools/nightbake/sample_city.h"

namespace nightcity::bake {
namespace {

using namespace test;

Recipe make_recipe(std::vector<std::filesystem::path> files) {
  Recipe recipe;
  recipe.city.files = std::move(files);
  recipe.windows.lit = false;
  return recipe;
}

struct Box {
  glm::dvec3 least{1e9}, greatest{-1e9};
  void add(const glm::dvec3& p) {
    least = glm::min(least, p);
    greatest = glm::max(greatest, p);
  }
};

// Walls and roofs have a skin or a colour, which their materials' names end with.
std::string find_kind(const std::string& material) {
  for (const char* kind : {"wall", "roof"})
    if (is_of_kind(material, kind)) return kind;
  return material;
}

/// Returns the bounds of each kind of material, in the city's CRS.
std::map<std::string, Box> boxes(const std::filesystem::path& glb) {
  const Scene scene = read_scene(glb);
  std::map<std::string, Box> result;
  for (const SceneNode& node : scene.nodes)
    for (const ScenePrimitive& primitive : scene.meshes[node.mesh].primitives)
      for (const glm::vec3& p : primitive.positions)
        result[find_kind(scene.materials[primitive.material].name)].add(
            scene.georeference.from_model(
                glm::dvec3(node.instances.at(0).to_model * glm::vec4(p, 1))));
  return result;
}

/// Returns a city of one building with one roof that has these corners, in coordinates of the CRS.
std::string roof_city(const std::string& srs_name, const std::vector<glm::dvec3>& ring_places) {
  std::string positions;
  for (std::size_t i = 0; i <= ring_places.size(); ++i) {
    const glm::dvec3& p = ring_places[i % ring_places.size()];
    char text[100];
    std::snprintf(text, sizeof text, "%.6f %.6f %.3f ", p.x, p.y, p.z);
    positions += text;
  }
  std::string city = city_model(
      member("<bldg:Building gml:id=\"" + srs_name + "\">" +
             boundary("RoofSurface", surface_member(polygon("", positions))) + "</bldg:Building>"));
  return city.replace(city.find("EPSG:25833"), 10, srs_name);
}

TEST(Bake, FilesOfTwoZonesShareOneFrame) {
  const TempFolder folder;
  const std::vector<glm::dvec3> here{
      {391000, 5819000, 40}, {391010, 5819000, 40}, {391010, 5819010, 40}, {391000, 5819010, 40}};
  // The same square through longitude and latitude into the neighbouring zone.
  const georeference::CityFrame zone_33 =
      georeference::CityFrame::from_srs_name("EPSG:25833", here, {});
  const std::vector<glm::dvec3> somewhere_in_32{{800000, 5820000, 0}};
  const georeference::CityFrame zone_32 =
      georeference::CityFrame::from_srs_name("EPSG:25832", somewhere_in_32, {});
  std::vector<glm::dvec3> there;
  for (const glm::dvec3& p : here)
    there.emplace_back(zone_32.from_lon_lat(zone_33.to_lon_lat(glm::dvec2(p))), p.z);
  ASSERT_GT(there[0].x, 750000) << "it looks quite different";
  write_text(folder / "a.gml", roof_city("EPSG:25833", here));
  write_text(folder / "b.gml", roof_city("EPSG:25832", there));
  Recipe recipe = make_recipe({folder / "a.gml", folder / "b.gml"});
  recipe.terrain.make_surface = false;
  const BakeReport report = bake(recipe, folder / "out");
  EXPECT_EQ(report.city.objects.at("building"), 2u);
  EXPECT_EQ(report.crs.size(), 2u) << "both frames are told";
  const Box roof = boxes(folder / "out/city.glb").at("roof");
  EXPECT_NEAR(roof.least.x, 391000, 0.002);
  EXPECT_NEAR(roof.greatest.x, 391010, 0.002);
  EXPECT_NEAR(roof.least.y, 5819000, 0.002);
  EXPECT_NEAR(roof.greatest.y, 5819010, 0.002);
}

// Lights are floats in model space: half a metre apart at a northing. The origin is moved in whole
// steps of 50 km, and everything is where it is without it.
TEST(Bake, AnOriginFarFromTheCityIsMoved) {
  const TempFolder folder;
  const std::vector<glm::dvec3> here{{391000.123, 5819000.456, 40},
                                     {391010, 5819000, 40},
                                     {391010, 5819010, 40},
                                     {391000, 5819010, 40}};
  write_text(folder / "a.gml", roof_city("EPSG:25833", here));
  Recipe recipe = make_recipe({folder / "a.gml"});
  recipe.terrain.make_surface = false;
  recipe.origin = {0.0, 0.25, 1e7};
  bake(recipe, folder / "out");
  const glm::dvec3 origin = read_scene_georeference(folder / "out/city.glb").origin;
  EXPECT_EQ(origin, glm::dvec3(400'000, 5'800'000.25, 0));
  const Box roof = boxes(folder / "out/city.glb").at("roof");
  EXPECT_NEAR(roof.least.x, 391000, 0.002);
  EXPECT_NEAR(roof.greatest.y, 5819010, 0.002);
  recipe.origin = {400'500, 5'800'000, 0};
  bake(recipe, folder / "near");
  EXPECT_EQ(read_scene_georeference(folder / "near/city.glb").origin,
            glm::dvec3(400'500, 5'800'000, 0))
      << "as it was asked for";
}

TEST(Bake, ACityThatIsTooFarAcrossIsRefusedByThatName) {
  const TempFolder folder;
  // One roof whose corners are 100.1 km apart.
  write_text(folder / "wide.gml", roof_city("EPSG:25833", {{391000, 5819000, 40},
                                                           {491100, 5819000, 40},
                                                           {491100, 5819010, 40},
                                                           {391000, 5819010, 40}}));
  try {
    bake(make_recipe({folder / "wide.gml"}), folder / "out");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("1 far from the city (far: a corner over 100 km"),
              std::string::npos)
        << error.what();
  }
}

TEST(Bake, ACityOfPolygonsBeyondALimitIsRefusedByTheNameOfTheLimit) {
  const TempFolder folder;
  write_text(folder / "roof.gml", roof_city("EPSG:25833", {{391000, 5819000, 40},
                                                           {391010, 5819000, 40},
                                                           {391010, 5819010, 40},
                                                           {391000, 5819010, 40}}));
  Recipe recipe = make_recipe({folder / "roof.gml"});
  recipe.city.read.polygon.max_points = 3;
  try {
    bake(recipe, folder / "out");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("1 all of polygons beyond [city] max_polygon_points"),
              std::string::npos)
        << error.what();
  }
}

TEST(Bake, GeometriesOfOneFileArePlacedEachByItsOwnCrs) {
  const TempFolder folder;
  const std::vector<glm::dvec3> here{
      {391000, 5819000, 40}, {391010, 5819000, 40}, {391010, 5819010, 40}, {391000, 5819010, 40}};
  const georeference::CityFrame zone_33 =
      georeference::CityFrame::from_srs_name("EPSG:25833", here, {});
  std::vector<glm::dvec3> there;
  for (const glm::dvec3& p : here) {
    const glm::dvec2 lon_lat = zone_33.to_lon_lat(glm::dvec2(p));
    there.emplace_back(lon_lat.y, lon_lat.x, p.z + 30);
  }
  const auto roof = [](const std::string& name, const std::vector<glm::dvec3>& places) {
    std::string text = roof_city("EPSG:25833", places);
    const auto begin = text.find("<core:cityObjectMember"), end = text.find("</core:CityModel");
    text = text.substr(begin, end - begin);
    if (!name.empty())
      text.replace(text.find("<gml:Polygon"), 12, "<gml:Polygon srsName=\"" + name + "\"");
    text.replace(text.find("EPSG:25833"), 10, name.empty() ? "low" : "high");
    return text;
  };
  const std::string urn = "urn:ogc:def:crs:EPSG::4326";
  const auto bake_both = [&](const std::string& name, const std::string& both) {
    write_text(folder / (name + ".gml"), city_model(both));
    Recipe recipe = make_recipe({folder / (name + ".gml")});
    recipe.terrain.make_surface = false;
    return bake(recipe, folder / name);
  };
  for (const bool other_first : {false, true}) {
    const std::string name = other_first ? "b" : "a";
    const BakeReport report = bake_both(
        name, other_first ? roof(urn, there) + roof("", here) : roof("", here) + roof(urn, there));
    EXPECT_EQ(report.city.objects.at("building"), 2u);
    EXPECT_EQ(report.crs.size(), 2u) << "both frames are told";
    ASSERT_EQ(report.city.read.warnings.size(), 1u);
    EXPECT_NE(report.city.read.warnings[0].find("1 objects name another CRS"), std::string::npos)
        << report.city.read.warnings[0];
    const Box box = boxes(folder / name / "city.glb").at("roof");
    // Degrees are written to 1e-6, which is 0.1 m; where the first geometry is in degrees the frame
    // is the program's own, and grid north another.
    EXPECT_NEAR(box.greatest.x - box.least.x, 10, other_first ? 0.4 : 0.15);
    EXPECT_NEAR(box.greatest.y - box.least.y, 10, other_first ? 0.4 : 0.15);
    EXPECT_NEAR(box.greatest.z - box.least.z, 30, 0.01);
  }
  try {
    bake_both("c", roof("", here) + roof("EPSG:1", there));
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("c.gml: high"), std::string::npos) << error.what();
  }
}

TEST(Bake, AFileWithoutACrsBesideOneWithIsRefusedByName) {
  const TempFolder folder;
  write_text(folder / "a.gml",
             roof_city("EPSG:25833",
                       {{391000, 5819000, 40}, {391010, 5819000, 40}, {391010, 5819010, 40}}));
  write_text(folder / "b.gml", roof_city("", {{0, 0, 40}, {10, 0, 40}, {10, 10, 40}}));
  try {
    bake(make_recipe({folder / "a.gml", folder / "b.gml"}), folder / "out");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("b.gml"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("crs"), std::string::npos) << error.what();
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

TEST(Bake, AModelWithoutACrsIsPlacedByTheBoundsItFills) {
  const TempFolder folder;
  // A square of 100 model units; 0.01 degrees of latitude are 1112.6 m at 52 north (WGS 84), and
  // longitude is chosen so that east to west is as long.
  write_text(folder / "a.gml",
             roof_city("", {{500, 500, 4}, {600, 500, 4}, {600, 600, 4}, {500, 600, 4}}));
  Recipe recipe = make_recipe({folder / "a.gml"});
  const double east = 13.4 + 0.01 * 1112.6 / 686.9;
  recipe.city.bounds = std::array{13.4, 52.0, east, 52.01};
  recipe.terrain.make_surface = false;
  bake(recipe, folder / "out");
  const georeference::CityFrame frame = georeference::CityFrame::from_srs_name(
      "", {}, {"none", {{{13.4, 52.0}, {500, 500}}, {{east, 52.01}, {600, 600}}}});
  const glm::dvec2 middle = frame.to_lon_lat({550, 550});
  EXPECT_NEAR(middle.x, (13.4 + east) / 2, 1e-5);
  EXPECT_NEAR(middle.y, 52.005, 1e-5);
  const Box roof = boxes(folder / "out/city.glb").at("roof");
  const auto [low, high] =
      std::pair(frame.from_lon_lat({13.4, 52.0}), frame.from_lon_lat({east, 52.01}));
  EXPECT_NEAR(roof.least.x, low.x, 0.01)
      << "what the map says of a corner falls on the model's corner";
  EXPECT_NEAR(roof.greatest.y, high.y, 0.01);
}

// Returns a cube of 10 m at (391000, 5819000, 35), one wall facing inward and without its ground
// surface.
std::string broken_cube() {
  std::string text = sample_gml();
  const std::string wall =
      "391000 5819000 35 391010 5819000 35 391010 5819000 45 391000 5819000 45 391000 5819000 35 ";
  const std::string turned =
      "391000 5819000 35 391000 5819000 45 391010 5819000 45 391010 5819000 35 391000 5819000 35 ";
  text.replace(text.find(wall), wall.size(), turned);
  const auto begin = text.find("<bldg:boundedBy><bldg:GroundSurface>"),
             end = text.find("<bldg:boundedBy><bldg:RoofSurface>");
  return text.erase(begin, end - begin);
}

TEST(Bake, ShellsAreClosedAndTurnedOutward) {
  const TempFolder folder;
  write_text(folder / "cube.gml", broken_cube());
  const BakeReport report = bake(make_recipe({folder / "cube.gml"}), folder / "out");
  EXPECT_EQ(report.city.mesh.floors_added, 1u);
  EXPECT_EQ(report.city.mesh.turned, 1u);
  EXPECT_EQ(report.city.mesh.first_turned, "cube");
  const std::string words = to_text(report);
  EXPECT_NE(words.find("1 faced inward"), std::string::npos) << words;
  EXPECT_NE(words.find("1 a floor added"), std::string::npos) << words;
  // Divergence theorem over what is in the file: the cube's volume, with a plus sign.
  const Scene scene = read_scene(folder / "out/city.glb");
  double volume = 0;
  for (const SceneNode& node : scene.nodes) {
    if (node.kind != "city") continue;
    for (const ScenePrimitive& primitive : scene.meshes[node.mesh].primitives)
      for (std::size_t i = 0; i < primitive.indices.size(); i += 3) {
        const auto corner = [&](std::size_t k) {
          return glm::dvec3(primitive.positions[primitive.indices[i + k]]);
        };
        volume += glm::dot(corner(0), glm::cross(corner(1), corner(2))) / 6;
      }
  }
  EXPECT_NEAR(volume, 1000, 0.1);
}

TEST(Bake, GroundUnderBuildingsIsLeftOutOnRequestOnly) {
  const TempFolder folder;
  write_text(folder / "cube.gml", sample_gml());
  Recipe recipe = make_recipe({folder / "cube.gml"});
  EXPECT_EQ(bake(recipe, folder / "out").tiles.triangles.at("ground"), 2u);
  recipe.city.drop_ground = true;
  const BakeReport report = bake(recipe, folder / "out");
  EXPECT_EQ(report.tiles.triangles.count("ground"), 0u);
  EXPECT_EQ(report.left_out().at("triangles of ground under buildings"), 2u);
  EXPECT_EQ(report.tiles.triangles.at("roof"), 2u);
}

/// Writes heights of the plan around the cube, as a raster in the city's CRS with one every 10 m.
template <class Height>
void write_heights(const std::filesystem::path& path, const Height& height) {
  GDALAllRegister();
  constexpr int size = 80;
  GDALDatasetUniquePtr set(GetGDALDriverManager()->GetDriverByName("GTiff")->Create(
      path.c_str(), size, size, 1, GDT_Float32, nullptr));
  double transform[6] = {390600, 10, 0, 5819400, 0, -10};
  set->SetGeoTransform(transform);
  OGRSpatialReference crs;
  crs.importFromEPSG(25833);
  set->SetSpatialRef(&crs);
  std::vector<float> values;
  for (int j = 0; j < size; ++j)
    for (int i = 0; i < size; ++i)
      values.push_back(static_cast<float>(height(-400 + (i + 0.5) * 10, 400 - (j + 0.5) * 10)));
  ASSERT_EQ(set->GetRasterBand(1)->RasterIO(GF_Write, 0, 0, size, size, values.data(), size, size,
                                            GDT_Float32, 0, 0),
            CE_None);
}

/// Writes heights 30 + (x - 391000) / 100.
void write_slope(const std::filesystem::path& path, double moved_by) {
  write_heights(path, [moved_by](double x, double) { return 30 + moved_by + x / 100; });
}

std::string without_relief(std::string text) {
  const auto begin = text.find("<core:cityObjectMember><dem:"),
             end = text.find("</core:CityModel>");
  return text.erase(begin, end - begin);
}

TEST(Bake, AnElevationModelIsTheGroundAndMeetsTheBuildings) {
  const TempFolder folder;
  write_text(folder / "cube.gml", without_relief(sample_gml()));
  write_slope(folder / "slope.tif", 46);  // heights over another datum
  Recipe recipe = make_recipe({folder / "cube.gml"});
  recipe.terrain.elevation_models = {folder / "slope.tif"};
  const BakeReport report = bake(recipe, folder / "out");
  EXPECT_EQ(report.ground.source, "dem");
  EXPECT_NE(report.ground.dem.find("moved by -41"), std::string::npos) << report.ground.dem;
  const Scene scene = read_scene(folder / "out/city.glb");
  std::size_t vertices = 0;
  for (const SceneNode& node : scene.nodes) {
    if (node.kind != "terrain") continue;
    for (const ScenePrimitive& primitive : scene.meshes[node.mesh].primitives)
      for (const glm::vec3& p : primitive.positions) {
        const glm::dvec3 place = scene.georeference.from_model(
            glm::dvec3(node.instances.at(0).to_model * glm::vec4(p, 1)));
        // The footprint lies at 35 m around x = 391005: the median of the differences is taken
        // there.
        const bool has_data = place.x <= 391400 && place.y <= 5819400;
        if (has_data) {
          EXPECT_NEAR(place.z, 35 + (place.x - 391005) / 100, 0.06);
        } else {
          // Beyond the model's ends the ground goes on level from the data next to it, to a rim of
          // points less than 100 m apart.
          EXPECT_NEAR(place.z, 35 + (std::min(place.x, 391400.0) - 391005) / 100, 0.5);
        }
        ++vertices;
      }
  }
  EXPECT_GT(vertices, 1000u);
}

// The corners of the terrain's triangles, in the city's CRS, three each.
std::vector<glm::dvec3> read_terrain(const std::filesystem::path& glb) {
  const Scene scene = read_scene(glb);
  std::vector<glm::dvec3> corners;
  for (const SceneNode& node : scene.nodes) {
    if (node.kind != "terrain") continue;
    for (const ScenePrimitive& primitive : scene.meshes[node.mesh].primitives)
      for (const std::uint32_t index : primitive.indices)
        corners.push_back(scene.georeference.from_model(
            glm::dvec3(node.instances.at(0).to_model * glm::vec4(primitive.positions[index], 1))));
  }
  return corners;
}

// A slope is a plane, but for bilinear heights' rounding: each tile becomes two triangles.
TEST(Bake, AThinnedSlopeHasTwoTrianglesATile) {
  const TempFolder folder;
  write_text(folder / "cube.gml", without_relief(sample_gml()));
  write_slope(folder / "slope.tif", 46);
  Recipe recipe = make_recipe({folder / "cube.gml"});
  recipe.terrain.elevation_models = {folder / "slope.tif"};
  recipe.terrain.max_error_m = 0.01;
  recipe.city.tile_m = 100;
  const BakeReport report = bake(recipe, folder / "out");
  EXPECT_NE(report.ground.dem.find("triangles fewer by max_error_m"), std::string::npos)
      << report.ground.dem;
  const std::vector<glm::dvec3> corners = read_terrain(folder / "out/city.glb");
  EXPECT_EQ(corners.size() % 6, 0u);
  EXPECT_LE(corners.size(), 6u * 9);
  for (const glm::dvec3& p : corners) EXPECT_NEAR(p.z, 35 + (p.x - 391005) / 100, 0.06);
}

// Hills, thinned, are within the error of the same hills unthinned. Where tiles meet, a vertex of
// one lies on the other's triangles.
TEST(Bake, ThinnedGroundIsWithinItsErrorAndTilesMeet) {
  const TempFolder folder;
  write_text(folder / "cube.gml", without_relief(sample_gml()));
  write_heights(folder / "hills.tif", [](double x, double y) {
    return 40 + 4 * std::sin(x / 30) + 3 * std::cos(y / 40);
  });
  Recipe recipe = make_recipe({folder / "cube.gml"});
  recipe.terrain.elevation_models = {folder / "hills.tif"};
  recipe.city.tile_m = 100;
  bake(recipe, folder / "whole");
  recipe.terrain.max_error_m = 0.5;
  bake(recipe, folder / "thin");
  const std::vector<glm::dvec3> whole = read_terrain(folder / "whole/city.glb"),
                                thin = read_terrain(folder / "thin/city.glb");
  EXPECT_LT(thin.size(), whole.size() / 2);
  const auto find_heights = [&thin](const glm::dvec3& p) {
    std::vector<double> heights;
    for (std::size_t n = 0; n < thin.size(); n += 3) {
      const glm::dvec3 &a = thin[n], &b = thin[n + 1], &c = thin[n + 2];
      const double all = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x),
                   u = ((p.x - a.x) * (c.y - a.y) - (p.y - a.y) * (c.x - a.x)) / all,
                   v = ((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x)) / all;
      if (u >= -1e-5 && v >= -1e-5 && u + v <= 1 + 1e-5)
        heights.push_back(a.z + u * (b.z - a.z) + v * (c.z - a.z));
    }
    return heights;
  };
  for (const glm::dvec3& p : whole) {
    const std::vector<double> heights = find_heights(p);
    EXPECT_FALSE(heights.empty());
    for (const double height : heights) ASSERT_NEAR(height, p.z, 0.5 + 0.01);
  }
  for (const glm::dvec3& p : thin)
    for (const double height : find_heights(p)) ASSERT_NEAR(height, p.z, 0.005);
}

// Returns a map of square buildings of 10 m whose south-western corners lie at these places of
// EPSG:25833.
std::string map_of_buildings(const std::vector<std::pair<glm::dvec2, std::string>>& buildings) {
  const glm::dvec3 somewhere(391000, 5819000, 0);
  const georeference::CityFrame frame =
      georeference::CityFrame::from_srs_name("EPSG:25833", {&somewhere, 1}, {});
  std::string nodes, ways;
  int id = 0;
  for (const auto& [corner, tags] : buildings) {
    ways += "<way id=\"" + std::to_string(1000 + id) + "\">";
    const int first = id + 1;
    for (const glm::dvec2 offset :
         {glm::dvec2(0, 0), glm::dvec2(10, 0), glm::dvec2(10, 10), glm::dvec2(0, 10)}) {
      const glm::dvec2 p = frame.to_lon_lat(corner + offset);
      char text[100];
      std::snprintf(text, sizeof text, "<node id=\"%d\" lat=\"%.9f\" lon=\"%.9f\"/>", ++id, p.y,
                    p.x);
      nodes += text;
      ways += "<nd ref=\"" + std::to_string(id) + "\"/>";
    }
    ways += "<nd ref=\"" + std::to_string(first) + "\"/><tag k=\"building\" v=\"yes\"/>" + tags +
            "</way>";
  }
  return "<osm version=\"0.6\">" + nodes + ways + "</osm>";
}

TEST(Bake, AMapsBuildingsStandOnTheLowestGroundBelowThem) {
  const TempFolder folder;
  write_slope(folder / "slope.tif", 46);
  const std::string height = "<tag k=\"height\" v=\"12\"/>";
  write_text(folder / "map.osm", map_of_buildings({{{391000, 5819000}, height},
                                                   {{391200, 5819000}, height},
                                                   {{391000, 5819100}, ""},
                                                   {{391600, 5819000}, height},
                                                   {{399000, 5819000}, height}}));
  Recipe recipe;
  recipe.windows.lit = false;
  recipe.osm.files = {folder / "map.osm"};
  recipe.terrain.elevation_models = {folder / "slope.tif"};
  const BakeReport report = bake(recipe, folder / "out");
  EXPECT_EQ(report.ground.source, "dem");
  EXPECT_NE(report.ground.dem.find("the map's buildings stand on it"), std::string::npos);
  EXPECT_EQ(report.left_out().at("where no elevation model has a height"), 1u);
  EXPECT_EQ(report.city.beyond_heights, 1u);
  EXPECT_EQ(report.city.read.assumed.at("height of a building that the map does not say"), 1u);
  EXPECT_TRUE(report.city.read.skipped.empty());
  const Box roof = boxes(folder / "out/city.glb").at("roof"),
            wall = boxes(folder / "out/city.glb").at("wall");
  // The slope is 76 m high at x = 391000 and rises by 1 m in 100.
  EXPECT_NEAR(wall.least.z, 76, 0.02);
  // The house beyond the model stands as high as the slope's end 200 m before it, 80 m, within what
  // a circle of twice the distance may be off; those on the slope end at 90 m at most.
  EXPECT_NEAR(roof.greatest.z, 80 + 12, 2);
  EXPECT_GT(roof.greatest.z, 90.02);
  EXPECT_NEAR(roof.least.z, 76 + 6, 0.02) << "two levels are assumed";
  const Scene scene = read_scene(folder / "out/city.glb");
  EXPECT_NEAR(scene.georeference.origin.z, 77, 2) << "the origin lies near the ground";
}

TEST(Bake, TheCitysOwnReliefGoesBeforeAnElevationModel) {
  const TempFolder folder;
  write_text(folder / "cube.gml", sample_gml());
  write_slope(folder / "slope.tif", 0);
  Recipe recipe = make_recipe({folder / "cube.gml"});
  recipe.terrain.elevation_models = {folder / "slope.tif"};
  const BakeReport report = bake(recipe, folder / "out");
  EXPECT_EQ(report.ground.source, "given");
  EXPECT_NE(report.ground.dem.find("not used"), std::string::npos);
}

// Writes the cube with its relief, and another one 1 km to the north without.
Recipe write_relief_of_a_part(const TempFolder& folder) {
  write_text(folder / "cube.gml", sample_gml());
  std::string far = without_relief(sample_gml());
  for (const auto& [from, to] :
       {std::pair<std::string, std::string>{" 5819", " 5820"}, {"gml:id=\"", "gml:id=\"far-"}})
    for (auto at = far.find(from); at != std::string::npos; at = far.find(from, at + to.size()))
      far.replace(at, from.size(), to);
  write_text(folder / "far.gml", far);
  return make_recipe({folder / "cube.gml", folder / "far.gml"});
}

// Returns the corners of the terrain within 100 m of the cube in the north.
std::vector<glm::dvec3> read_far_terrain(const std::filesystem::path& glb) {
  std::vector<glm::dvec3> corners = read_terrain(glb);
  std::erase_if(corners,
                [](const glm::dvec3& p) { return std::hypot(p.x - 391005, p.y - 5820005) > 100; });
  return corners;
}

TEST(Bake, TheGroundGoesOnBeyondTheReliefOfAPart) {
  const TempFolder folder;
  Recipe recipe = write_relief_of_a_part(folder);
  const BakeReport report = bake(recipe, folder / "out");
  EXPECT_EQ(report.ground.source, "given");
  EXPECT_NEAR(report.ground.beyond_relief_percent, 50, 1);
  const std::vector<glm::dvec3> corners = read_far_terrain(folder / "out/city.glb");
  EXPECT_GE(corners.size(), 4u);
  for (const glm::dvec3& p : corners) EXPECT_NEAR(p.z, 35, 0.01) << "the cube's foot";
  recipe.terrain.make_surface = false;
  bake(recipe, folder / "out");
  EXPECT_TRUE(read_far_terrain(folder / "out/city.glb").empty());
}

TEST(Bake, BeyondTheReliefOfAPartAnElevationModelIsTheGround) {
  const TempFolder folder;
  Recipe recipe = write_relief_of_a_part(folder);
  write_text(folder / "north.asc", [] {
    std::string text = "ncols 40\nnrows 40\nxllcorner 390800\nyllcorner 5819800\ncellsize 10\n";
    for (int row = 0; row < 40; ++row)
      for (int column = 0; column < 40; ++column)
        text += std::to_string(80 + column * 0.1) + (column < 39 ? " " : "\n");
    return text;
  }());
  recipe.terrain.elevation_models = {folder / "north.asc"};
  const BakeReport report = bake(recipe, folder / "out");
  EXPECT_EQ(report.ground.source, "given");
  EXPECT_NE(report.ground.dem.find("beyond the city's own relief, 1 models"), std::string::npos)
      << report.ground.dem;
  // The slope rises by 1 in 100 and is moved to the cube's foot, 35 m at x = 391005.
  const std::vector<glm::dvec3> corners = read_far_terrain(folder / "out/city.glb");
  EXPECT_GT(corners.size(), 300u);
  for (const glm::dvec3& p : corners) EXPECT_NEAR(p.z, 35 + (p.x - 391005) / 100, 0.06);
}

TEST(Bake, AnElevationModelOfAnotherPlaceIsAnError) {
  const TempFolder folder;
  std::string far = without_relief(sample_gml());
  for (auto at = far.find("5819"); at != std::string::npos; at = far.find("5819", at))
    far.replace(at, 4, "5829");
  write_text(folder / "cube.gml", far);
  write_slope(folder / "slope.tif", 0);
  Recipe recipe = make_recipe({folder / "cube.gml"});
  recipe.terrain.elevation_models = {folder / "slope.tif"};
  EXPECT_THROW(bake(recipe, folder / "out"), Error);
}

/// Returns the sample's cube on mass points, 49 of them, at one height.
std::string on_mass_points(const std::string& height) {
  std::string points;
  for (int x = -20; x <= 40; x += 10)
    for (int y = -20; y <= 40; y += 10)
      points += "<gml:pointMember><gml:Point><gml:pos>" + std::to_string(391000 + x) + " " +
                std::to_string(5819000 + y) + " " + height +
                "</gml:pos></gml:Point></gml:pointMember>";
  std::string text = without_relief(sample_gml());
  text.insert(
      text.find("</core:CityModel>"),
      "<core:cityObjectMember><dem:ReliefFeature "
      "gml:id=\"r\"><dem:lod>2</dem:lod><dem:reliefComponent>"
      "<dem:MassPointRelief gml:id=\"m\"><dem:lod>2</dem:lod><dem:reliefPoints><gml:MultiPoint>" +
          points +
          "</gml:MultiPoint></dem:reliefPoints></dem:MassPointRelief></dem:reliefComponent>"
          "</dem:ReliefFeature></core:cityObjectMember>");
  return text;
}

TEST(Bake, MassPointsOfTheModelBecomeItsGround) {
  const TempFolder folder;
  write_text(folder / "cube.gml", on_mass_points("33"));
  Recipe recipe = make_recipe({folder / "cube.gml"});
  recipe.ground.horizon = false;  // it falls below the points
  const BakeReport report = bake(recipe, folder / "out");
  EXPECT_EQ(report.ground.source, "points");
  EXPECT_EQ(report.ground.relief_points, 49u);
  const Box terrain = boxes(folder / "out/city.glb").at("terrain");
  EXPECT_NEAR(terrain.least.z, 33, 1e-3) << "not the buildings' feet, which stand at 35 m";
  EXPECT_NEAR(terrain.greatest.z, 33, 1e-3);
}

TEST(Bake, HiddenSurfacesAreLeftOutOnRequestOnly) {
  const TempFolder folder;
  write_text(folder / "cube.gml",
             on_mass_points("80"));  // the cube lies under the ground, all of it
  Recipe recipe = make_recipe({folder / "cube.gml"});
  EXPECT_EQ(bake(recipe, folder / "out").tiles.triangles.at("roof"), 2u);
  recipe.city.drop_hidden = true;
  const BakeReport report = bake(recipe, folder / "out");
  EXPECT_EQ(report.tiles.triangles.count("roof"), 0u);
  EXPECT_EQ(report.left_out().at("triangles of buildings below the ground"), 12u);
}

TEST(Bake, ColoursOfTheModelAreMaterialsOfTheScene) {
  const TempFolder folder;
  std::string text = sample_gml();
  const std::string first = "<gml:Polygon>";
  text.insert(text.find("<bldg:RoofSurface>") +
                  text.substr(text.find("<bldg:RoofSurface>")).find(first) + 12,
              " gml:id=\"red\"");
  text.replace(text.find("<core:CityModel "), 16,
               "<core:CityModel xmlns:app=\"http://www.opengis.net/citygml/appearance/2.0\" ");
  const std::string tail =
      "<app:appearanceMember><app:Appearance><app:surfaceDataMember><app:X3DMaterial><app:"
      "diffuseColor>0.5 "
      "0.25 0"
      "</app:diffuseColor><app:target>#red</app:target></app:X3DMaterial></app:surfaceDataMember></"
      "app:Appearance>"
      "</app:appearanceMember>";
  text.insert(text.find("</core:CityModel>"), tail);
  write_text(folder / "cube.gml", text);
  // The same gzipped: the appearance stands at the end of what must be unpacked to be seen.
  const gzFile packed = gzopen((folder / "cube.gml.gz").c_str(), "wb");
  ASSERT_EQ(gzwrite(packed, text.data(), static_cast<unsigned>(text.size())),
            static_cast<int>(text.size()));
  gzclose(packed);
  for (const char* name : {"cube.gml", "cube.gml.gz"}) {
    const BakeReport report = bake(make_recipe({folder / name}), folder / "out");
    EXPECT_EQ(report.tiles.colours, 1u) << name;
    const Scene scene = read_scene(folder / "out/city.glb");
    std::size_t found = 0;
    for (const SceneMesh& mesh : scene.meshes)
      for (const ScenePrimitive& primitive : mesh.primitives) {
        const SceneMaterial& material = scene.materials[primitive.material];
        if (!is_of_kind(material.name, "roof")) continue;
        EXPECT_EQ(material.name, "roof #804000") << name;
        ++found;
        EXPECT_EQ(primitive.indices.size(), 6u);
        // sRGB 0x80 is 0.2159 linear, 0x40 0.0513 (IEC 61966-2-1).
        EXPECT_NEAR(material.base_colour.x, 0.2159, 1e-3);
        EXPECT_NEAR(material.base_colour.y, 0.0513, 1e-3);
        EXPECT_EQ(material.base_colour.z, 0);
      }
    EXPECT_EQ(found, 1u) << name;
  }
}

// Two houses at a street with a lamp, in Berlin: 11 m by 11 m, 9 m high, one with a gable of 3 m.
std::string map_of_houses(const std::string& building) {
  const auto node = [](int id, double east, double north, const std::string& tags = "") {
    char text[120];
    std::snprintf(text, sizeof text, "<node id=\"%d\" lat=\"%.7f\" lon=\"%.7f\"", id,
                  52.5 + north * 0.0001, 13.4 + east * 0.0001 / 0.6088);
    return text + (tags.empty() ? std::string("/>") : ">" + tags + "</node>") + "\n";
  };
  const auto tag = [](const std::string& key, const std::string& value) {
    return "<tag k=\"" + key + "\" v=\"" + value + "\"/>";
  };
  std::string nodes, ways;
  for (int house = 0; house < 2; ++house) {
    const int id = 10 * house + 1;
    nodes += node(id, 2 * house, 1) + node(id + 1, 2 * house + 1, 1) +
             node(id + 2, 2 * house + 1, 2) + node(id + 3, 2 * house, 2);
    ways += "<way id=\"" + std::to_string(id) + "\">";
    for (const int k : {0, 1, 2, 3, 0}) ways += "<nd ref=\"" + std::to_string(id + k) + "\"/>";
    ways += tag(building, "yes") + tag("height", "9") +
            (house ? tag("roof:shape", "gabled") + tag("roof:height", "3") : "") + "</way>\n";
  }
  nodes += node(90, -1, 0) + node(91, 5, 0) + node(92, 2, 0.3, tag("highway", "street_lamp"));
  ways += "<way id=\"95\"><nd ref=\"90\"/><nd ref=\"91\"/>" + tag("highway", "residential") +
          "</way>\n";
  return "<osm version=\"0.6\">\n" + nodes + ways + "</osm>\n";
}

TEST(Bake, AMapAloneGivesItsBuildingsTheirWindowsAndLamps) {
  const TempFolder folder;
  write_text(folder / "map.osm", map_of_houses("building"));
  Recipe recipe;
  recipe.osm.files = {folder / "map.osm"};
  const BakeReport report = bake(recipe, folder / "out");
  EXPECT_EQ(report.city.objects.at("building"), 2u);
  EXPECT_EQ(report.city.mesh.open_objects, 0u);
  ASSERT_EQ(report.city.read.warnings.size(), 1u) << "that they are the map's";
  EXPECT_GT(report.lights.lamps.placed, 0u);
  EXPECT_GT(report.lights.windows.placed, 0u);
  const auto box = boxes(folder / "out/city.glb");
  EXPECT_NEAR(box.at("roof").greatest.z, 9, 0.01);
  EXPECT_NEAR(box.at("wall").least.z, 0, 0.01);
  EXPECT_NEAR(box.at("roof").greatest.x - box.at("roof").least.x, 3 * 11.13, 0.1);
  EXPECT_NEAR(box.at("roof").greatest.y - box.at("roof").least.y, 11.13, 0.1);
  const Scene scene = read_scene(folder / "out/city.glb");
  EXPECT_EQ(scene.georeference.sources, std::vector<std::string>{"map.osm"});
  EXPECT_EQ(scene.georeference.licences, std::vector<std::string>{recipe.osm.licence});

  recipe.osm.buildings = false;
  EXPECT_THROW(bake(recipe, folder / "out"), UsageError);
  recipe.osm.buildings = true;
  recipe.terrain.elevation_models = {folder / "heights.tif"};
  EXPECT_THROW(bake(recipe, folder / "out"), Error) << "the model is asked for: it is not there";
  // Heights in a file that says neither where nor in which CRS they are.
  write_text(folder / "heights.asc",
             "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 10\n30 30\n30 30\n");
  recipe.terrain.elevation_models = {folder / "heights.asc"};
  try {
    bake(recipe, folder / "out");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("heights.asc: names no CRS"), std::string::npos)
        << error.what();
    EXPECT_NE(std::string(error.what()).find("gdal_edit.py -a_srs"), std::string::npos);
  }
  recipe.terrain.elevation_models.clear();
  write_text(folder / "map.osm", map_of_houses("leisure"));
  try {
    bake(recipe, folder / "out");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("the map has no building"), std::string::npos)
        << error.what();
  }
}

// Two rasters over the same two houses: one height every 100 m, and one every 10 m.
TEST(Bake, TheFinestElevationModelDecides) {
  const TempFolder folder;
  write_text(folder / "map.osm", map_of_houses("building"));
  const auto write = [&](const char* name, double step_degrees, int cells, int height) {
    std::string text = "ncols " + std::to_string(cells) + "\nnrows " + std::to_string(cells) +
                       "\nxllcorner 13.39\nyllcorner 52.49\ncellsize " +
                       std::to_string(step_degrees) + "\n";
    for (int i = 0; i < cells * cells; ++i) text += std::to_string(height) + " ";
    write_text(folder / name, text);
  };
  write("a_coarse.asc", 0.001, 20, 40);
  write("b_fine.asc", 0.0001, 200, 42);
  write("c_like_fine.asc", 0.00011, 190, 45);
  const auto find_ground = [&](const char* first, const char* second) {
    Recipe recipe;
    recipe.osm.files = {folder / "map.osm"};
    recipe.terrain.elevation_crs = "EPSG:4326";
    recipe.terrain.elevation_models = {folder / first, folder / second};
    bake(recipe, folder / "out");
    return boxes(folder / "out/city.glb").at("roof").greatest.z - 9;
  };
  EXPECT_NEAR(find_ground("a_coarse.asc", "b_fine.asc"), 42, 0.01);
  EXPECT_NEAR(find_ground("b_fine.asc", "a_coarse.asc"), 42, 0.01);
  EXPECT_NEAR(find_ground("c_like_fine.asc", "b_fine.asc"), 45, 0.01) << "about equally fine";
}

TEST(Bake, TheReportSaysWhatOfTheMapIsGone) {
  const TempFolder folder;
  std::string map = map_of_houses("building");
  const std::string end = "</osm>";
  map.replace(map.rfind(end), end.size(),
              "<way id=\"900\"><nd ref=\"1\"/><nd ref=\"2\"/><tag k=\"highway\" "
              "v=\"residential\"/><tag k=\"end_date\" v=\"2010\"/></way></osm>");
  write_text(folder / "map.osm", map);
  Recipe recipe;
  recipe.osm.files = {folder / "map.osm"};
  const BakeReport report = bake(recipe, folder / "out");
  EXPECT_EQ(to_json(report)["map"]["skipped"]["gone or not built yet"], 1u);
}

// A lamp is dimmed and aimed at the sky, and a window goes off for good: theirs are the only values
// that change, and the file says that a hand changed them.
TEST(Bake, EditsOfLightsAreBakedIn) {
  const TempFolder folder;
  write_text(folder / "map.osm", map_of_houses("building"));
  Recipe recipe;
  recipe.osm.files = {folder / "map.osm"};
  bake(recipe, folder / "plain");
  const LightFile plain = LightFile::open(folder / "plain/city.lights");
  std::size_t lamp = plain.lights().size(), window = lamp;
  for (std::size_t i = 0; i < plain.lights().size(); ++i)
    (light_kind(plain.lights()[i]) == LightKind::sphere ? lamp : window) = i;
  ASSERT_LT(std::max(lamp, window), plain.lights().size());

  LightEdits edits;
  edits[plain.lights()[lamp].id].flux_lm = 777;
  edits[plain.lights()[lamp].id].aim = glm::vec3(0, 0, 1);
  edits[plain.lights()[window].id].is_off = true;
  edits[0x7fffffff].is_off = true;  // there is none
  write_light_edits(folder / "city.edits.json", edits);
  recipe.lights.edits = {folder / "city.edits.json"};
  const BakeReport report = bake(recipe, folder / "edited");
  EXPECT_EQ(report.lights.lamps.notes.at("lights changed by edits"), 2u);
  EXPECT_EQ(report.lights.lamps.notes.at("edits of lights that are not there"), 1u);
  const LightFile edited = LightFile::open(folder / "edited/city.lights");
  ASSERT_EQ(edited.lights().size(), plain.lights().size());
  for (std::size_t i = 0; i < plain.lights().size(); ++i) {
    const Light &a = plain.lights()[i], &b = edited.lights()[i];
    EXPECT_EQ(b.id, a.id);
    EXPECT_EQ(b.flux_lm, i == lamp ? 777 : a.flux_lm);
    EXPECT_EQ(b.axis, i == lamp ? glm::vec3(0, 1, 0) : a.axis);
    EXPECT_EQ(edited.provenance()[i].flux == ValueSource::edit, i == lamp);
    EXPECT_EQ(edited.provenance()[i].schedule == ValueSource::edit, i == window);
  }
  const Schedule& never = edited.schedules()[edited.lights()[window].schedule];
  EXPECT_EQ(never.count, 0u);
  recipe.lights.edits = {folder / "missing.json"};
  EXPECT_THROW(bake(recipe, folder / "edited"), Error);
}

// The rest of the file is the same, and what a hierarchy says of itself is true.
TEST(Bake, HierarchiesOfAllThatStandsStillAreStoredUnlessARecipeSaysNo) {
  const TempFolder folder;
  write_text(folder / "city.gml", sample_gml());
  Recipe recipe = make_recipe({folder / "city.gml"});
  recipe.ground.horizon = false;  // it is an instance of its own
  const BakeReport with = bake(recipe, folder / "with");
  recipe.output.hierarchies = false;
  const BakeReport without = bake(recipe, folder / "without");
  EXPECT_EQ(without.hierarchies.triangles, 0u);
  EXPECT_EQ(with.hierarchies.triangles, with.scene.triangles) << "no node has instances";
  EXPECT_GT(with.hierarchies.nodes, with.hierarchies.triangles / 16);
  EXPECT_TRUE(SceneFile(folder / "without/city.glb").hierarchies().empty());
  const SceneFile file(folder / "with/city.glb");
  ASSERT_EQ(file.hierarchies().size(), 1u);
  const StoredHierarchy& stored = file.hierarchies()[0];
  EXPECT_EQ(stored.triangles, with.hierarchies.triangles);
  EXPECT_EQ(stored.topology.size() + stored.order.size() + stored.cuts.size(),
            with.hierarchies.bytes);
  const Scene scene = read_scene(folder / "with/city.glb"),
              bare = read_scene(folder / "without/city.glb");
  EXPECT_EQ(scene.skipped, bare.skipped);
  ASSERT_EQ(scene.meshes.size(), bare.meshes.size());
  glm::vec3 lower(1e30f), upper(-1e30f);
  for (const SceneNode& node : scene.nodes)
    for (std::size_t i = 0; i < scene.meshes[node.mesh].primitives.size(); ++i) {
      const ScenePrimitive& primitive = scene.meshes[node.mesh].primitives[i];
      EXPECT_EQ(primitive.indices, bare.meshes[node.mesh].primitives[i].indices);
      EXPECT_EQ(primitive.positions, bare.meshes[node.mesh].primitives[i].positions);
      for (const glm::vec3& p : primitive.positions) {
        const glm::vec3 place(to_double(node.instances[0]) * glm::dvec4(p, 1));
        lower = glm::min(lower, place);
        upper = glm::max(upper, place);
      }
    }
  EXPECT_EQ(stored.lower, lower);
  EXPECT_EQ(stored.upper, upper);
}

TEST(Bake, TheReportCountsTheFilesOfAnArchiveThatAreNotRead) {
  const TempFolder folder;
  test::pack_zip(folder / "all.zip",
                 {{"a.gml", test::sample_gml()}, {"a.pdf", "%PDF"}, {"b.pdf", "%PDF"}});
  const BakeReport report = bake(make_recipe({folder / "all.zip"}), folder / "out");
  const auto written = nlohmann::json::parse(read_text(folder / "out" / "bake_report.json"));
  EXPECT_EQ(written["citygml"]["passed_over"], nlohmann::json({{".pdf", 2}}));
  EXPECT_NE(to_text(report).find("passed over files in archives: 2 .pdf"), std::string::npos);
}

TEST(Bake, OneThreadAndManyGiveTheSameBytes) {
  REAL_DATA(first, "berlin/3910_5820.gml");
  REAL_DATA(second, "berlin/3900_5820.gml");
  REAL_DATA(map, "berlin/berlin_dev_box.osm.pbf");
  const TempFolder folder;
  std::map<std::string, std::string> bytes;
  for (const unsigned threads : {1u, 2u, 7u, 7u}) {
    Recipe recipe = make_recipe({first, second});
    recipe.osm.files = {map};
    recipe.windows.lit = true;
    recipe.city.read.threads = threads;
    bake(recipe, folder / "out");
    for (const char* name : {"city.glb", "city.lights"}) {
      const std::string now = read_text(folder / "out" / name);
      std::string& before = bytes[name];
      EXPECT_TRUE(before.empty() || before == now) << name << " with " << threads << " threads";
      before = now;
    }
  }
}

}  // namespace
}  // namespace nightcity::bake
