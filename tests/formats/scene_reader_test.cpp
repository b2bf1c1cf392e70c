// Reads glTF files that others made: valid ones must open, broken ones must be refused.
#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

#include "formats/error.h"
#include "formats/gltf_samples.h"
#include "formats/scene_reader.h"
#include "formats/scene_samples.h"
#include "formats/scene_writer.h"
#include "support/temp_folder.h"

namespace nightcity {
namespace {

using nlohmann::json;
using test::bytes_of;
using test::foreign;
using test::read;
using test::TempFolder;

using Indices = std::vector<std::uint32_t>;

TEST(SceneReader, TakesStripsFansAndUnindexedLists) {
  json document = foreign();
  json& primitive = document["meshes"][0]["primitives"][0];
  EXPECT_EQ(read(document).meshes[0].primitives[0].indices, (Indices{0, 1, 2, 1, 3, 2}));
  primitive["mode"] = 6;
  EXPECT_EQ(read(document).meshes[0].primitives[0].indices, (Indices{1, 2, 0, 2, 3, 0}));
  primitive.erase("indices");
  primitive.erase("mode");
  EXPECT_EQ(read(document).meshes[0].primitives[0].indices, (Indices{0, 1, 2}));
  primitive["mode"] = 1;  // lines
  EXPECT_TRUE(read(document).meshes[0].primitives.empty());
}

TEST(SceneReader, UsesTheDefaultsOfGltf) {
  const Scene scene = read(foreign());
  ASSERT_EQ(scene.materials.size(), 1u);
  EXPECT_EQ(scene.materials[0].base_colour, glm::vec3(1));
  EXPECT_FALSE(scene.materials[0].double_sided);
  EXPECT_EQ(scene.nodes.at(0).kind, "");
  EXPECT_TRUE(scene.nodes[0].casts_shadow);
  EXPECT_EQ(scene.georeference.crs, "");
  EXPECT_TRUE(scene.features.empty());
}

TEST(SceneReader, JoinsTheTransformsOfAHierarchy) {
  json document = foreign();
  const double s = std::sqrt(0.5);
  document["nodes"] = {{{"children", {1}}, {"translation", {10, 0, 0}}},
                       {{"children", {2}}, {"rotation", {0, s, 0, s}}},  // a quarter turn: x to -z
                       {{"mesh", 0}, {"matrix", {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 1, 0, 0, 1}}}};
  const Scene scene = read(document);
  const glm::vec4 corner = scene.nodes.at(0).instances.at(0).to_model * glm::vec4(1, 1, 0, 1);
  EXPECT_NEAR(corner.x, 10, 1e-6);
  EXPECT_NEAR(corner.y, 2, 1e-6);
  EXPECT_NEAR(corner.z, -3, 1e-6);
  document.erase("scenes");  // allowed; the roots are the nodes without a parent
  document.erase("scene");
  EXPECT_EQ(read(document).nodes.size(), 1u);
}

TEST(SceneReader, ReadsQuantisedPositionsAndStrides) {
  json document = foreign(
      bytes_of<std::int16_t>({0, 0, 0, 99, 32767, 0, 0, 99, 0, -32767, 0, 99, 1, 2, 3, 99}) +
      std::string(16, '\0') + bytes_of<std::uint8_t>({0, 1, 2, 3}));
  document["extensionsRequired"] = {"KHR_mesh_quantization"};
  document["bufferViews"][0]["byteStride"] = 8;
  document["accessors"][0]["componentType"] = 5122;
  document["accessors"][0]["normalized"] = true;
  const Scene scene = read(document);
  EXPECT_EQ(scene.meshes[0].primitives[0].positions[1], glm::vec3(1, 0, 0));
  EXPECT_EQ(scene.meshes[0].primitives[0].positions[2], glm::vec3(0, -1, 0));
}

TEST(SceneReader, FindsBuffersBesideTheFile) {
  const TempFolder folder;
  json document = foreign();
  const std::string data =
      bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}) + bytes_of<std::uint8_t>({0, 1, 2, 3});
  test::write_text(folder / "a buffer.bin", data);
  document["buffers"][0]["uri"] = "a%20buffer.bin";
  test::write_text(folder / "file.gltf", document.dump());
  EXPECT_EQ(read_scene(folder / "file.gltf").meshes[0].primitives[0].positions[3],
            glm::vec3(1, 1, 0));
  std::filesystem::remove(folder / "a buffer.bin");
  EXPECT_THROW(read_scene(folder / "file.gltf"), Error);
}

TEST(SceneReader, RefusesDocumentsThatContradictThemselves) {
  const auto refused = [](auto&& spoil) {
    json document = foreign();
    spoil(document);
    EXPECT_THROW(read(document), Error) << document.dump().substr(0, 300);
  };
  const auto value_of_positions = [](float value) {
    return foreign(bytes_of<float>({0, 0, 0, 1, 0, 0, 0, value, 0, 1, 1, 0}) +
                   bytes_of<std::uint8_t>({0, 1, 2, 3}));
  };
  refused([&](json& d) { d = value_of_positions(std::numeric_limits<float>::quiet_NaN()); });
  refused([&](json& d) { d = value_of_positions(std::numeric_limits<float>::infinity()); });
  refused([](json& d) { d["asset"]["version"] = "1.0"; });
  refused([](json& d) { d.erase("asset"); });
  refused([](json& d) { d["extensionsRequired"] = {"KHR_from_the_future"}; });
  refused([](json& d) { d["buffers"][0]["byteLength"] = 53; });
  refused([](json& d) { d["buffers"][0]["uri"] = "data:application/octet-stream;base64,@@@@"; });
  refused([](json& d) { d["buffers"][0]["uri"] = "https://example.org/a.bin"; });
  refused([](json& d) { d["buffers"][0]["uri"] = "/etc/hostname"; });
  refused([](json& d) { d["buffers"][0]["uri"] = "../a.bin"; });
  refused([](json& d) { d["buffers"][0]["uri"] = "a/%2e%2e/../../b.bin"; });
  refused([](json& d) { d["buffers"][0].erase("uri"); });
  refused([](json& d) { d["bufferViews"][0]["byteOffset"] = 8; });
  refused([](json& d) { d["bufferViews"][0]["byteOffset"] = 18446744073709551615u; });
  refused([](json& d) { d["bufferViews"][0]["byteStride"] = 4; });
  refused([](json& d) { d["bufferViews"][0]["buffer"] = 7; });
  refused([](json& d) { d["accessors"][0]["count"] = 5; });
  refused([](json& d) { d["accessors"][0]["count"] = 18446744073709551615u; });
  refused([](json& d) { d["accessors"][0]["count"] = -1; });
  refused([](json& d) { d["accessors"][0]["count"] = 1e300; });
  refused([](json& d) { d["accessors"][0]["type"] = "VEC4"; });
  refused([](json& d) { d["accessors"][0]["componentType"] = 5130; });
  refused([](json& d) { d["accessors"][0]["bufferView"] = 9; });
  refused([](json& d) {
    d["accessors"][0] = {{"componentType", 5126}, {"count", 1e9}, {"type", "VEC3"}};
  });
  refused([](json& d) { d["accessors"][0]["byteOffset"] = 4; });
  refused([](json& d) { d["accessors"][0]["count"] = 3; });  // index 3 is then out of range
  refused([](json& d) { d["accessors"][1]["componentType"] = 5126; });
  refused([](json& d) { d["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = "zero"; });
  refused([](json& d) { d["meshes"][0]["primitives"][0]["material"] = 0; });
  refused([](json& d) { d["meshes"][0]["primitives"][0]["mode"] = 7; });
  refused([](json& d) { d["meshes"] = {{"primitives", 3}}; });
  refused([](json& d) { d["nodes"][0]["mesh"] = 1; });
  refused([](json& d) { d["nodes"][0]["children"] = {0}; });
  refused([](json& d) { d["nodes"][0]["children"] = {5}; });
  refused([](json& d) { d["nodes"][0]["translation"] = {0, 1}; });
  refused([](json& d) { d["nodes"][0]["translation"] = {1e300, 0, 0}; });
  refused([](json& d) { d["scenes"][0]["nodes"] = {0, 0}; });
  refused([](json& d) { d["scene"] = 4; });
  refused([](json& d) { d["materials"] = {{{"emissiveFactor", {1, 1, -1}}}}; });
}

// Two features, of which the square is the second; `change` changes the file.
json square_in_place(const std::function<void(json&)>& change = [](json&) {}) {
  json document = foreign();
  json& primitive = document["meshes"][0]["primitives"][0];
  primitive["mode"] = 4;
  const auto add = [&](const char* name, const std::string& data, int type, std::size_t count) {
    document["accessors"].push_back({{"bufferView", test::add_view(document, data)},
                                     {"componentType", type},
                                     {"count", count},
                                     {"type", "SCALAR"}});
    const std::size_t index = document["accessors"].size() - 1;
    if (std::string(name) == "indices")
      primitive["indices"] = index;
    else
      primitive["attributes"][name] = index;
  };
  add("indices", bytes_of<std::uint16_t>({0, 1, 2, 0, 2, 3}), 5123, 6);
  add("_FEATURE_ID_0", bytes_of<float>({1, 1, 1, 1}), 5126, 4);
  add("_LIGHT", bytes_of<float>({5, -1, 5, 5}), 5126, 4);
  change(document);
  return document;
}

// Whatever read_mesh refuses or has to convert is not read in place.
TEST(SceneReader, MapsMeshesThatAreFitAndNoOthers) {
  const TempFolder folder;
  const auto map = [&](const json& document) {
    test::write_text(folder / "file.gltf", document.dump());
    return SceneFile(folder / "file.gltf").map_mesh(0).has_value();
  };
  const auto replace = [](const char* attribute, const std::string& data) {
    return [attribute, data](json& document) {
      json& primitive = document["meshes"][0]["primitives"][0];
      const std::size_t accessor = std::string(attribute) == "indices"
                                       ? primitive["indices"].get<std::size_t>()
                                       : primitive["attributes"][attribute].get<std::size_t>();
      document["accessors"][accessor]["bufferView"] = test::add_view(document, data);
    };
  };
  EXPECT_TRUE(map(square_in_place()));
  SceneFile file(folder / "file.gltf");
  const auto mapped = file.map_mesh(0);
  ASSERT_TRUE(mapped);
  ASSERT_EQ(mapped->size(), 1u);
  const MappedPrimitive& square = *(*mapped)[0];
  EXPECT_EQ(square.triangles, 2u);
  EXPECT_EQ(square.corners(1), (std::array<std::uint32_t, 3>{0, 2, 3}));
  EXPECT_EQ(square.light(0), 5u);
  EXPECT_EQ(square.light(1), no_id);

  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  for (const auto& change : std::vector<std::function<void(json&)>>{
           replace("indices", bytes_of<std::uint16_t>({0, 1, 2, 0, 2, 4})),
           replace("POSITION", bytes_of<float>({0, 0, 0, 1, 0, nan, 0, 1, 0, 1, 1, 0})),
           replace("_LIGHT", bytes_of<float>({0, 0, 0, 1e7f})),
           replace("_LIGHT", bytes_of<float>({0, 0, nan, 0})),
           [](json& document) { document["accessors"][3]["count"] = 3; },  // of features
           [](json& document) { document["meshes"][0]["primitives"][0]["material"] = 0; }}) {
    const json document = square_in_place(change);
    EXPECT_FALSE(map(document));
    EXPECT_NE(test::refusal(document), "");
  }
  const json uncut = square_in_place([](json& document) { document["accessors"][2]["count"] = 5; });
  EXPECT_FALSE(map(uncut)) << "the last two corners are no triangle";
  EXPECT_FALSE(map(foreign())) << "a strip";
}

TEST(SceneReader, SurvivesNestingAndChainsOfAMillion) {
  const TempFolder folder;
  const std::size_t deep = 1'000'000;
  test::write_text(folder / "deep.gltf", R"({"asset":{"version":"2.0"},"extras":)" +
                                             std::string(deep, '[') + std::string(deep, ']') + "}");
  EXPECT_THROW(read_scene(folder / "deep.gltf"), Error);  // though it would ignore these members
  test::write_text(folder / "open.gltf", R"({"asset":)" + std::string(deep, '['));
  EXPECT_THROW(read_scene(folder / "open.gltf"), Error);

  json document = foreign();
  document["nodes"] = json::array();
  for (std::size_t i = 0; i < deep / 10; ++i) document["nodes"].push_back({{"children", {i + 1}}});
  document["nodes"].push_back({{"mesh", 0}});
  EXPECT_EQ(read(document).nodes.size(), 1u);
}

std::string ours(const TempFolder& folder, bool draco) {
  SceneWriter writer(folder / "ours.glb", {.draco = draco});
  writer.add_material({.name = "wall", .emission_cd_m2 = {1, 2, 3}});
  writer.add_feature({"a", "Building", "", 3.0, 1});
  SceneMesh mesh{"m", {test::field(6)}};
  mesh.primitives[0].feature_ids.assign(mesh.primitives[0].positions.size(), 0);
  mesh.primitives[0].light_ids.assign(mesh.primitives[0].positions.size(), 4);
  SceneNode node{"n", "lamp", writer.add_mesh(mesh), true, {}};
  for (std::uint32_t i = 0; i < 3; ++i) node.instances.push_back({glm::mat4(1), i});
  writer.add_node(node);
  writer.finish({"EPSG:25833", {1, 2, 3}, {"s"}, {"l"}});
  return test::read_text(folder / "ours.glb");
}

// Reads the file or gets an Error; any other exception ends the test program.
void must_not_fall(const std::filesystem::path& path, const std::string& bytes) {
  test::write_text(path, bytes);
  try {
    read_scene(path);
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos) << error.what();
  }
}

TEST(SceneReader, RefusesItsOwnFilesCutOffAtAnyByte) {
  const TempFolder folder;
  for (const bool draco : {false, true}) {
    const std::string whole = ours(folder, draco);
    for (std::size_t length = 0; length < whole.size(); length += 13) {
      test::write_text(folder / "cut.glb", std::string_view(whole).substr(0, length));
      EXPECT_THROW(read_scene(folder / "cut.glb"), Error) << length;
    }
  }
}

TEST(SceneReader, SurvivesDamage) {
  const TempFolder folder;
  std::mt19937 random(7);
  for (const bool draco : {false, true}) {
    const std::string whole = ours(folder, draco);
    for (int round = 0; round < 500; ++round) {
      std::string damaged = whole;
      for (int i = 0; i < 1 + round % 4; ++i)
        damaged[random() % damaged.size()] = static_cast<char>(random());
      must_not_fall(folder / "damaged.glb", damaged);
    }
  }
}

TEST(SceneReader, SaysWhatAFileOfAnotherKindIs) {
  const TempFolder folder;
  for (const char* content :
       {"", " ", "x", "glTF", "<CityModel/>", "[]", "null", "{}", "{\"asset\":{}}"}) {
    test::write_text(folder / "file", content);
    EXPECT_THROW(read_scene(folder / "file"), Error) << content;
  }
  EXPECT_THROW(read_scene(folder / "absent"), Error);
  EXPECT_THROW(read_scene(folder.path()), Error);
}

// Values copy themselves by recursion, which this would end by a signal.
TEST(SceneReader, RefusesJsonWithoutBottom) {
  const test::TempFolder folder;
  const std::string deep = std::string(200'000, '[') + std::string(200'000, ']');
  test::write_text(folder / "a.gltf", R"({"asset": {"version": "2.0", "extras": {"nightcity": )" +
                                          deep + R"(}}, "nodes": [{"extras": )" + deep + "}]}");
  try {
    read_scene(folder / "a.gltf");
    FAIL() << "read";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("nests"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace nightcity
