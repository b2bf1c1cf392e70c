// Exports of a small baked city, read back by other means than those that wrote them.
#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <ogrsf_frmts.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <nlohmann/json.hpp>
#include <set>

#include "formats/error.h"
#include "formats/scene_reader.h"
#include "support/temp_folder.h"
#include "tools/bake/bake.h"
#include "tools/exports/ies_text.h"
#include "tools/exports/light_layer.h"
#include "tools/exports/light_texts.h"
#include "tools/exports/place_on_earth.h"
#include "tools/exports/tileset.h"
#include "tools/gdal/guarded_gdal.h"
#include "tools/lights/luminaire.h"
#include "tools/nightbake/sample_city.h"

namespace nightcity::exports {
namespace {

using namespace test;
using nlohmann::json;

const char* map =
    "<osm version=\"0.6\"><node id=\"1\" lat=\"52.510075\" lon=\"13.393876\"/>"
    "<node id=\"2\" lat=\"52.510487\" lon=\"13.394451\"/><node id=\"3\" lat=\"52.510124\" "
    "lon=\"13.394169\"><tag k=\"highway\" v=\"street_lamp\"/><tag k=\"light:lumens\" v=\"4000\"/>"
    "<tag k=\"lit\" v=\"17:30-23:00\"/></node><way id=\"1\"><nd ref=\"1\"/><nd ref=\"2\"/>"
    "<tag k=\"highway\" v=\"residential\"/></way></osm>";

// A cube with windows, its ground and lamps.
void bake_city(const TempFolder& folder) {
  write_text(folder / "cube.gml", sample_gml());
  write_text(folder / "map.osm", map);
  bake::Recipe recipe;
  recipe.city.files = {folder / "cube.gml"};
  recipe.osm.files = {folder / "map.osm"};
  bake::bake(recipe, folder / "out");
}

TEST(Exports, EachLightIsARowWithItsPlaceAndProvenance) {
  const TempFolder folder;
  bake_city(folder);
  const LightFile file = LightFile::open(folder / "out/city.lights");
  ASSERT_GT(file.lights().size(), 0u);
  for (const char* name : {"l.gpkg", "l.fgb", "L.FGB"}) {
    EXPECT_EQ(write_light_layer(file, folder / name), file.lights().size());
    EXPECT_TRUE(std::filesystem::is_regular_file(folder / name)) << name;
    GDALDatasetUniquePtr set(GDALDataset::Open((folder / name).c_str(), GDAL_OF_VECTOR));
    ASSERT_TRUE(set);
    OGRLayer* layer = set->GetLayer(0);
    EXPECT_STREQ(layer->GetSpatialRef()->GetAuthorityCode(nullptr), "25833");
    std::set<GIntBig> seen;
    for (OGRFeatureUniquePtr row; (row = OGRFeatureUniquePtr(layer->GetNextFeature()));) {
      const auto number = static_cast<std::size_t>(row->GetFieldAsInteger64("light"));
      ASSERT_LT(number, file.lights().size());
      EXPECT_TRUE(seen.insert(row->GetFieldAsInteger64("light")).second);
      const Light& light = file.lights()[number];
      EXPECT_FLOAT_EQ(static_cast<float>(row->GetFieldAsDouble("flux_lm")), light.flux_lm);
      EXPECT_STREQ(row->GetFieldAsString("flux_from"), name_of(file.provenance()[number].flux));
      const OGRPoint& point = *row->GetGeometryRef()->toPoint();
      const glm::dvec3 place = file.georeference().from_model(glm::dvec3(light.position));
      EXPECT_NEAR(glm::distance(place, glm::dvec3(point.getX(), point.getY(), point.getZ())), 0,
                  1e-6);
      EXPECT_NEAR(place.x, 391005, 100);
    }
    EXPECT_EQ(seen.size(), file.lights().size());
  }
  EXPECT_THROW(write_light_layer(file, folder / "l.shp"), Error);
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    EXPECT_EQ(entry.path().filename().string().find(".part"), std::string::npos) << entry.path();
}

TEST(Exports, HoursAreTheNightsOwn) {
  const TempFolder folder;
  bake_city(folder);
  const LightFile file = LightFile::open(folder / "out/city.lights");
  bool found = false;
  for (std::size_t i = 0; i < file.lights().size(); ++i)
    if (file.provenance()[i].source_id == 3) {
      EXPECT_EQ(describe_hours(file, file.lights()[i]), "17:30-23:00");
      found = true;
    }
  EXPECT_TRUE(found);
}

TEST(Exports, PlacesOnTheEarthAreWhereGeodesyPutsThem) {
  // The axes of the ellipsoid are known at the equator and at the pole.
  EXPECT_NEAR(glm::distance(to_ecef({0, 0}, 0), glm::dvec3(6378137, 0, 0)), 0, 1e-6);
  EXPECT_NEAR(glm::distance(to_ecef({90, 0}, 10), glm::dvec3(0, 6378147, 0)), 0, 1e-6);
  EXPECT_NEAR(glm::distance(to_ecef({7, 90}, 0), glm::dvec3(0, 0, 6356752.314245)), 0, 1e-5);
  const glm::dvec3 place(391000, 5819000, 40);
  const PlaceOnEarth earth("EPSG:25833", place, 39.5);
  const auto m = earth.make_transform(place);
  const auto apply = [&](const glm::dvec3& p) {
    return glm::dvec3(m[0] * p.x + m[4] * p.y + m[8] * p.z + m[12],
                      m[1] * p.x + m[5] * p.y + m[9] * p.z + m[13],
                      m[2] * p.x + m[6] * p.y + m[10] * p.z + m[14]);
  };
  for (const glm::dvec3 offset :
       {glm::dvec3(0), glm::dvec3(200, 100, 30), glm::dvec3(-250, 250, 0)}) {
    const glm::dvec3 there = place + offset;
    const glm::dvec3 truth = to_ecef(earth.to_lon_lat(glm::dvec2(there)), there.z + 39.5);
    EXPECT_NEAR(glm::distance(apply(offset), truth), 0, 0.02) << "curvature: 1 cm over 350 m";
  }
  EXPECT_THROW(PlaceOnEarth("", place, 0), Error);
}

// Our own reader of luminaire files finds the profile in the text, C turned round (light.h), and
// nothing beyond the last angle.
TEST(Exports, ALuminaireFileHoldsTheProfile) {
  const TempFolder folder;
  for (const auto& [planes, extent] :
       {std::pair(1u, 90.0f), {1u, 60.0f}, {6u, 120.0f}, {4u, 180.0f}}) {
    constexpr std::uint32_t rows = 13;
    const LightProfile profile{planes, rows, 2, extent};
    std::vector<float> data{-1, -1};
    for (std::uint32_t c = 0; c < planes; ++c)
      for (std::uint32_t g = 0; g < rows; ++g)
        data.push_back(0.1f + 0.01f * float(c * c) + 0.02f * float(g));
    write_text(folder / "lamp.ies", to_ies_text(profile, data));
    const lights::Luminaire read = lights::read_ies(folder / "lamp.ies");
    EXPECT_TRUE(read.notes.empty());
    for (std::uint32_t c = 0; c < planes; ++c)
      for (std::uint32_t g = 0; g < rows; ++g)
        EXPECT_NEAR(lights::intensity_at(read.grid, 360.0 * (planes - c) / planes,
                                         double(extent) * g / (rows - 1)),
                    1000 * double(data[2 + c * rows + g]), 1e-3)
            << planes << " planes, " << c << ", " << g;
    if (extent < 180) {
      EXPECT_EQ(lights::intensity_at(read.grid, 0, double(extent) + 0.01), 0);
    }
  }
}

TEST(Exports, LampsHaveTheirProfileOnRequest) {
  const TempFolder folder;
  bake_city(folder);
  const Scene scene = read_scene(folder / "out/city.glb");
  const LightFile lights = LightFile::open(folder / "out/city.lights");
  TilesetOptions options;
  options.lamps = LampForm::ies;
  const TilesetReport report = write_tileset(scene, &lights, folder / "tiles", options);
  std::size_t found = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "tiles/tiles")) {
    const std::string glb = read_text(entry.path());
    std::uint32_t length = 0;
    std::memcpy(&length, glb.data() + 12, sizeof length);
    const json root = json::parse(glb.substr(20, length));
    for (const json& node : root["nodes"]) {
      if (!node.contains("extensions") || !node["extensions"].contains("EXT_lights_ies")) continue;
      ++found;
      const json& light = node["extensions"]["EXT_lights_ies"];
      const json& profile =
          root["extensions"]["EXT_lights_ies"]["lights"][light["light"].get<std::size_t>()];
      EXPECT_EQ(profile["mimeType"], "application/x-ies-lm-63");
      EXPECT_GT(light["multiplier"].get<double>(), 0);
      // The lamp looks down: -z of its node is -y of the tile.
      const auto q = node["rotation"].get<std::vector<double>>();
      EXPECT_NEAR(2 * (q[1] * q[2] - q[3] * q[0]), 1, 0.1);
    }
  }
  EXPECT_EQ(found, report.lights);
}

TEST(Exports, TilesHoldEveryTriangleFeatureAndLamp) {
  const TempFolder folder;
  bake_city(folder);
  const Scene scene = read_scene(folder / "out/city.glb");
  const LightFile lights = LightFile::open(folder / "out/city.lights");
  TilesetOptions options;
  options.cell_m = 40;
  const TilesetReport report = write_tileset(scene, &lights, folder / "tiles", options);
  // A globe has a ground beyond the city of its own.
  std::size_t triangles = 0, horizons = 0;
  for (const SceneNode& node : scene.nodes) {
    if (node.kind == "horizon") {
      ++horizons;
      continue;
    }
    for (const ScenePrimitive& primitive : scene.meshes[node.mesh].primitives)
      triangles += node.instances.size() * primitive.indices.size() / 3;
  }
  EXPECT_EQ(horizons, 1u);
  const json tileset = json::parse(read_text(folder / "tiles/tileset.json"));
  EXPECT_EQ(tileset["asset"]["version"], "1.1");
  std::size_t tiles = 0, found = 0;
  std::set<std::string> ids, types;
  bool any_provenance = false;
  const std::function<void(const json&, const json&)> visit = [&](const json& tile,
                                                                  const json& parent) {
    const auto region = tile["boundingVolume"]["region"].get<std::vector<double>>();
    ASSERT_EQ(region.size(), 6u);
    const auto around = parent["boundingVolume"]["region"].get<std::vector<double>>();
    EXPECT_LE(around[0], region[0]);
    EXPECT_GE(around[3], region[3]);
    EXPECT_LE(tile["geometricError"].get<double>(), parent["geometricError"].get<double>());
    if (tile.contains("children"))
      for (const json& child : tile["children"]) visit(child, tile);
    if (!tile.contains("content")) return;
    ++tiles;
    ASSERT_EQ(tile["transform"].size(), 16u);
    const Scene part = read_scene(folder / "tiles" / tile["content"]["uri"].get<std::string>());
    for (const SceneNode& node : part.nodes)
      for (const ScenePrimitive& primitive : part.meshes[node.mesh].primitives) {
        found += node.instances.size() * primitive.indices.size() / 3;
        for (const glm::vec3& p : primitive.positions)
          EXPECT_LT(std::abs(p.x) + std::abs(p.z), 2000) << "near the tile's own origin";
      }
    for (const SceneFeature& feature : part.features) {
      ids.insert(feature.id);
      types.insert(feature.type);
      any_provenance = any_provenance || feature.provenance.find("flux tag") != std::string::npos;
    }
  };
  visit(tileset["root"], tileset["root"]);
  EXPECT_EQ(tiles, report.tiles);
  EXPECT_GT(tiles, 1u);
  EXPECT_EQ(found, triangles) << "none is lost, none comes twice";
  for (const SceneFeature& feature : scene.features) EXPECT_TRUE(ids.contains(feature.id));
  EXPECT_TRUE(types.contains("lamp"));
  EXPECT_TRUE(any_provenance);
  EXPECT_GT(report.lights, 0u);
  EXPECT_THROW(write_tileset(scene, &lights, folder / "tiles", options), UsageError);
}

}  // namespace
}  // namespace nightcity::exports
