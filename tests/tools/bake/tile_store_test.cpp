#include "tools/bake/scene/tile_store.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "support/temp_folder.h"

namespace nightcity::bake {
namespace {

using Triangle = TileStore::Triangle;

Triangle triangle(glm::dvec3 at, double size, MaterialCode material = to_code(BakeMaterial::wall),
                  NodeKind kind = NodeKind::city) {
  return {{at, at + glm::dvec3(size, 0, 0), at + glm::dvec3(0, size, size)}, material, kind};
}

// Returns E, N, H of a vertex of a tile's mesh.
glm::dvec3 place(const TileStore& store, const TileKey& key, const glm::vec3& p) {
  const glm::dvec3 origin = store.origin(key);
  return {origin.x + double{p.x}, origin.y - double{p.z}, origin.z + double{p.y}};
}

TEST(TileStore, KeepsCoordinatesToATenthOfAMillimetreFarFromTheOrigin) {
  const test::TempFolder folder;
  TileStore store(folder / "x", 250, 500);
  const Triangle one = triangle({4468231.1237, 5333987.4561, 515.7891}, 7.77);
  store.add({&one, 1}, 3);
  ASSERT_EQ(store.tiles().size(), 1u);
  const TileKey key = store.tiles()[0];
  const SceneMesh mesh = store.mesh(key, glm::dmat4(1)).mesh;
  ASSERT_EQ(mesh.primitives.size(), 1u);
  for (int i = 0; i < 3; ++i)
    EXPECT_LT(
        glm::distance(place(store, key, mesh.primitives[0].positions[static_cast<std::size_t>(i)]),
                      one.corners[i]),
        1e-4);
  EXPECT_EQ(mesh.primitives[0].feature_ids, (std::vector<std::uint32_t>{3, 3, 3}));
}

TEST(TileStore, AnObjectSmallerThanATileStaysWholeALargerOneIsShared) {
  const test::TempFolder folder;
  TileStore store(folder / "x", 100, 0);
  const std::vector<Triangle> house{triangle({95, 50, 0}, 4),
                                    triangle({103, 50, 0}, 4)};  // astride x = 100
  store.add(house, 0);
  EXPECT_EQ(store.tiles().size(), 1u);
  const std::vector<Triangle> relief{
      triangle({10, 10, 0}, 4, to_code(BakeMaterial::terrain), NodeKind::terrain),
      triangle({410, 10, 0}, 4, to_code(BakeMaterial::terrain), NodeKind::terrain)};
  store.add(relief, 1);
  EXPECT_EQ(store.tiles().size(), 3u);
}

TEST(TileStore, LosesNoTriangleAndKeepsTheirOrder) {
  const test::TempFolder folder;
  TileStore store(folder / "x", 50, 0);
  std::size_t added = 0;
  for (std::uint32_t object = 0; object < 500; ++object) {
    std::vector<Triangle> triangles;
    for (int t = 0; t < 3; ++t)
      triangles.push_back(
          triangle({(object * 37) % 300 - 100.0, (object * 53) % 300 - 100.0, t * 2.0}, 1 + t,
                   object % 2 ? to_code(BakeMaterial::roof) : to_code(BakeMaterial::wall)));
    added += triangles.size();
    store.add(triangles, object);
  }
  std::size_t found = 0;
  for (const TileKey& key : store.tiles()) {
    const SceneMesh mesh = store.mesh(key, glm::dmat4(1)).mesh;
    for (const ScenePrimitive& primitive : mesh.primitives) {
      found += primitive.indices.size() / 3;
      std::uint32_t last = 0;
      for (const std::uint32_t index : primitive.indices) {
        EXPECT_GE(primitive.feature_ids[index], last);
        last = primitive.feature_ids[index];
        const glm::dvec3 p = place(store, key, primitive.positions[index]);
        EXPECT_GE(p.x, key.column * 50.0 - 5);
        EXPECT_LT(p.x, key.column * 50.0 + 55);
        EXPECT_GE(p.y, key.row * 50.0 - 5);
        EXPECT_LT(p.y, key.row * 50.0 + 55);
      }
    }
  }
  EXPECT_EQ(found, added);
}

// Its corners are three, and its area is 0 as floats compute it: a micrometre beside 30 m.
TEST(TileStore, ATriangleWithoutAreaIsNotWritten) {
  const test::TempFolder folder;
  TileStore store(folder / "x", 250, 0);
  const Triangle seen = triangle({10, 10, 0}, 4),
                 sliver{{{30, 40, 2}, {30, 40, 32}, {30, 40 + 1e-6, 17}},
                        to_code(BakeMaterial::wall),
                        NodeKind::city};
  store.add(std::vector{seen, sliver}, 0);
  const SceneMesh mesh = store.mesh(store.tiles().at(0), glm::dmat4(1)).mesh;
  ASSERT_EQ(mesh.primitives.size(), 1u);
  EXPECT_EQ(mesh.primitives[0].indices.size(), 3u);
}

// Floats from 16 on are 1.9e-6 m apart, and those from 8192 on 0.98 mm: a side of a tenth of a
// millimetre has its length in the tile, and none where the tile stands 8 km from the origin.
TEST(TileStore, ATriangleThatLosesItsAreaWhereItsTileStandsIsNotWritten) {
  const test::TempFolder folder;
  TileStore store(folder / "x", 250, 0);
  const Triangle sliver{
      {{20, 40, 2}, {20.0001, 40, 2}, {20, 40, 10}}, to_code(BakeMaterial::wall), NodeKind::city};
  store.add(std::vector{triangle({10, 10, 0}, 4), sliver}, 0);
  const TileKey key = store.tiles().at(0);
  for (const bool is_far : {false, true}) {
    glm::dmat4 to_model(1);
    if (is_far) to_model[3].x = 8250;
    const TileStore::TileMesh tile = store.mesh(key, to_model);
    ASSERT_EQ(tile.mesh.primitives.size(), 1u);
    EXPECT_EQ(tile.mesh.primitives[0].indices.size(), is_far ? 3u : 6u);
    EXPECT_EQ(tile.flat, is_far ? 1u : 0u);
  }
}

TEST(TileStore, WeldsEqualVerticesOfOneObjectOnly) {
  const test::TempFolder folder;
  TileStore store(folder / "x", 100, 0);
  const glm::dvec3 a(1, 1, 0), b(2, 1, 0), c(2, 2, 0), d(1, 2, 0);
  const std::vector<Triangle> square{{{a, b, c}, to_code(BakeMaterial::wall), NodeKind::city},
                                     {{a, c, d}, to_code(BakeMaterial::wall), NodeKind::city}};
  store.add(square, 0);
  store.add(square, 1);
  const SceneMesh mesh = store.mesh(store.tiles().at(0), glm::dmat4(1)).mesh;
  EXPECT_EQ(mesh.primitives.at(0).positions.size(), 8u);
  EXPECT_EQ(mesh.primitives.at(0).indices.size(), 12u);
}

}  // namespace
}  // namespace nightcity::bake
