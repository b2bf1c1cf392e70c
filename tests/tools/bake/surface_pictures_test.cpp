// Pictures on polygons that share one, as the shapes of implicit geometry do.
#include "tools/bake/city/surface_pictures.h"

#include <gtest/gtest.h>

#include <memory>

#include "tools/mesh/triangulate.h"

namespace nightcity::bake {
namespace {

// A wall 4 m wide and 2 m high with its lower left corner at `corner`, `length` times as large.
city::Polygon wall(const glm::dvec3& corner, double length,
                   const std::shared_ptr<const city::SurfacePicture>& picture) {
  city::Polygon polygon;
  polygon.surface = city::SurfaceType::wall;
  polygon.exterior = {corner, corner + glm::dvec3(4, 0, 0) * length,
                      corner + glm::dvec3(4, 0, 2) * length, corner + glm::dvec3(0, 0, 2) * length};
  polygon.picture = picture;
  return polygon;
}

TEST(SurfacePictures, EachOfTwoPolygonsHasTheWholeOfThePictureThatTheyShare) {
  const auto picture = std::make_shared<city::SurfacePicture>();
  picture->width = 8;
  picture->height = 4;
  picture->rgb.assign(3 * 8 * 4, 100);
  picture->places = {{0, 4}, {8, 4}, {8, 0}, {0, 0}};
  city::CityObject object;
  object.type = city::ObjectType::building;
  object.polygons = {wall({0, 0, 0}, 1, picture), wall({50, 20, 3}, 1, picture),
                     wall({90, 0, 0}, 0.5, picture)};
  const PictureLayout layout(object);
  mesh::MeshReport report;
  const mesh::TriangleMesh mesh = mesh::triangulate(object, report);
  ASSERT_EQ(mesh.triangles.size(), 6u);
  const SurfacePictures laid = layout.lay_out(mesh, object, 2);  // as many as the picture has
  ASSERT_EQ(laid.triangles.size(), 6u);
  ASSERT_EQ(laid.pieces.size(), 2u) << "two walls have one size, the third is half as large";
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const mesh::MeshTriangle& triangle = mesh.triangles[i];
    const city::Ring& ring = object.polygons[triangle.polygon].exterior;
    const double texels = triangle.polygon == 2 ? 4 : 8;
    EXPECT_EQ(laid.pieces[laid.triangles[i].piece].width, texels);
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec3 p = mesh.positions[triangle.vertex[k]];
      const double u = (p.x - ring[0].x) / (ring[1].x - ring[0].x),
                   v = (p.z - ring[0].z) / (ring[2].z - ring[0].z);
      EXPECT_NEAR(laid.triangles[i].places[k].x, u * texels, 1e-6);
      EXPECT_NEAR(laid.triangles[i].places[k].y, (1 - v) * texels / 2, 1e-6);
    }
  }
}

}  // namespace
}  // namespace nightcity::bake
