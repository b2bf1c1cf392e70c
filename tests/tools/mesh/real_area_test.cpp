// In every CityGML file of the data folder the triangles cover what the rings enclose.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <glm/geometric.hpp>
#include <map>
#include <span>
#include <vector>

#include "formats/error.h"
#include "support/data.h"
#include "tools/citygml/citygml_head.h"
#include "tools/citygml/read_citygml.h"
#include "tools/georeference/frame.h"
#include "tools/mesh/classify.h"
#include "tools/mesh/mesh_report.h"
#include "tools/mesh/orient.h"
#include "tools/mesh/polygon_plane.h"
#include "tools/mesh/triangle_mesh.h"
#include "tools/mesh/triangulate.h"

namespace nightcity::mesh {
namespace {

georeference::CityFrame frame_of(const std::filesystem::path& file) {
  const city::CityHead head = citygml::read_citygml_head(file);
  try {
    return georeference::CityFrame::from_srs_name(head.srs_name, head.sample, {});
  } catch (const Error&) {  // invented coordinates under a real CRS are taken as they are
    return georeference::CityFrame::from_srs_name("", {}, {});
  }
}

void project(city::CityObject& object, const georeference::CityFrame& frame) {
  for (city::Polygon& polygon : object.polygons) {
    frame.to_projected(polygon.exterior);
    for (city::Ring& ring : polygon.interiors) frame.to_projected(ring);
  }
}

// Returns the area vector of the rings themselves: the exterior's, less the holes' along the same
// normal.
glm::dvec3 vector_of_rings(const city::Polygon& polygon) {
  glm::dvec3 sum = city::area_vector(remove_duplicates(polygon.exterior));
  const glm::dvec3 outward = sum;
  for (const city::Ring& hole : polygon.interiors) {
    const glm::dvec3 of_hole = city::area_vector(remove_duplicates(hole));
    sum -= glm::dot(of_hole, outward) > 0 ? of_hole : -of_hole;
  }
  return sum;
}

struct Tally {
  std::size_t files = 0, polygons = 0, wrong = 0;
  double worst = 0;  // relative, of polygons not counted as faulty
  std::map<city::SurfaceType, double> rings_m2, triangles_m2;
  std::size_t buildings = 0, wrong_buildings = 0;
  double worst_building = 0;  // relative, of a building's whole, wall or roof area
};

// Areas of one building: all of it, its walls, its roofs.
struct BuildingAreas {
  std::array<double, 3> rings{}, triangles{};
  void add(city::SurfaceType surface, double of_rings, double of_triangles) {
    for (const std::size_t i : {std::size_t{0}, std::size_t{1}, std::size_t{2}}) {
      if ((i == 1 && surface != city::SurfaceType::wall) ||
          (i == 2 && surface != city::SurfaceType::roof))
        continue;
      rings[i] += of_rings;
      triangles[i] += of_triangles;
    }
  }
};

// Compares polygon by polygon; those the report counts as self-intersecting have no area to compare
// with.
void compare(const city::CityObject& object, MeshReport& report, Tally& tally) {
  BuildingAreas building;
  for (const city::Polygon& polygon : object.polygons) {
    city::CityObject one;
    one.id = object.id;
    one.polygons = {polygon};
    MeshReport own;
    const TriangleMesh mesh = triangulate(one, own);
    report.merge(own);
    ++tally.polygons;
    glm::dvec3 vector{0};
    double area = 0;
    for (const MeshTriangle& t : mesh.triangles) {
      const glm::dvec3& a = mesh.positions[t.vertex[0]];
      const glm::dvec3 half =
          0.5 * glm::cross(mesh.positions[t.vertex[1]] - a, mesh.positions[t.vertex[2]] - a);
      vector += half;
      area += glm::length(half);
    }
    if (own.self_intersecting + own.zero_area + own.not_finite + own.holes_left_out > 0) continue;
    const glm::dvec3 truth = vector_of_rings(polygon);
    const double off = glm::distance(vector, truth) / glm::length(truth);
    tally.worst = std::max(tally.worst, off);
    tally.wrong += !(off <= 1e-6);
    tally.rings_m2[polygon.surface] += glm::length(truth);
    // No overlaps: triangles exceed the flat area only by vertices off the plane, by at most 1 cm.
    double perimeter = 0;
    for (std::size_t i = 0; i < polygon.exterior.size(); ++i)
      perimeter +=
          glm::distance(polygon.exterior[i], polygon.exterior[(i + 1) % polygon.exterior.size()]);
    if (own.non_planar == 0) {
      EXPECT_LE(area, glm::length(truth) + 0.01 * perimeter) << polygon.id;
    }
    const double covered = glm::dot(vector, truth) / glm::length(truth);
    tally.triangles_m2[polygon.surface] += covered;
    building.add(polygon.surface, glm::length(truth), covered);
  }
  if (object.type != city::ObjectType::building) return;
  ++tally.buildings;
  double worst = 0;
  for (std::size_t i = 0; i < 3; ++i)
    if (building.rings[i] > 0)
      worst =
          std::max(worst, std::abs(building.triangles[i] - building.rings[i]) / building.rings[i]);
  tally.worst_building = std::max(tally.worst_building, worst);
  tally.wrong_buildings += !(worst <= 1e-6);
}

TEST(RealAreas, TrianglesKeepTheAreaOfEveryPolygonToAMillionth) {
  REAL_DATA(root, ".");
  Tally tally;
  MeshReport report;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    const std::string extension = entry.path().extension();
    if (extension != ".gml" && extension != ".xml" && extension != ".citygml") continue;
    try {
      const georeference::CityFrame frame = frame_of(entry.path());
      city::ReadOptions options;
      options.max_lod = 4;
      citygml::read_citygml(entry.path(), options, [&](city::CityObject&& object) {
        project(object, frame);
        if (has_finite_places(object)) classify_unknown_surfaces(object);
        compare(object, report, tally);
      });
      ++tally.files;
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find("is not CityGML"), std::string::npos) << e.what();
    }
  }
  EXPECT_GT(tally.polygons, 100000u);
  EXPECT_EQ(tally.wrong, 0u);
  EXPECT_LE(tally.worst, 1e-6);
  for (const auto& [surface, area] : tally.rings_m2)
    EXPECT_NEAR(tally.triangles_m2[surface], area, 1e-6 * area) << city::name_of(surface);
  EXPECT_GT(tally.buildings, 5000u);
  EXPECT_EQ(tally.wrong_buildings, 0u) << "worst " << tally.worst_building;
  EXPECT_EQ(report.not_triangulated, 0u);
  EXPECT_LT(report.self_intersecting, tally.polygons / 1000);
  std::printf(
      "%zu files, %zu polygons, worst %.1e; %zu buildings, worst %.1e of whole, walls or roofs; "
      "fast path "
      "%zu, zero area %zu, off plane %zu (worst %.3f m: %s), "
      "self-intersecting %zu\n",
      tally.files, tally.polygons, tally.worst, tally.buildings, tally.worst_building,
      report.fast_path, report.zero_area, report.non_planar, report.worst_non_planar_m,
      report.worst_non_planar.c_str(), report.self_intersecting);
}

}  // namespace
}  // namespace nightcity::mesh
