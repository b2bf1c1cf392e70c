#include "runtime/scene/mesh_triangles.h"

#include <gtest/gtest.h>

#include <glm/ext/matrix_transform.hpp>
#include <memory>
#include <vector>

#include "formats/error.h"

namespace nightcity::scene {
namespace {

// A row of triangles, of which every `flat`-th has no area.
SceneMesh make_mesh(std::uint32_t triangles, std::uint32_t flat, std::uint32_t material) {
  SceneMesh mesh;
  ScenePrimitive& primitive = mesh.primitives.emplace_back();
  primitive.material = material;
  for (std::uint32_t i = 0; i < triangles; ++i) {
    const float x = float(i), high = flat > 0 && i % flat == 0 ? 0.0f : 1.0f;
    for (const glm::vec3& p : {glm::vec3(x, 0, 0), glm::vec3(x + 1, 0, 0), glm::vec3(x, high, 0)}) {
      primitive.indices.push_back(static_cast<std::uint32_t>(primitive.positions.size()));
      primitive.positions.push_back(p);
    }
  }
  return mesh;
}

struct City {
  std::vector<SceneMesh> meshes;
  std::vector<PlacedMesh> placed;
  MeshSource source() const {
    MeshSource source;
    source.read = [this](std::uint32_t mesh, MappedMesh*) {
      return std::make_shared<const SceneMesh>(meshes.at(mesh));
    };
    source.in_parallel = true;
    for (const SceneMesh& mesh : meshes)
      source.triangles.push_back(mesh.primitives[0].indices.size() / 3);
    return source;
  }
};

City make_city() {
  City city;
  for (std::uint32_t i = 0; i < 40; ++i) {
    city.meshes.push_back(make_mesh(1 + 7 * i, i % 3, i));
    city.placed.push_back({i, {{glm::translate(glm::dmat4(1), glm::dvec3(0, 0, double(i)))}}});
  }
  return city;
}

TEST(MeshTriangles, AreThoseOfTheMeshesOneAfterTheOther) {
  const City city = make_city();
  TriangleList one_by_one;
  for (int i = 0; i < 3; ++i) one_by_one.push_back({});
  std::size_t flat = 0;
  for (const PlacedMesh& placed : city.placed)
    flat += append_mesh(city.meshes[placed.mesh], placed.placements[0].to_scene, {}, one_by_one);
  EXPECT_GT(flat, 0u);
  for (const unsigned threads : {1u, 2u, 5u}) {
    TriangleList together;
    for (int i = 0; i < 3; ++i) together.push_back({});
    EXPECT_EQ(append_meshes(city.placed, city.source(), {}, threads, together), flat);
    ASSERT_EQ(together.size(), one_by_one.size());
    for (std::size_t i = 3; i < together.size(); ++i) {
      EXPECT_EQ(together[i].v0, one_by_one[i].v0);
      EXPECT_EQ(together[i].v2, one_by_one[i].v2);
      EXPECT_EQ(together[i].material, one_by_one[i].material);
    }
  }
}

// Nothing is lost where the accessors of a file promise fewer triangles than it has.
TEST(MeshTriangles, MayBeMoreThanWasSaid) {
  const City city = make_city();
  MeshSource source = city.source();
  TriangleList right, wrong;
  const std::size_t flat = append_meshes(city.placed, source, {}, 2, right);
  source.triangles[5] = 0;
  source.triangles[39] = 3;
  EXPECT_EQ(append_meshes(city.placed, source, {}, 2, wrong), flat);
  ASSERT_EQ(wrong.size(), right.size());
  double sum = 0;
  for (std::size_t i = 0; i < right.size(); ++i)
    sum += double(right[i].material) - double(wrong[i].material);
  EXPECT_EQ(sum, 0.0);
}

TEST(MeshTriangles, OfAMeshInSeveralPlacesHaveTheLightOfThePlaceOrTheirOwn) {
  City city;
  city.meshes.push_back(make_mesh(3, 0, 0));
  city.meshes[0].primitives[0].light_ids.assign(9, 4);
  const glm::dmat4 here(1), there = glm::translate(glm::dmat4(1), glm::dvec3(0, 0, 5));
  TriangleList out;
  EXPECT_EQ(append_meshes({{0, {{here, 7}, {there}}}}, city.source(), {}, 2, out), 0u);
  ASSERT_EQ(out.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(out[i].light, i < 3 ? 7u : 4u);
    EXPECT_EQ(out[i].v0.z, i < 3 ? 0.0f : 5.0f);
  }
}

TEST(MeshTriangles, AreRefusedWhereASceneCannotHaveAsMany) {
  const City city = make_city();
  MeshSource source = city.source();
  source.triangles[0] = std::size_t{1} << 30;
  TriangleList out;
  EXPECT_THROW(append_meshes(city.placed, source, {}, 1, out), Error);
}

}  // namespace
}  // namespace nightcity::scene
