// The ground cover of real places against polygon overlays of GEOS, which shares no code with it.
#include <geos_c.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "formats/scene_reader.h"
#include "support/data.h"
#include "support/temp_folder.h"
#include "tools/bake/bake.h"
#include "tools/bake/city/city.h"
#include "tools/bake/scene/ground_facets.h"

namespace nightcity::bake {
namespace {

using ground_cover::Cover;
using ground_cover::CoverArea;

class Overlay {
 public:
  Overlay() : geos_(GEOS_init_r()) {}
  ~Overlay() { GEOS_finish_r(geos_); }

  // Returns the area of each material within the rectangle, m2: of each rank what no greater rank
  // covers. Areas of a rank that overlap have to be of one material.
  std::map<std::string, double> find_areas(const Cover& cover, const terrain::Extent& bounds) {
    GEOSGeometry* window =
        GEOSGeom_createRectangle_r(geos_, bounds.low.x, bounds.low.y, bounds.high.x, bounds.high.y);
    std::map<std::string, double> result;
    GEOSGeometry* above = GEOSGeom_createEmptyPolygon_r(geos_);
    const std::vector<CoverArea>& areas = cover.areas();
    for (std::size_t begin = 0; begin < areas.size();) {
      std::size_t end = begin;
      std::vector<GEOSGeometry*> parts;
      for (; end < areas.size() && areas[end].rank == areas[begin].rank &&
             areas[end].surface == areas[begin].surface;
           ++end)
        parts.push_back(to_polygon(areas[end]));
      GEOSGeometry* all = take(GEOSGeom_createCollection_r(
          geos_, GEOS_GEOMETRYCOLLECTION, parts.data(), static_cast<unsigned>(parts.size())));
      GEOSGeometry* inside = GEOSIntersection_r(geos_, all, window);
      GEOSGeometry* seen = GEOSDifference_r(geos_, inside, above);
      double m2 = 0;
      GEOSArea_r(geos_, seen, &m2);
      result[ground_cover::find_material(areas[begin].surface.kind).name] += m2;
      GEOSGeometry* more = GEOSUnion_r(geos_, above, inside);
      for (GEOSGeometry* done : {all, inside, seen, above}) GEOSGeom_destroy_r(geos_, done);
      above = more;
      begin = end;
    }
    GEOSGeom_destroy_r(geos_, above);
    GEOSGeom_destroy_r(geos_, window);
    return result;
  }

 private:
  GEOSGeometry* take(GEOSGeometry* collection) {
    GEOSGeometry* merged = GEOSUnaryUnion_r(geos_, collection);
    GEOSGeom_destroy_r(geos_, collection);
    return merged;
  }
  GEOSGeometry* to_ring(const std::vector<glm::dvec2>& ring) {
    std::vector<double> xy;
    for (const glm::dvec2& p : ring) xy.insert(xy.end(), {p.x, p.y});
    xy.insert(xy.end(), {ring[0].x, ring[0].y});
    return GEOSGeom_createLinearRing_r(
        geos_, GEOSCoordSeq_copyFromBuffer_r(geos_, xy.data(), static_cast<unsigned>(xy.size() / 2),
                                             0, 0));
  }
  // Rings by parity.
  GEOSGeometry* to_polygon(const CoverArea& area) {
    GEOSGeometry* result = GEOSGeom_createEmptyPolygon_r(geos_);
    for (const auto& ring : area.rings) {
      GEOSGeometry* raw = GEOSGeom_createPolygon_r(geos_, to_ring(ring), nullptr, 0);
      GEOSGeometry* valid = GEOSMakeValid_r(geos_, raw);
      GEOSGeometry* next = GEOSSymDifference_r(geos_, result, valid);
      for (GEOSGeometry* done : {raw, valid, result}) GEOSGeom_destroy_r(geos_, done);
      result = next;
    }
    return result;
  }

  GEOSContextHandle_t geos_;
};

// Lamps and wheels stand on what is drawn. Of the random places a few may lie within a millimetre
// of a kerb.
void expect_ground_as_drawn(const City& city, const Scene& scene, const terrain::Extent& bounds) {
  const test::TempFolder folder;
  terrain::Terrain drawn(folder / "drawn");
  for (const SceneNode& node : scene.nodes) {
    if (node.kind != "terrain") continue;
    for (const ScenePrimitive& primitive : scene.meshes[node.mesh].primitives) {
      mesh::TriangleMesh mesh;
      for (const glm::vec3& p : primitive.positions)
        mesh.positions.push_back(scene.georeference.from_model(
            glm::dvec3(node.instances.at(0).to_model * glm::vec4(p, 1))));
      for (std::size_t i = 0; i < primitive.indices.size(); i += 3)
        mesh.triangles.push_back(
            {{primitive.indices[i], primitive.indices[i + 1], primitive.indices[i + 2]},
             city::SurfaceType::terrain,
             0});
      drawn.add(mesh, terrain::SurfaceClass::terrain);
    }
  }
  drawn.build(1);
  const place::HeightAt height_at = city.height_at();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0, 1);
  int differing = 0, sunken = 0;
  constexpr int places = 5000;
  for (int n = 0; n < places; ++n) {
    const glm::dvec2 p =
        bounds.low + (bounds.high - bounds.low) * glm::dvec2(share(random), share(random));
    const auto said = height_at(p);
    const auto seen = drawn.height_of(terrain::SurfaceClass::terrain, p);
    if (!said) continue;
    ASSERT_TRUE(seen);
    differing += std::abs(*said - *seen) > 2 * facet_tolerance_m;
    sunken += city.cover().depth_at(p) > 0;
  }
  EXPECT_LE(differing, 5);
  EXPECT_GT(sunken, 50);
}

// Bakes a place and compares the area of each kind of surface with the overlay's.
void expect_areas_of_overlay(const Recipe& recipe, double tolerance) {
  const test::TempFolder folder;
  BakeOptions options = make_bake_options(recipe);
  const BakeReport report = bake(options, folder / "out");
  City city(options.city, folder / "city");
  city.read({}, {});
  city.build_ground();
  ASSERT_TRUE(city.terrain().extent());
  Overlay overlay;
  std::map<std::string, double> expected =
      overlay.find_areas(city.cover(), *city.terrain().extent());
  std::map<std::string, double> shown = report.tiles.cover_m2;
  double whole = report.tiles.bare_m2;
  for (const auto& [name, m2] : shown) whole += m2;
  // Paint lies on carriageways, nearly all of which are asphalt.
  shown["asphalt"] += shown["road marking"];
  for (const auto& [name, m2] : expected) EXPECT_NEAR(shown[name], m2, tolerance * m2 + 3) << name;
  const glm::dvec2 extent = city.terrain().extent()->high - city.terrain().extent()->low;
  EXPECT_LE(whole, extent.x * extent.y * (1 + 1e-6));
  EXPECT_EQ(report.tiles.uncovered_tiles, 0u);
  expect_ground_as_drawn(city, read_scene(folder / "out/city.glb"), *city.terrain().extent());
}

TEST(CoverReal, BerlinsSurfacesHaveTheAreasOfTheMap) {
  REAL_DATA(city, "berlin/3910_5819.gml");
  REAL_DATA(map, "berlin/berlin_dev_box.osm.pbf");
  Recipe recipe;
  recipe.city.files = {city};
  recipe.osm.files = {map};
  expect_areas_of_overlay(recipe, 0.01);
}

TEST(CoverReal, SoHasAMapThatIsItsOwnModel) {
  REAL_DATA(map, "osm/northgate.osm");
  Recipe recipe;
  recipe.osm.files = {map};
  expect_areas_of_overlay(recipe, 0.01);
}

}  // namespace
}  // namespace nightcity::bake
