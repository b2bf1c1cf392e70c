#include <gtest/gtest.h>

#include <cmath>

#include "formats/draco_codec.h"
#include "formats/gltf_constants.h"
#include "formats/scene_reader.h"
#include "formats/scene_samples.h"
#include "formats/scene_writer.h"
#include "support/temp_folder.h"

namespace nightcity {
namespace {

TEST(Draco, BitsKeepTheToleranceAndNoMore) {
  for (const double extent : {1.0, 250.0, 500.0, 3000.0})
    for (const double tolerance : {0.001, 0.01, 0.1}) {
      const int bits = draco_bits(extent, tolerance);
      const auto moved = [&](int b) {
        return std::sqrt(3.0) / 2 * extent / (std::ldexp(1.0, b) - 1);
      };
      EXPECT_LE(moved(bits), tolerance) << extent << " " << tolerance;
      EXPECT_GT(moved(bits - 1), tolerance) << extent << " " << tolerance;
    }
  EXPECT_EQ(draco_bits(0, 0.01), 1);
  EXPECT_EQ(draco_bits(1e9, 1e-9), 30);
}

TEST(Draco, MovesNoVertexBeyondTheToleranceAndKeepsIdsExactly) {
  ScenePrimitive primitive = test::field(900);
  std::vector<float> features(primitive.positions.size());
  for (std::size_t i = 0; i < features.size(); ++i)
    features[i] = static_cast<float>(100'000 + i / 4 * 7);
  features[0] = gltf::null_feature_id;
  for (auto& p : primitive.positions) p = p * 1.37f + glm::vec3(0.123f, 31.7f, -400.05f);
  for (const double tolerance : {0.001, 0.01, 0.2}) {
    const auto encoded = encode_draco(primitive, features, {}, tolerance);
    ASSERT_TRUE(encoded);
    EXPECT_LE(encoded->error_m, tolerance + 1e-4);
    EXPECT_GT(encoded->error_m, tolerance / 20) << "measured on the decoded mesh, so not zero";
    const DracoAttribute wanted[]{{static_cast<std::uint32_t>(encoded->position_id), 3},
                                  {static_cast<std::uint32_t>(encoded->feature_id), 1}};
    const DracoDecoded decoded = decode_draco(std::as_bytes(std::span(encoded->bytes)), wanted);
    EXPECT_EQ(decoded.indices.size(), primitive.indices.size());
    // Each decoded vertex is near an original one of the same feature.
    std::map<float, std::vector<glm::vec3>> originals;
    for (std::size_t i = 0; i < features.size(); ++i)
      originals[features[i]].push_back(primitive.positions[i]);
    for (std::size_t i = 0; i < decoded.attributes[1].size(); ++i) {
      const auto found = originals.find(decoded.attributes[1][i]);
      ASSERT_NE(found, originals.end()) << decoded.attributes[1][i];
      const float* v = &decoded.attributes[0][3 * i];
      float nearest = 1e9f;
      for (const glm::vec3& p : found->second)
        nearest = std::min(nearest, glm::distance(p, {v[0], v[1], v[2]}));
      EXPECT_LE(nearest, tolerance + 1e-4);
    }
  }
}

TEST(Draco, AMeshThatItCannotEncodeIsStoredUncompressed) {
  const test::TempFolder folder;
  SceneWriter writer(folder / "city.glb", {.draco = true});
  writer.add_material({});
  ScenePrimitive flat = test::square(1);
  flat.indices = {0, 0, 1, 2, 2, 2};
  writer.add_node({"", "", writer.add_mesh({"", {flat, test::square(5)}}), true, {{}}});
  writer.finish({});
  const Scene scene = read_scene(folder / "city.glb");
  EXPECT_EQ(scene.meshes[0].primitives[0].indices, flat.indices);
  EXPECT_EQ(scene.meshes[0].primitives[1].indices.size(), 6u);
}

}  // namespace
}  // namespace nightcity
