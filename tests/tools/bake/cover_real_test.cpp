// The ground cover of real places against polygon overlays of GEOS, which shares no code with it.
#include <geos_c.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <glm/common.hpp>
#include <map>
#include <random>
#include <string>
#include <utility>
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
    std::vector<GEOSGeometry*> polygons;
    std::vector<ground_cover::Box> boxes;
    for (const CoverArea& area : cover.areas()) {
      polygons.push_back(to_polygon(area));
      boxes.push_back(ground_cover::find_box(area.rings));
    }
    std::map<std::string, double> result;
    // Square by square: an overlay takes more than twice as long for twice as many areas.
    constexpr double side_m = 200;
    for (double x = bounds.low.x; x < bounds.high.x; x += side_m)
      for (double y = bounds.low.y; y < bounds.high.y; y += side_m) {
        const ground_cover::Box square{
            {x, y}, {std::min(x + side_m, bounds.high.x), std::min(y + side_m, bounds.high.y)}};
        std::vector<std::size_t> here;
        for (std::size_t i = 0; i < boxes.size(); ++i)
          if (boxes[i].low.x < square.high.x && boxes[i].high.x > square.low.x &&
              boxes[i].low.y < square.high.y && boxes[i].high.y > square.low.y)
            here.push_back(i);
        add_areas(cover.areas(), polygons, here, square, result);
      }
    for (GEOSGeometry* polygon : polygons) GEOSGeom_destroy_r(geos_, polygon);
    return result;
  }

 private:
  // Adds the areas of those of the numbers `here` within a square.
  void add_areas(const std::vector<CoverArea>& areas, const std::vector<GEOSGeometry*>& polygons,
                 const std::vector<std::size_t>& here, const ground_cover::Box& square,
                 std::map<std::string, double>& result) {
    GEOSGeometry* window =
        GEOSGeom_createRectangle_r(geos_, square.low.x, square.low.y, square.high.x, square.high.y);
    GEOSGeometry* above = GEOSGeom_createEmptyPolygon_r(geos_);
    for (std::size_t begin = 0; begin < here.size();) {
      const CoverArea& first = areas[here[begin]];
      std::size_t end = begin;
      std::vector<GEOSGeometry*> parts;
      for (; end < here.size() && areas[here[end]].rank == first.rank &&
             areas[here[end]].surface == first.surface;
           ++end)
        parts.push_back(GEOSIntersection_r(geos_, polygons[here[end]], window));
      GEOSGeometry* inside = take(GEOSGeom_createCollection_r(
          geos_, GEOS_GEOMETRYCOLLECTION, parts.data(), static_cast<unsigned>(parts.size())));
      GEOSGeometry* seen = GEOSDifference_r(geos_, inside, above);
      double m2 = 0;
      GEOSArea_r(geos_, seen, &m2);
      result[ground_cover::find_material(first.surface.kind).name] += m2;
      GEOSGeometry* more = GEOSUnion_r(geos_, above, inside);
      for (GEOSGeometry* done : {inside, seen, above}) GEOSGeom_destroy_r(geos_, done);
      above = more;
      begin = end;
    }
    GEOSGeom_destroy_r(geos_, above);
    GEOSGeom_destroy_r(geos_, window);
  }

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

// Triangles of ground, decks and steps that can be stood on, found by their place.
class StandingSurfaces {
 public:
  explicit StandingSurfaces(const Scene& scene) {
    for (const SceneNode& node : scene.nodes) {
      if (node.kind != "terrain" && node.kind != "road" && node.kind != "bridge") continue;
      for (const ScenePrimitive& primitive : scene.meshes[node.mesh].primitives)
        for (std::size_t i = 0; i < primitive.indices.size(); i += 3) {
          Triangle triangle;
          for (std::size_t k = 0; k < 3; ++k)
            triangle[k] = scene.georeference.from_model(
                glm::dvec3(node.instances.at(0).to_model *
                           glm::vec4(primitive.positions[primitive.indices[i + k]], 1)));
          add(triangle);
        }
    }
  }

  // Returns the heights of all surfaces at a place, the lowest first.
  std::vector<double> find_heights(const glm::dvec2& place) const {
    std::vector<double> heights;
    const auto found = squares_.find(square_of(place));
    if (found == squares_.end()) return heights;
    for (const std::size_t n : found->second) {
      const Triangle& t = triangles_[n];
      const double whole = area(t[0], t[1], t[2]), a = area(place, t[1], t[2]) / whole,
                   b = area(t[0], place, t[2]) / whole, c = 1 - a - b;
      // Places on an edge belong to both sides of it, which is no doubled surface.
      constexpr double within = 1e-6;
      if (a > within && b > within && c > within)
        heights.push_back(a * t[0].z + b * t[1].z + c * t[2].z);
    }
    std::sort(heights.begin(), heights.end());
    return heights;
  }

 private:
  using Triangle = std::array<glm::dvec3, 3>;
  static double area(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    const glm::dvec2 u = b - a, v = c - a;
    return (u.x * v.y - u.y * v.x) / 2;
  }
  static std::pair<long, long> square_of(const glm::dvec2& place) {
    constexpr double side_m = 10;
    return {std::lround(std::floor(place.x / side_m)), std::lround(std::floor(place.y / side_m))};
  }
  void add(const Triangle& t) {
    constexpr double upright_m2 = 1e-4;
    if (std::abs(area(t[0], t[1], t[2])) < upright_m2) return;
    const auto low = square_of(glm::min(glm::min(t[0], t[1]), t[2])),
               high = square_of(glm::max(glm::max(t[0], t[1]), t[2]));
    for (long x = low.first; x <= high.first; ++x)
      for (long y = low.second; y <= high.second; ++y)
        squares_[{x, y}].push_back(triangles_.size());
    triangles_.push_back(t);
  }

  std::vector<Triangle> triangles_;
  std::map<std::pair<long, long>, std::vector<std::size_t>> squares_;
};

// No two surfaces are so near to each other that they fight for a pixel: a depth buffer of 24 bits
// with a near plane at 0.1 m tells 5 mm apart at 90 m.
void expect_surfaces_apart(const Scene& scene, const terrain::Extent& bounds) {
  const StandingSurfaces surfaces(scene);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> share(0, 1);
  constexpr double fighting_m = 0.005;
  int covered = 0, fighting = 0;
  for (int n = 0; n < 50'000; ++n) {
    const glm::dvec2 p =
        bounds.low + (bounds.high - bounds.low) * glm::dvec2(share(random), share(random));
    const std::vector<double> heights = surfaces.find_heights(p);
    covered += !heights.empty();
    for (std::size_t i = 1; i < heights.size(); ++i)
      fighting += heights[i] - heights[i - 1] < fighting_m;
  }
  EXPECT_GT(covered, 10'000);
  EXPECT_EQ(fighting, 0);
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
  const Scene scene = read_scene(folder / "out/city.glb");
  expect_ground_as_drawn(city, scene, *city.terrain().extent());
  expect_surfaces_apart(scene, *city.terrain().extent());
}

TEST(CoverReal, BerlinsSurfacesHaveTheAreasOfTheMap) {
  REAL_DATA(city, "berlin/3910_5819.gml");
  REAL_DATA(map, "berlin/berlin_dev_box.osm.pbf");
  Recipe recipe;
  recipe.city.files = {city};
  recipe.osm.files = {map};
  expect_areas_of_overlay(recipe, 0.01);
}

void expect_areas_of_map(const std::filesystem::path& map) {
  Recipe recipe;
  recipe.osm.files = {map};
  recipe.ground.rails = recipe.ground.markings = false;  // they lie on any of the others
  expect_areas_of_overlay(recipe, 0.01);
}

TEST(CoverReal, SoHasAMapThatIsItsOwnModel) {
  REAL_DATA(map, "osm/northgate.osm");
  expect_areas_of_map(map);
}

TEST(CoverReal, SoHasHelsinki) {
  REAL_DATA(map, "helsinki/Helsinki.osm.pbf");
  expect_areas_of_map(map);
}

TEST(CoverReal, SoHasLondon) {
  REAL_DATA(map, "osm/london.osm.pbf");
  expect_areas_of_map(map);
}

}  // namespace
}  // namespace nightcity::bake
