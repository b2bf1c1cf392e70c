// Content of other programs' scenes that has no place in ours is averaged, or named.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "formats/gltf_samples.h"
#include "formats/picture_mean.h"
#include "formats/scene_writer.h"

namespace nightcity {
namespace {

using nlohmann::json;
using test::add_view;
using test::bytes_of;
using test::foreign;
using test::read;

// A PNG of two pixels: opaque (255, 0, 188), and (255, 255, 0) without opacity.
constexpr const char* two_pixels =
    "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAYAAAD0In+KAAAAEUlEQVR42mP4z7Dn////"
    "DAwAGF0EucNPWMkAAAAASUVORK5CYII=";
constexpr float linear_188 = 0.50289f;  // IEC 61966-2-1

json textured(const char* uri = two_pixels) {
  json document = foreign();
  document["images"] = {{{"uri", uri}}};
  document["textures"] = {{{"source", 0}}};
  document["materials"] = {
      {{"pbrMetallicRoughness",
        {{"baseColorFactor", {0.5, 1, 1, 1}}, {"baseColorTexture", {{"index", 0}}}}}}};
  document["meshes"][0]["primitives"][0]["material"] = 0;
  return document;
}

void expect_colour(const glm::vec3& colour, const glm::vec3& wanted) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(colour[i], wanted[i], 1e-4) << i;
}

bool says(const Scene& scene, const std::string& words) {
  return std::any_of(scene.skipped.begin(), scene.skipped.end(), [&](const std::string& sentence) {
    return sentence.find(words) != std::string::npos;
  });
}

// Gives the four vertices texture coordinates.
json placed(std::vector<float> places = {0, 0, 1, 0, 0, 1, 1, 1}) {
  json document = textured();
  const std::string bytes(reinterpret_cast<const char*>(places.data()),
                          places.size() * sizeof(float));
  document["accessors"].push_back({{"bufferView", add_view(document, bytes)},
                                   {"componentType", 5126},
                                   {"count", places.size() / 2},
                                   {"type", "VEC2"}});
  document["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] =
      document["accessors"].size() - 1;
  return document;
}

TEST(ForeignScene, TheMeanOfATextureTimesTheFactorIsTheBaseColour) {
  const Scene scene = read(textured());
  expect_colour(scene.materials.at(0).base_colour, {0.5f, 0.5f, linear_188 / 2});
  EXPECT_TRUE(says(scene, "1 primitive has a texture and no texture coordinates"));
  EXPECT_TRUE(scene.meshes.at(0).primitives.at(0).texture_coordinates.empty());
}

TEST(ForeignScene, ATextureKeepsItsPictureFactorWrapAndCoordinates) {
  json document = placed();
  document["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}}};
  document["textures"][0]["sampler"] = 0;
  const Scene scene = read(document);
  ASSERT_TRUE(scene.materials.at(0).texture);
  EXPECT_EQ(scene.materials[0].texture->factor, glm::vec3(0.5f, 1, 1));
  EXPECT_EQ(scene.materials[0].texture->wrap_u, TextureWrap::clamp);
  EXPECT_EQ(scene.materials[0].texture->wrap_v, TextureWrap::mirror);
  ASSERT_EQ(scene.pictures.size(), 1u);
  EXPECT_EQ(count_picture_pixels(scene.pictures[0]), 2);
  EXPECT_EQ(scene.meshes.at(0).primitives.at(0).texture_coordinates,
            (std::vector<glm::vec2>{{0, 0}, {1, 0}, {0, 1}, {1, 1}}));
  EXPECT_TRUE(scene.skipped.empty());
}

TEST(ForeignScene, ATextureThatIsTransformedOrShinesIsItsMean) {
  json transformed = placed(), shining = placed();
  transformed["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"] = {
      {"KHR_texture_transform", {{"scale", {2, 2}}}}};
  shining["materials"][0]["emissiveFactor"] = {1, 1, 1};
  for (const json& document : {transformed, shining}) {
    const Scene scene = read(document);
    EXPECT_FALSE(scene.materials.at(0).texture);
    EXPECT_TRUE(says(scene, "1 texture is shown as one colour"));
  }
}

TEST(ForeignScene, TextureCoordinatesThatAreNoNumbersCountAsNone) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(says(read(placed({0, 0, nan, 0, 0, 1, 1, 1})), "no texture coordinates"));
  EXPECT_NE(test::refusal(placed({0, 0, 1, 1})).find("TEXCOORD_0"), std::string::npos);
}

// A PNG that says 100,000 by 100,000 pixels, and one that is cut.
TEST(ForeignScene, PicturesThatCannotBeUnpackedAreCountedAndTheFactorStays) {
  json document = placed();
  std::string png = std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16) +
                    std::string("\0\x01\x86\xa0\0\x01\x86\xa0\x08\x02\0\0\0", 13);
  document["images"][0] = {{"bufferView", add_view(document, png)}, {"mimeType", "image/png"}};
  const Scene scene = read(document);
  EXPECT_FALSE(scene.materials.at(0).texture);
  expect_colour(scene.materials[0].base_colour, {0.5f, 1, 1});
  EXPECT_TRUE(says(scene, "8192 x 8192"));
}

TEST(ForeignScene, ThePathOfAPictureMayNotLeaveTheFolder) {
  const Scene scene = read(textured("../picture.png"));
  EXPECT_TRUE(says(scene, "1 texture is not read"));
}

TEST(ForeignScene, ATransparentTextureCountsByItsAlpha) {
  json document = textured();
  document["materials"][0]["alphaMode"] = "MASK";
  const Scene scene = read(document);
  expect_colour(scene.materials.at(0).base_colour, {0.5f, 0, linear_188});
  EXPECT_TRUE(says(scene, "1 material is cut out or transparent"));
}

TEST(ForeignScene, AMissingTextureIsNamedAndTheFactorStays) {
  const Scene scene = read(textured("not%20there.png"));
  expect_colour(scene.materials.at(0).base_colour, {0.5f, 1, 1});
  EXPECT_TRUE(says(scene, "not there.png"));
}

TEST(ForeignScene, AnEmissiveTextureCountsOnlyWhereSomethingShines) {
  json document = textured();
  document["materials"][0] = {{"emissiveTexture", {{"index", 0}}}};
  EXPECT_EQ(read(document).materials.at(0).emission_cd_m2, glm::vec3(0));
  EXPECT_FALSE(says(read(document), "texture"));
  document["materials"][0]["emissiveFactor"] = {1, 1, 1};
  expect_colour(read(document).materials.at(0).emission_cd_m2, {1, 0.5f, linear_188 / 2});
}

TEST(ForeignScene, OtherTexturesAreNamed) {
  json document = textured();
  document["materials"][0]["normalTexture"] = {{"index", 0}};
  document["materials"][0]["pbrMetallicRoughness"]["metallicRoughnessTexture"] = {{"index", 0}};
  EXPECT_TRUE(says(read(document), "2 textures of normals"));
}

TEST(ForeignScene, TheDiffuseColourOfTheSpecularModelIsTheReflectance) {
  json document = textured();
  document["materials"][0] = {
      {"extensions",
       {{"KHR_materials_pbrSpecularGlossiness",
         {{"diffuseFactor", {0.8, 0.1, 0.2, 1}}, {"glossinessFactor", 0.25}}}}}};
  document["extensionsRequired"] = {"KHR_materials_pbrSpecularGlossiness"};
  const Scene scene = read(document);
  expect_colour(scene.materials.at(0).base_colour, {0.8f, 0.1f, 0.2f});
  EXPECT_FLOAT_EQ(scene.materials[0].roughness, 0.75f);
  EXPECT_TRUE(says(scene, "KHR_materials_pbrSpecularGlossiness"));
}

TEST(ForeignScene, ColoursOfVerticesAreAveragedOverEachTriangle) {
  for (const int components : {3, 4}) {
    json document = foreign();
    std::string colours;
    for (const auto& c : {glm::vec3(1, 0, 0), glm::vec3(0.1f, 0.4f, 0), glm::vec3(0.4f, 0.2f, 0.3f),
                          glm::vec3(0.1f, 0, 0)}) {
      colours += bytes_of<float>({c.x, c.y, c.z});
      if (components == 4) colours += bytes_of<float>({0.5f});
    }
    const auto view = add_view(document, colours);
    document["accessors"].push_back({{"bufferView", view},
                                     {"componentType", 5126},
                                     {"count", 4},
                                     {"type", components == 4 ? "VEC4" : "VEC3"}});
    document["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = 2;
    const Scene scene = read(document);
    const ScenePrimitive& primitive = scene.meshes.at(0).primitives.at(0);
    ASSERT_EQ(primitive.triangle_materials.size(), 2u);
    expect_colour(scene.materials.at(primitive.triangle_materials[0]).base_colour,
                  {0.5f, 0.2f, 0.1f});
    expect_colour(scene.materials.at(primitive.triangle_materials[1]).base_colour,
                  {0.2f, 0.2f, 0.1f});
    EXPECT_TRUE(says(scene, "colours of vertices"));
  }
}

TEST(ForeignScene, WhiteVerticesChangeNothing) {
  json document = foreign();
  const auto view = add_view(document, std::string(12, '\xff'));
  document["accessors"].push_back({{"bufferView", view},
                                   {"componentType", 5121},
                                   {"normalized", true},
                                   {"count", 4},
                                   {"type", "VEC3"}});
  document["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = 2;
  const Scene scene = read(document);
  EXPECT_TRUE(scene.meshes.at(0).primitives.at(0).triangle_materials.empty());
  EXPECT_TRUE(scene.skipped.empty());
  EXPECT_EQ(scene.materials.size(), 1u);
}

// Four corners are a strip of two triangles, and a list of one and a corner.
TEST(ForeignScene, CornersBeyondTheLastWholeTriangleAreNamed) {
  json document = foreign();
  EXPECT_FALSE(says(read(document), "beyond the last whole triangle"));
  document["meshes"][0]["primitives"][0]["mode"] = 4;
  EXPECT_TRUE(says(read(document), "1 primitive has corners beyond the last whole triangle"));
}

TEST(ForeignScene, MovementAndLightsAreNamed) {
  json document = foreign();
  document["nodes"][0]["skin"] = 0;
  document["meshes"][0]["weights"] = {0, 0.5};
  document["animations"] = json::array({json::object()});
  document["meshes"][0]["primitives"].push_back({{"mode", 0}, {"attributes", {{"POSITION", 0}}}});
  document["nodes"][0]["extensions"] = {{"KHR_lights_punctual", {{"light", 0}}}};
  document["extensionsUsed"] = {"KHR_lights_punctual", "ACME_smell"};
  const Scene scene = read(document);
  EXPECT_TRUE(says(scene, "1 node has a skin"));
  EXPECT_TRUE(says(scene, "morph targets"));
  EXPECT_TRUE(says(scene, "1 animation is not played"));
  EXPECT_TRUE(says(scene, "1 primitive of points or lines"));
  EXPECT_TRUE(says(scene, "KHR_lights_punctual"));
  EXPECT_TRUE(says(scene, "extensions that are not used: ACME_smell"));
  EXPECT_EQ(scene.skipped.size(), 6u);
}

TEST(ForeignScene, PrimitivesWithoutPositionsAreNamedAndCounted) {
  json document = foreign();
  document["meshes"][0]["name"] = "Roof";
  json& primitives = document["meshes"][0]["primitives"];
  primitives.push_back({{"attributes", json::object()}});
  const Scene one = read(document);
  EXPECT_TRUE(says(
      one, "1 primitive has no POSITION, so nothing of it is seen: mesh 0 (Roof), primitive 1"));
  EXPECT_EQ(one.skipped.size(), 1u);
  for (int i = 0; i < 4; ++i) primitives.push_back({{"attributes", {{"NORMAL", 0}}}});
  const Scene five = read(document);
  EXPECT_TRUE(says(five, "5 primitives have no POSITION"));
  EXPECT_TRUE(says(five, "(Roof), primitive 3; ..."));
  EXPECT_FALSE(says(five, "primitive 4"));
}

TEST(ForeignScene, MaterialsThatAreNotMattAreNamedAndReflectNoMoreThanAll) {
  json document = foreign();
  document["materials"] = {
      {{"pbrMetallicRoughness", {{"baseColorFactor", {2, 0.5, 1, 1}}, {"metallicFactor", 1}}}},
      {{"extensions", {{"KHR_materials_unlit", json::object()}}}}};
  const Scene scene = read(document);
  expect_colour(scene.materials.at(0).base_colour, {1, 0.5f, 1});
  EXPECT_TRUE(says(scene, "1 material reflects more than falls on it"));
  EXPECT_TRUE(says(scene, "1 material is metal"));
  EXPECT_TRUE(says(scene, "1 material is to be shown without light"));
  EXPECT_EQ(scene.skipped.size(), 3u);
}

TEST(ForeignScene, ARotationOfAnotherLengthTurnsAndDoesNotScale) {
  json document = foreign();
  document["nodes"][0]["rotation"] = {0, 0, std::sqrt(2.0), std::sqrt(2.0)};  // of length 2
  const glm::vec4 x = read(document).nodes.at(0).instances.at(0).to_model * glm::vec4(1, 0, 0, 0);
  EXPECT_NEAR(x.x, 0, 1e-6);
  EXPECT_NEAR(x.y, 1, 1e-6);
}

TEST(ForeignScene, InstancesMayHaveNothingButAttributesOfOthers) {
  json document = foreign();
  document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["_ID"] = 0;
  document["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
  EXPECT_EQ(read(document).nodes.at(0).instances.size(), 4u);
}

TEST(ForeignScene, ABakedSceneLosesNothing) {
  const test::TempFolder folder;
  SceneWriter writer(folder / "city.glb", {});
  writer.add_punctual({.intensity_cd = 10});
  writer.finish({});
  EXPECT_TRUE(read_scene(folder / "city.glb").skipped.empty());
  EXPECT_TRUE(read(foreign()).skipped.empty());
}

TEST(PictureMean, BytesThatAreNoPictureHaveNone) {
  const std::string bytes = "\x89PNG\r\n\x1a\n and no more";
  EXPECT_FALSE(find_picture_mean(std::as_bytes(std::span(bytes)), false));
  EXPECT_FALSE(find_picture_mean({}, false));
}

}  // namespace
}  // namespace nightcity
