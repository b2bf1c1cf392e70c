// Scenes whose files hold their hierarchies, as nightbake writes them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

#include "formats/gltf_samples.h"
#include "formats/hierarchy/static_builder.h"
#include "formats/scene_reader.h"
#include "formats/scene_samples.h"
#include "formats/scene_writer.h"
#include "formats/stored_hierarchy_writer.h"
#include "runtime/scene/parts.h"
#include "runtime/scene/render_scene.h"
#include "runtime/scene/trace_ray.h"
#include "support/scenes.h"
#include "support/temp_folder.h"

namespace nightcity::test {
namespace {

namespace fs = std::filesystem;

// A town, moved and turned; panes that cast no shadow; posts with lights, of which each copy is
// stored; and trees. One triangle has no area. `draco` stores other triangles in another order. The
// walls of the town are at `angle_deg` to its axes.
void write_town(const fs::path& glb, bool draco = false, const glm::vec3& place = {120, 3, -70},
                float angle_deg = 0, bool with_flat = true) {
  SceneWriter writer(glb, {draco, 0.01});
  writer.add_material({.name = "wall"});
  SceneMesh town{"town", turned(random_town(60, 50, 3), angle_deg).scene().meshes[0].primitives};
  std::vector<std::uint32_t>& indices = town.primitives[0].indices;
  if (with_flat) indices.insert(indices.end(), {0, 0, 1});
  const SceneMesh post{"post",
                       SceneBuilder().box({-1, 0, -1}, {1, 4, 1}).scene().meshes[0].primitives};
  SceneInstance here, there;
  here.to_model[3] = glm::vec4(place, 1);
  there.to_model[0] = {0, 0, -1, 0};
  there.to_model[2] = {1, 0, 0, 0};
  there.to_model[3] = glm::vec4(place + glm::vec3(130, 0, 0), 1);
  SceneNode posts{"posts", "lamp", 1, false, {}}, trees{"trees", "tree", 2, true, {}};
  for (std::uint32_t i = 0; i < 5; ++i) {
    SceneInstance& instance = posts.instances.emplace_back(here);
    instance.to_model[3].x += float(i) * 9;
    instance.light = i;
    trees.instances.push_back(there);
    trees.instances.back().to_model[3].z += float(i) * 9;
  }
  writer.add_node({"town", "city", writer.add_mesh(town), true, {here}});
  writer.add_mesh(post);
  writer.add_node(posts);
  writer.add_mesh({"tree", {field(30)}});
  writer.add_node({"other town", "city", 0, true, {there}});
  writer.add_node({"panes", "window", writer.add_mesh({"panes", {field(200)}}), false, {here}});
  writer.add_node(trees);
  writer.finish({});
}

void store(const fs::path& glb) {
  const auto built = hierarchy::build_static_hierarchies(glb, false, 2);
  ASSERT_EQ(built.size(), 2u) << "what casts shadows, and the rest";
  std::vector<StoredHierarchy> described;
  for (const hierarchy::BuiltHierarchy& one : built) described.push_back(one.description);
  ASSERT_TRUE(store_hierarchies(glb, described));
}

// Everything but the hierarchies is the same, and rays hit the same: of two triangles in one plane
// the first that is met.
void expect_alike(const scene::RenderScene& a, const scene::RenderScene& b) {
  ASSERT_EQ(a.triangles.size(), b.triangles.size());
  for (std::size_t i = 0; i < a.triangles.size(); ++i) {
    const gpu::Triangle of_a = a.triangles[i], of_b = b.triangles[i];
    ASSERT_EQ(std::memcmp(&of_a, &of_b, sizeof of_a), 0) << i;
  }
  EXPECT_EQ(a.dropped_triangles, b.dropped_triangles);
  EXPECT_EQ(a.instances.size(), b.instances.size());
  EXPECT_EQ(a.nodes.size(), b.nodes.size());
  for (const scene::RenderScene* scene : {&a, &b}) {
    std::vector<bool> is_in_leaf(scene->triangles.size());
    for (const std::uint32_t triangle : scene->triangle_order) is_in_leaf.at(triangle) = true;
    EXPECT_EQ(std::ranges::count(is_in_leaf, false), 0);
  }
  EXPECT_EQ(a.bounds.lower, b.bounds.lower);
  EXPECT_EQ(a.bounds.upper, b.bounds.upper);
  std::mt19937 random(4);
  const auto uniform = [&](float from, float to) {
    return from + (to - from) * float(random() >> 8) / 16777216.0f;
  };
  const glm::vec3 size = a.bounds.upper - a.bounds.lower;
  int hits = 0;
  for (int i = 0; i < 3000; ++i) {
    glm::dvec3 origin, direction;
    for (int axis = 0; axis < 3; ++axis) {
      origin[axis] = a.bounds.lower[axis] + uniform(0, size[axis]);
      direction[axis] = uniform(-1, 1);
    }
    const std::uint32_t mask = i % 2 ? MASK_SHADOW : MASK_VISIBLE;
    const auto of_a = scene::trace_ray(a, origin, direction, 1e30, mask),
               of_b = scene::trace_ray(b, origin, direction, 1e30, mask);
    ASSERT_EQ(of_a.has_value(), of_b.has_value());
    if (!of_a) continue;
    ++hits;
    ASSERT_EQ(of_a->distance, of_b->distance);
    if (of_a->triangle != of_b->triangle) {
      ASSERT_NEAR(glm::dot(of_a->normal, of_b->normal), 1, 1e-6);
    }
  }
  EXPECT_GT(hits, 1000);
}

bool is_said(const scene::RenderScene& scene, const std::string& words) {
  for (const std::string& sentence : describe_left_out(scene))
    if (sentence.find(words) != std::string::npos) return true;
  return false;
}

TEST(StoredHierarchies, ChangeNothingThatARayHits) {
  for (const bool draco : {false, true}) {
    const TempFolder folder;
    write_town(folder / "a.glb", draco);
    fs::copy_file(folder / "a.glb", folder / "b.glb");
    store(folder / "b.glb");
    const scene::RenderScene without = scene::load_render_scene(folder / "a.glb"),
                             with = scene::load_render_scene(folder / "b.glb");
    EXPECT_EQ(without.stored_hierarchies, 0u);
    EXPECT_EQ(with.stored_hierarchies, 2u);
    EXPECT_EQ(describe_left_out(with), describe_left_out(without));
    EXPECT_GT(with.triangle_order.size(), with.triangles.size()) << "walls are cut";
    expect_alike(without, with);
  }
}

TEST(StoredHierarchies, ChangeNothingInATownAtAnAngle) {
  const TempFolder folder;
  write_town(folder / "a.glb", false, {120, 3, -70}, 27);
  fs::copy_file(folder / "a.glb", folder / "b.glb");
  store(folder / "b.glb");
  const scene::RenderScene without = scene::load_render_scene(folder / "a.glb"),
                           with = scene::load_render_scene(folder / "b.glb");
  EXPECT_EQ(with.stored_hierarchies, 2u);
  EXPECT_NEAR(std::abs(with.boxes_along.y), std::sin(glm::radians(27.0f)), 0.01);
  EXPECT_NEAR(std::abs(without.boxes_along.y), std::sin(glm::radians(27.0f)), 0.01);
  EXPECT_GT(with.triangle_order.size(), with.triangles.size()) << "walls are cut";
  expect_alike(without, with);
}

TEST(StoredHierarchies, AreTheSameBytesForAnyNumberOfThreads) {
  const TempFolder folder;
  write_town(folder / "a.glb");
  const auto one = hierarchy::build_static_hierarchies(folder / "a.glb", false, 1),
             many = hierarchy::build_static_hierarchies(folder / "a.glb", false, 8);
  ASSERT_EQ(one.size(), many.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].encoded.topology, many[i].encoded.topology);
    EXPECT_EQ(one[i].encoded.order, many[i].encoded.order);
    EXPECT_TRUE(std::ranges::equal(one[i].description.cuts, many[i].description.cuts));
    EXPECT_EQ(one[i].description.area_m2, many[i].description.area_m2);
  }
}

// A second call replaces what the first one stored.
TEST(StoredHierarchies, AreStoredBesideAllThatWasThere) {
  const TempFolder folder;
  write_town(folder / "a.glb");
  const Scene before = read_scene(folder / "a.glb");
  for (int i = 0; i < 2; ++i) {
    store(folder / "a.glb");
    const Scene after = read_scene(folder / "a.glb");
    EXPECT_EQ(after.skipped, before.skipped);
    ASSERT_EQ(after.meshes.size(), before.meshes.size());
    for (std::size_t m = 0; m < after.meshes.size(); ++m) {
      EXPECT_EQ(after.meshes[m].primitives[0].positions, before.meshes[m].primitives[0].positions);
      EXPECT_EQ(after.meshes[m].primitives[0].indices, before.meshes[m].primitives[0].indices);
    }
    EXPECT_EQ(after.nodes.size(), before.nodes.size());
    EXPECT_EQ(SceneFile(folder / "a.glb").hierarchies().size(), 2u);
  }
}

// What a user leaves out, or a frame of its own, is no fault of the file's, and nothing is said.
TEST(StoredHierarchies, AreBuiltWhereSomethingIsLeftOut) {
  const TempFolder folder;
  write_town(folder / "a.glb");
  fs::copy_file(folder / "a.glb", folder / "b.glb");
  store(folder / "b.glb");
  for (const scene::Part part :
       {scene::Part::windows, scene::Part::lamp_bodies, scene::Part::trees}) {
    scene::PartSet left_out;
    left_out.set(static_cast<std::size_t>(part));
    const scene::RenderScene without = scene::load_render_scene(folder / "a.glb", left_out),
                             with = scene::load_render_scene(folder / "b.glb", left_out);
    EXPECT_EQ(with.stored_hierarchies, 1u) << "the other one";
    EXPECT_EQ(describe_left_out(with), describe_left_out(without));
    expect_alike(without, with);
  }
}

TEST(StoredHierarchies, AreBuiltInAFrameOfItsOwn) {
  const TempFolder folder;
  write_town(folder / "far.glb", false, {3e6f, 0, 0});
  store(folder / "far.glb");
  const scene::RenderScene far = scene::load_render_scene(folder / "far.glb");
  EXPECT_NE(far.origin, glm::dvec3(0));
  EXPECT_EQ(far.stored_hierarchies, 0u);
  EXPECT_FALSE(is_said(far, "hierarchy"));
}

TEST(StoredHierarchies, OfAnotherSceneAreBuiltAndSaid) {
  const TempFolder folder;
  write_town(folder / "a.glb");
  const auto built = hierarchy::build_static_hierarchies(folder / "a.glb", false, 2);
  const scene::RenderScene without = scene::load_render_scene(folder / "a.glb");
  const auto expect_said = [&](const std::function<void(StoredHierarchy&)>& change,
                               const char* words) {
    StoredHierarchy changed = built[0].description;
    change(changed);
    const std::vector<StoredHierarchy> described{changed, built[1].description};
    ASSERT_TRUE(store_hierarchies(folder / "a.glb", described));
    const scene::RenderScene with = scene::load_render_scene(folder / "a.glb");
    EXPECT_EQ(with.stored_hierarchies, 1u) << "the other one";
    EXPECT_TRUE(is_said(with, words)) << words;
    expect_alike(without, with);
  };
  expect_said([](StoredHierarchy& h) { h.nodes.pop_back(); }, "other nodes");
  expect_said([](StoredHierarchy& h) { h.nodes.push_back(4'000'000'000u); }, "other nodes");
  expect_said([](StoredHierarchy& h) { std::swap(h.nodes[0], h.nodes[1]); }, "other nodes");
  expect_said([](StoredHierarchy& h) { h.triangles += 1; }, "another number");
  expect_said([](StoredHierarchy& h) { h.upper.x += 1; }, "another box");
  expect_said([](StoredHierarchy& h) { h.area_m2 /= 2; }, "larger");
  expect_said([](StoredHierarchy& h) { h.order = h.order.first(h.order.size() - 4); }, "fewer");
  expect_said([](StoredHierarchy& h) { h.topology = h.topology.first(3); }, "within one");
  expect_said([](StoredHierarchy& h) { h.cuts = h.cuts.first(h.cuts.size() - 8); },
              "more triangles");
  expect_said([](StoredHierarchy& h) { h.cuts = {}; }, "more triangles");
}

// The same scene as a .gltf, to be changed.
json as_gltf(const fs::path& glb) {
  const std::string bytes = read_text(glb);
  const auto word = [&](std::size_t at) {
    std::uint32_t value;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
  };
  const std::size_t text = word(12), binary = 20 + text + 8;
  json document = json::parse(bytes.substr(20, text));
  document["buffers"][0]["uri"] =
      "data:application/octet-stream;base64," +
      base64(bytes.substr(binary, document["buffers"][0]["byteLength"].get<std::size_t>()));
  return document;
}

TEST(StoredHierarchies, ThatAreDescribedWronglyAreBuiltAndSaid) {
  const TempFolder folder;
  write_town(folder / "a.glb");
  const scene::RenderScene without = scene::load_render_scene(folder / "a.glb");
  store(folder / "a.glb");
  const json right = as_gltf(folder / "a.glb");
  const auto load = [&](const json& document) {
    write_text(folder / "b.gltf", document.dump());
    return scene::load_render_scene(folder / "b.gltf");
  };
  EXPECT_EQ(load(right).stored_hierarchies, 2u);
  for (const auto& change : std::vector<std::function<void(json&, json&)>>{
           [](json&all, json&) { all = 5; },
           [](json&all, json&) { all["hierarchies"] = "none"; },
           [](json&, json&first) { first = json::array(); },
           [](json&, json&first) { first.erase("nodes"); },
           [](json&, json&first) { first["nodes"][0] = -1; },
           [](json&, json&first) { first["nodes"][0] = "town"; },
           [](json&, json&first) { first.erase("triangles"); },
           [](json&, json&first) { first["triangles"] = 1.5; },
           [](json&, json&first) { first["triangles"] = 1e20; },
           [](json&, json&first) { first.erase("min"); },
           [](json&, json&first) {
             first["max"] = {1, 2};
           },
           [](json&, json&first) {
             first["max"] = {1, 2, 1e300};
           },
           [](json&, json&first) { first["along"] = 1; },
           [](json&, json&first) {
             first["along"] = {1, 1};
           },
           [](json&, json&first) {
             first["along"] = {"east", 0};
           },
           [](json&, json&first) { first.erase("area"); },
           [](json&, json&first) { first["area"] = "large"; },
           [](json&, json&first) { first.erase("order"); },
           [](json&, json&first) { first["order"] = 1000; },
           [](json&, json&first) { first["topology"] = 1000; },
           [](json&, json&first) { first["topology"] = -1; },
           [](json&, json&first) { first["castsShadow"] = "no"; },
           [](json&, json&first) { first["castsShadow"] = false; },  // as in the second one
       }) {
    json wrong = right;
    json& all = wrong["extensions"]["NIGHTCITY_hierarchy"];
    change(all, all["hierarchies"][0]);
    const scene::RenderScene with = load(wrong);
    EXPECT_EQ(with.stored_hierarchies, 0u);
    EXPECT_TRUE(is_said(with, "NIGHTCITY_hierarchy")) << all.dump();
    ASSERT_EQ(with.triangles.size(), without.triangles.size());
  }
  json cut = right;
  const std::size_t view =
      cut["extensions"]["NIGHTCITY_hierarchy"]["hierarchies"][0]["order"].get<std::size_t>();
  cut["bufferViews"][view]["byteLength"] = 1u << 30;
  EXPECT_TRUE(is_said(load(cut), "NIGHTCITY_hierarchy"));
}

// Returns what a user gets: the triangles and what is said of the scene, or the error.
std::string describe(const fs::path& file) {
  try {
    const scene::RenderScene scene = scene::load_render_scene(file);
    std::string text = std::to_string(scene.triangles.size()) + " triangles";
    for (const std::string& sentence : describe_left_out(scene))
      if (sentence.find("hierarchy") == std::string::npos) text += "; " + sentence;
    return text;
  } catch (const Error& error) {
    return std::string(error.what()).substr(file.string().size());
  }
}

// Returns where the binary chunk of a .glb begins, behind its JSON.
std::size_t find_binary(const std::string& glb) {
  std::uint32_t json_bytes;
  std::memcpy(&json_bytes, glb.data() + 12, sizeof json_bytes);
  return 20 + json_bytes + 8;
}

// Triangles of a file with hierarchies are looked at while these are measured, and not before. What
// is wrong with one must be told all the same, as if there were no hierarchies.
TEST(StoredHierarchies, HideNoFaultOfTheirTriangles) {
  const TempFolder folder;
  const fs::path plain = folder / "plain.glb", stored = folder / "stored.glb", a = folder / "a.glb",
                 b = folder / "b.glb";
  write_town(plain, false, {120, 3, -70}, 0, false);
  fs::copy_file(plain, stored);
  store(stored);
  EXPECT_EQ(scene::load_render_scene(stored).stored_hierarchies, 2u);
  const json document = as_gltf(stored);
  const json& primitive = document["meshes"][0]["primitives"][0];
  const auto place_of = [&](const json& accessor) {
    return document["bufferViews"][document["accessors"][accessor.get<std::size_t>()]["bufferView"]
                                       .get<std::size_t>()]
        .value("byteOffset", std::size_t{0});
  };
  const std::size_t position = place_of(primitive["attributes"]["POSITION"]),
                    index = place_of(primitive["indices"]);
  const auto expect_told = [&](std::size_t place, const auto& value, const std::string& words) {
    for (const auto& [from, to] : {std::pair(plain, a), std::pair(stored, b)}) {
      std::string bytes = read_text(from);
      std::memcpy(bytes.data() + find_binary(bytes) + place, &value, sizeof value);
      write_text(to, bytes);
    }
    const std::string told = describe(b);
    EXPECT_EQ(told, describe(a));
    EXPECT_NE(told.find(words), std::string::npos) << told;
  };
  constexpr float infinite = std::numeric_limits<float>::infinity();
  expect_told(position + 12 * 7, std::numeric_limits<float>::quiet_NaN(), "is not finite");
  expect_told(position + 12 * 7, infinite, "is not finite");
  expect_told(position + 12 * 7, 1e16f, "left out, without area or beyond");
  expect_told(index + 2 * 9, std::uint16_t{0xFFFF}, "index 65535");
  const std::string bytes = read_text(plain);
  std::uint16_t second;
  std::memcpy(&second, bytes.data() + find_binary(bytes) + index + 2, sizeof second);
  expect_told(index, second, "2 triangles are left out, without area");  // the town stands twice
  std::mt19937 random(8);
  for (int i = 0; i < 40; ++i) {
    const float value =
        std::array{0.0f, 1e16f, -3e38f, infinite, 1e-30f, std::nanf("")}[random() % 6];
    expect_told(position + 4 * (random() % 1000), value, "");
    expect_told(index + 2 * (random() % 500), static_cast<std::uint16_t>(random()), "");
  }
}

}  // namespace
}  // namespace nightcity::test
