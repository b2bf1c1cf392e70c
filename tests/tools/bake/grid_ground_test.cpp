// The ground of elevation models goes on where they have no data.
#include "tools/bake/city/grid_ground.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <string>

#include "support/temp_folder.h"

namespace nightcity::bake {
namespace {

using test::TempFolder;

double plane(const glm::dvec2& p) {
  return 30 + p.x / 50 - p.y / 80;
}

using HasData = std::function<bool(const glm::dvec2&)>;

// Writes the plane's heights, one every 2 m, from (-50, -50) to (350, 150).
void write_plane(const std::filesystem::path& path, const HasData& has_data) {
  std::string text =
      "ncols 200\nnrows 100\nxllcorner -50\nyllcorner -50\ncellsize 2\nNODATA_value -9999\n";
  for (int row = 99; row >= 0; --row)
    for (int column = 0; column < 200; ++column) {
      const glm::dvec2 p(column * 2 - 49, row * 2 - 49);
      text += (has_data(p) ? std::to_string(plane(p)) : "-9999") + (column < 199 ? " " : "\n");
    }
  test::write_text(path, text);
}

const std::vector<Tile> tiles{{0, 0}, {1, 0}, {2, 0}};

struct Ground {
  std::vector<mesh::TriangleMesh> meshes;
  double missing_percent;
};

Ground make_ground(const std::filesystem::path& model, double max_error_m,
                   const std::optional<std::vector<glm::dvec3>>& feet) {
  const auto frame = georeference::CityFrame::from_srs_name("", {}, {});
  GroundOptions options;
  options.elevation_models = {model};
  options.tile_m = 100;
  options.max_error_m = max_error_m;
  const GroundHeights heights(options, frame);
  GridGround ground(heights, options, tiles.size());
  Ground result;
  for (const Tile& tile : tiles)
    if (auto mesh = ground.make_whole(tile)) result.meshes.push_back(std::move(*mesh));
  if (feet) ground.fill_gaps(*feet);
  for (const Tile& tile : ground.tiles_with_gaps())
    result.meshes.push_back(ground.make_filled(tile));
  result.missing_percent = ground.missing_percent();
  return result;
}

double find_area(const Ground& ground) {
  double area = 0;
  for (const mesh::TriangleMesh& mesh : ground.meshes)
    for (const mesh::MeshTriangle& t : mesh.triangles) {
      const glm::dvec2 a(mesh.positions[t.vertex[0]]), b(mesh.positions[t.vertex[1]]),
          c(mesh.positions[t.vertex[2]]);
      area += ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2;
    }
  return area;
}

// Returns how far the vertices that triangles use are off the plane at most.
double find_worst(const Ground& ground) {
  double worst = 0;
  for (const mesh::TriangleMesh& mesh : ground.meshes)
    for (const mesh::MeshTriangle& t : mesh.triangles)
      for (const std::uint32_t v : t.vertex)
        worst =
            std::max(worst, std::abs(mesh.positions[v].z - plane(glm::dvec2(mesh.positions[v]))));
  return worst;
}

bool is_west(const glm::dvec2& p) {
  return p.x < 130;
}
bool is_outside_a_pond(const glm::dvec2& p) {
  return glm::length(p - glm::dvec2(190, 50)) > 30;
}

// The corners of buildings all over the tiles and beyond.
std::vector<glm::dvec3> spread_feet() {
  std::vector<glm::dvec3> feet;
  for (int x = -20; x <= 320; x += 10)
    for (int y = -20; y <= 120; y += 10) feet.emplace_back(x, y, plane({x, y}));
  return feet;
}

TEST(GridGround, GoesOnThroughTheFeetOfBuildingsBeyondTheData) {
  const TempFolder folder;
  write_plane(folder / "west.asc", is_west);
  for (const double max_error_m : {0.0, 0.01}) {
    const Ground ground = make_ground(folder / "west.asc", max_error_m, spread_feet());
    EXPECT_NEAR(find_area(ground), 3e4, 1e-6);
    EXPECT_LT(find_worst(ground), 1e-3 + max_error_m);
    EXPECT_NEAR(ground.missing_percent, 100 * 170 / 300.0, 1);
  }
}

TEST(GridGround, IsLaidOverAGapInTheDataFromEdgeToEdge) {
  const TempFolder folder;
  write_plane(folder / "pond.asc", is_outside_a_pond);
  const Ground ground = make_ground(folder / "pond.asc", 0, std::vector<glm::dvec3>());
  EXPECT_NEAR(find_area(ground), 3e4, 1e-6);
  EXPECT_LT(find_worst(ground), 1e-3);
}

// Without feet it keeps the height of the nearest data.
TEST(GridGround, GoesOnLevelWhereNothingStands) {
  const TempFolder folder;
  write_plane(folder / "west.asc", is_west);
  const Ground ground = make_ground(folder / "west.asc", 0, std::vector<glm::dvec3>());
  EXPECT_NEAR(find_area(ground), 3e4, 1e-6);
  const double highest = plane({130, 0}), lowest = plane({0, 100});
  for (const mesh::TriangleMesh& mesh : ground.meshes)
    for (const glm::dvec3& p : mesh.positions) {
      EXPECT_GT(p.z, lowest - 0.01);
      EXPECT_LT(p.z, highest + 0.01);
    }
}

TEST(GridGround, KeepsItsGapsWhereTheyAreNotFilled) {
  const TempFolder folder;
  write_plane(folder / "west.asc", is_west);
  const Ground ground = make_ground(folder / "west.asc", 0, {});
  EXPECT_NEAR(find_area(ground), 3e4 * (1 - ground.missing_percent / 100), 1e-6);
  EXPECT_LT(find_worst(ground), 1e-3);
}

TEST(GroundHeights, NearAPlaceWithoutDataIsAHeightOfData) {
  const TempFolder folder;
  write_plane(folder / "west.asc", is_west);
  const auto frame = georeference::CityFrame::from_srs_name("", {}, {});
  GroundOptions options;
  options.elevation_models = {folder / "west.asc"};
  const GroundHeights heights(options, frame);
  EXPECT_NEAR(heights.near({20, 30}), plane({20, 30}), 1e-3);
  // The circle that first reaches the data has at most twice the distance to them.
  for (const double beyond : {5.0, 40.0, 150.0}) {
    const glm::dvec2 p(130 + beyond, 50);
    EXPECT_NEAR(heights.near(p), plane(p), 2 * beyond * (1 / 50.0 + 1 / 80.0) + 0.1);
  }
  EXPECT_TRUE(std::isnan(heights.near({20'000, 0})));
}

}  // namespace
}  // namespace nightcity::bake
