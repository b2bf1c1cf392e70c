// Tests what inspect says of a scene's extent.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <random>
#include <vector>

#include "support/process.h"
#include "support/temp_folder.h"
#include "tools/nightbake/sample_city.h"

namespace nightcity::nightbake {
namespace {

using nlohmann::json;

// A brute-force look at each vertex of each copy is the oracle. There are some hundred vertices,
// each twice, in two primitives, and copies that are turned, mirrored, sheared and moved.
TEST(InspectScene, TheExtentIsThatOfEachVertexOfEachCopy) {
  const test::TempFolder folder;
  std::mt19937 random(17);
  std::uniform_real_distribution<float> place(-9, 9), factor(-2, 2), shift(-300, 300);
  std::vector<glm::vec3> points;
  for (int n = 0; n < 600; ++n) points.emplace_back(place(random), place(random), place(random));
  std::ofstream(folder / "points.bin", std::ios::binary)
      .write(reinterpret_cast<const char*>(points.data()),
             static_cast<std::streamsize>(points.size() * sizeof points[0]));
  json nodes = json::array(), roots = json::array();
  glm::dvec3 least(1e9), greatest(-1e9);
  for (int n = 0; n < 60; ++n) {
    glm::dmat3 turn;
    for (int column = 0; column < 3; ++column)
      for (int row = 0; row < 3; ++row) turn[column][row] = static_cast<double>(factor(random));
    const double far = n < 30 ? n / 30.0 : 0.01;  // the later ones mostly lie among the earlier
    const glm::dvec3 moved =
        far * glm::dvec3(glm::vec3(shift(random), shift(random), shift(random)));
    json matrix = json::array();
    for (int column = 0; column < 3; ++column) {
      for (int row = 0; row < 3; ++row) matrix.push_back(turn[column][row]);
      matrix.push_back(0);
    }
    for (int row = 0; row < 3; ++row) matrix.push_back(moved[row]);
    matrix.push_back(1);
    nodes.push_back({{"mesh", 0}, {"matrix", matrix}});
    roots.push_back(n);
    for (const glm::vec3& p : points) {
      least = glm::min(least, turn * glm::dvec3(p) + moved);
      greatest = glm::max(greatest, turn * glm::dvec3(p) + moved);
    }
  }
  const json primitive = {{"attributes", {{"POSITION", 0}}}};
  const auto bytes = points.size() * sizeof points[0];
  const json scene = {{"asset", {{"version", "2.0"}}},
                      {"scene", 0},
                      {"scenes", {{{"nodes", roots}}}},
                      {"nodes", nodes},
                      {"meshes", {{{"primitives", {primitive, primitive}}}}},
                      {"accessors",
                       {{{"bufferView", 0},
                         {"componentType", 5126},
                         {"count", points.size()},
                         {"type", "VEC3"},
                         {"min", {-9, -9, -9}},
                         {"max", {9, 9, 9}}}}},
                      {"bufferViews", {{{"buffer", 0}, {"byteLength", bytes}}}},
                      {"buffers", {{{"byteLength", bytes}, {"uri", "points.bin"}}}}};
  test::write_text(folder / "scene.gltf", scene.dump());
  const test::Outcome outcome =
      test::nightbake("inspect --json '" + (folder / "scene.gltf").string() + "'");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json result = json::parse(outcome.out);
  EXPECT_EQ(result.at("triangles_shown"), 60 * 400);
  const json& box = result.at("bbox_model");
  ASSERT_EQ(box.size(), 6u);
  for (int axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    EXPECT_NEAR(box[k].get<double>(), least[axis], 2e-3);
    EXPECT_NEAR(box[k + 3].get<double>(), greatest[axis], 2e-3);
  }
}

// 20,000 copies of 20,000 primitives, all of one triangle: four hundred million triangles are
// shown.
TEST(InspectScene, CountsManyCopiesOfManyPrimitives) {
  const test::TempFolder folder;
  constexpr int many = 20'000;
  const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  std::ofstream(folder / "points.bin", std::ios::binary)
      .write(reinterpret_cast<const char*>(corners), sizeof corners);
  const auto repeat = [](const std::string& text) {
    std::string all = text;
    for (int n = 1; n < many; ++n) all += "," + text;
    return all;
  };
  std::string roots = "0";
  for (int n = 1; n < many; ++n) roots += "," + std::to_string(n);
  test::write_text(
      folder / "scene.gltf",
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[)" + roots + R"(]}],"nodes":[)" +
          repeat(R"({"mesh":0})") + R"(],"meshes":[{"primitives":[)" +
          repeat(R"({"attributes":{"POSITION":0}})") +
          R"(]}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",)"
          R"("min":[0,0,0],"max":[1,1,0]}],"bufferViews":[{"buffer":0,"byteLength":36}],)"
          R"("buffers":[{"byteLength":36,"uri":"points.bin"}]})");
  const test::Outcome outcome =
      test::nightbake("inspect --json '" + (folder / "scene.gltf").string() + "'");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json result = json::parse(outcome.out);
  EXPECT_EQ(result.at("triangles_shown"), std::int64_t{many} * many);
  EXPECT_EQ(result.at("bbox_model"), json({0, 0, 0, 1, 1, 0}));
}

}  // namespace
}  // namespace nightcity::nightbake
