// Accessors that are valid and rare: sparse ones, ones without data, empty ones.
#include "formats/gltf_accessor.h"

#include <gtest/gtest.h>

#include "formats/gltf_samples.h"

namespace nightcity {
namespace {

using nlohmann::json;
using test::add_view;
using test::bytes_of;
using test::foreign;
using test::read;
using test::refusal;

// A square whose last corner moves to (5, 6, 7).
json with_sparse_corner(bool has_base) {
  json document = foreign();
  json& accessor = document["accessors"][0];
  if (!has_base) accessor.erase("bufferView");
  const auto places = add_view(document, bytes_of<std::uint16_t>({1, 3}));
  const auto values = add_view(document, bytes_of<float>({1, 0, 0, 5, 6, 7}));
  document["accessors"][0]["sparse"] = {
      {"count", 2},
      {"indices", {{"bufferView", places}, {"componentType", 5123}}},
      {"values", {{"bufferView", values}}}};
  return document;
}

TEST(GltfAccessor, SparseValuesReplaceThoseOfTheBufferView) {
  const Scene scene = read(with_sparse_corner(true));
  const auto& positions = scene.meshes[0].primitives[0].positions;
  EXPECT_EQ(positions, (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 6, 7}}));
}

TEST(GltfAccessor, SparseValuesReplaceZerosWithoutABufferView) {
  const Scene scene = read(with_sparse_corner(false));
  const auto& positions = scene.meshes[0].primitives[0].positions;
  EXPECT_EQ(positions, (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {5, 6, 7}}));
}

TEST(GltfAccessor, IndicesMayBeSparseToo) {
  json document = foreign();
  const auto places = add_view(document, bytes_of<std::uint8_t>({0}));
  const auto values = add_view(document, bytes_of<std::uint8_t>({3}));
  document["accessors"][1]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", places}, {"componentType", 5121}}},
      {"values", {{"bufferView", values}}}};
  EXPECT_EQ(read(document).meshes[0].primitives[0].indices,
            (std::vector<std::uint32_t>{3, 1, 2, 1, 3, 2}));
}

TEST(GltfAccessor, RefusesSparseValuesThatContradictTheFile) {
  const auto message = [](auto&& spoil) {
    json document = with_sparse_corner(true);
    spoil(document["accessors"][0]["sparse"]);
    return refusal(document);
  };
  EXPECT_NE(message([](json& s) { s["count"] = 5; }), "");
  EXPECT_NE(message([](json& s) { s["count"] = 3; }), "");  // beyond the views
  EXPECT_NE(message([](json& s) { s["indices"]["componentType"] = 5126; }), "");
  EXPECT_NE(message([](json& s) { s["indices"].erase("bufferView"); }), "");
  EXPECT_NE(message([](json& s) { s["values"]["bufferView"] = 99; }), "");
  EXPECT_NE(message([](json& s) { s["values"]["byteOffset"] = 18446744073709551615u; }), "");
  json document = with_sparse_corner(true);
  document["accessors"][0]["count"] = 3;  // the value for element 3 has no place
  EXPECT_NE(refusal(document).find("element 3 of 3"), std::string::npos) << refusal(document);
}

TEST(GltfAccessor, WhatIsEmptyAddsNothing) {
  json document = foreign();
  const json empty = {{"componentType", 5126}, {"count", 0}, {"type", "VEC3"}};
  const json zeros = {{"componentType", 5126}, {"count", 3}, {"type", "VEC3"}};
  document["accessors"].push_back(empty);
  document["accessors"].push_back(zeros);
  document["meshes"].push_back({{"primitives", {{{"attributes", {{"POSITION", 2}}}}}}});
  document["meshes"].push_back({{"primitives", {{{"attributes", json::object()}}}}});
  document["meshes"].push_back({{"primitives", {{{"indices", 1}}}}});
  document["meshes"].push_back({{"primitives", json::array()}});
  document["meshes"].push_back({{"name", "no primitives"}});
  document["meshes"].push_back({{"primitives", {{{"attributes", {{"POSITION", 3}}}}}}});
  const Scene scene = read(document);
  ASSERT_EQ(scene.meshes.size(), 7u);
  EXPECT_EQ(scene.meshes[0].primitives.size(), 1u);
  for (std::size_t i = 1; i < 6; ++i) EXPECT_TRUE(scene.meshes[i].primitives.empty()) << i;
  EXPECT_EQ(scene.meshes[6].primitives.at(0).positions, std::vector<glm::vec3>(3));
}

}  // namespace
}  // namespace nightcity
