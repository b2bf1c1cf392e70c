// Tests the program from outside: commands, exit codes, messages, and the files that it leaves.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "formats/light_file.h"
#include "formats/scene_reader.h"
#include "support/process.h"
#include "support/temp_folder.h"
#include "tools/nightbake/sample_city.h"

namespace nightcity::nightbake {
namespace {

using nlohmann::json;
using test::nightbake;
using test::Outcome;
using test::TempFolder;
using test::write_text;

Outcome bake(const std::filesystem::path& recipe, const std::filesystem::path& out) {
  return nightbake("run '" + recipe.string() + "' --out '" + out.string() + "'");
}

json inspect(const std::filesystem::path& file) {
  const Outcome outcome = nightbake("inspect --json '" + file.string() + "'");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return json::parse(outcome.out);
}

// Expects a failure: its exit code, one line on stderr that contains `what`, nothing on stdout.
void expect_failure(const Outcome& outcome, int exit_code, const std::string& what) {
  EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_NE(outcome.err.find(what), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.out, "");
}

TEST(Nightbake, BakesTheSampleCityTrueToItsMeasures) {
  const TempFolder folder;
  const Outcome outcome = bake(test::write_sample(folder), folder / "out");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;

  const Scene scene = read_scene(folder / "out/city.glb");
  EXPECT_EQ(scene.georeference.crs, "EPSG:25833");
  std::size_t cubes = 0;
  for (const SceneFeature& feature : scene.features)
    if (feature.id == "cube") {
      ++cubes;
      EXPECT_EQ(feature.type, "Building");
      EXPECT_EQ(feature.measured_height_m, 10);
    }
  EXPECT_EQ(cubes, 1u);

  // The cube's corners, back in the CRS, and its surface by material.
  std::map<std::string, double> area;
  glm::dvec3 least(1e9), greatest(-1e9);
  for (const SceneNode& node : scene.nodes) {
    if (node.kind == "lamp" || node.kind == "horizon") continue;
    for (const ScenePrimitive& primitive : scene.meshes[node.mesh].primitives) {
      // Walls and roofs have a skin, which the name of the material ends with.
      std::string material = scene.materials[primitive.material].name;
      for (const char* kind : {"wall", "roof"})
        if (material.starts_with(kind)) material = kind;
      std::vector<glm::dvec3> places;
      for (const glm::vec3& p : primitive.positions)
        places.push_back(scene.georeference.from_model(
            glm::dvec3(node.instances.at(0).to_model * glm::vec4(p, 1))));
      for (std::size_t i = 0; i < primitive.indices.size(); i += 3) {
        const auto corner = [&](std::size_t k) { return places[primitive.indices[i + k]]; };
        area[material] += glm::length(glm::cross(corner(1) - corner(0), corner(2) - corner(0))) / 2;
      }
      if (material == "wall")
        for (const glm::dvec3& p : places) {
          least = glm::min(least, p);
          greatest = glm::max(greatest, p);
        }
    }
  }
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(least[i], (glm::dvec3(391000, 5819000, 35))[i], 1e-3);
    EXPECT_NEAR(greatest[i], (glm::dvec3(391010, 5819010, 45))[i], 1e-3);
  }
  EXPECT_NEAR(area["wall"], 400, 1e-3);
  EXPECT_NEAR(area["roof"], 100, 1e-3);
  EXPECT_NEAR(area["ground"], 100, 1e-3);
  // The ground, of which the map's street covers a part.
  EXPECT_GT(area["asphalt"], 100);
  EXPECT_NEAR(area["terrain"] + area["asphalt"] + area["paving stones"] + area["road marking"],
              3600, 1e-2);
}

TEST(Nightbake, PutsTheLampWhereTheMapHasItAndOnTheGround) {
  const TempFolder folder;
  test::write_sample(folder);
  ASSERT_EQ(bake(folder / "mapped.toml", folder / "out").exit_code, 0);
  const LightFile file = LightFile::open(folder / "out/city.lights");
  file.verify();
  ASSERT_EQ(file.lights().size(), 1u);  // the other lamp is outside the model
  const glm::dvec3 place = file.georeference().from_model(glm::dvec3(file.lights()[0].position));
  EXPECT_NEAR(place.x, 391020, 4) << "the luminaire hangs over the road, beside the post";
  EXPECT_NEAR(place.y, 5819010, 4);
  EXPECT_GT(place.z, 35 + 2);
  EXPECT_LT(place.z, 35 + 15);
  EXPECT_EQ(file.provenance()[0].source_id, 1u);

  // Its luminous ball in the scene is at the same place, names it and casts no shadow.
  const Scene scene = read_scene(folder / "out/city.glb");
  std::size_t balls = 0;
  for (const SceneNode& node : scene.nodes)
    for (const SceneInstance& instance : node.instances)
      if (instance.light != no_id) {
        ++balls;
        EXPECT_EQ(instance.light, 0u);
        EXPECT_FALSE(node.casts_shadow);
        EXPECT_LT(glm::distance(glm::vec3(instance.to_model[3]), file.lights()[0].position), 1e-3f);
        // Its material's luminance, over the ball's surface and all directions, is the lamp's flux.
        const auto& material = scene.materials[scene.meshes[node.mesh].primitives.at(0).material];
        const glm::dvec3 e(material.emission_cd_m2);
        const double luminance = 0.2126 * e.x + 0.7152 * e.y + 0.0722 * e.z,
                     radius = double{file.lights()[0].radius};
        const double pi = std::acos(-1.0);
        EXPECT_NEAR(luminance * 4 * pi * pi * radius * radius / double{file.lights()[0].flux_lm}, 1,
                    1e-3);
      }
  EXPECT_EQ(balls, 1u);
}

TEST(Nightbake, SameInputsGiveTheSameBytes) {
  const TempFolder folder;
  const auto recipe = test::write_sample(folder);
  ASSERT_EQ(bake(recipe, folder / "a").exit_code, 0);
  ASSERT_EQ(bake(recipe, folder / "b").exit_code, 0);
  for (const char* name : {"city.glb", "city.lights"})
    EXPECT_EQ(test::read_text(folder / "a" / name), test::read_text(folder / "b" / name)) << name;
}

TEST(Nightbake, BakesWithoutAMap) {
  const TempFolder folder;
  test::write_sample(folder);
  write_text(folder / "dark.toml", "[city]\nfiles = [\"city.gml\"]\n[windows]\nlit = false\n");
  ASSERT_EQ(bake(folder / "dark.toml", folder / "out").exit_code, 0);
  EXPECT_EQ(LightFile::open(folder / "out/city.lights").lights().size(), 0u);
  EXPECT_EQ(read_scene(folder / "out/city.glb").features.size(), 2u);
}

TEST(Nightbake, DracoKeepsTheTolerance) {
  const TempFolder folder;
  test::write_sample(folder);
  write_text(folder / "draco.toml",
             "[city]\nfiles = [\"city.gml\"]\n[output]\ndraco = true\ndraco_tolerance_m = "
             "0.005\n[windows]\nlit = false\n");
  ASSERT_EQ(bake(folder / "draco.toml", folder / "out").exit_code, 0);
  const json report = json::parse(test::read_text(folder / "out/bake_report.json"));
  EXPECT_GT(report["scene"]["draco_bits"], 0);
  EXPECT_LE(report["scene"]["draco_error_m"].get<double>(), 0.005 + 1e-4);
  const json holds = inspect(folder / "out/city.glb");
  EXPECT_EQ(holds["triangles"], 14 + report["horizon"]["triangles"].get<int>());
  EXPECT_NEAR(holds["bbox"][5].get<double>(), 45, 0.0051);
}

TEST(Nightbake, InspectTellsEveryKindInTheSameKeys) {
  const TempFolder folder;
  ASSERT_EQ(bake(test::write_sample(folder), folder / "out").exit_code, 0);
  const std::pair<const char*, const char*> files[]{{"city.gml", "citygml"},
                                                    {"map.osm", "osm"},
                                                    {"out/city.glb", "scene"},
                                                    {"out/city.lights", "lights"}};
  for (const auto& [name, kind] : files) {
    const json holds = inspect(folder / name);
    EXPECT_EQ(holds["kind"], kind);
    for (const char* key :
         {"buildings", "polygons", "triangles", "lights", "crs", "bbox", "skipped"})
      EXPECT_TRUE(holds.contains(key)) << kind << " " << key;
    EXPECT_TRUE(holds["lights"].is_object());
    EXPECT_TRUE(holds["skipped"].is_object());
    EXPECT_EQ(nightbake("inspect '" + (folder / name).string() + "'").exit_code, 0);
  }
  const json gml = inspect(folder / "city.gml"), osm = inspect(folder / "map.osm");
  EXPECT_EQ(gml["buildings"], 1);
  EXPECT_EQ(gml["polygons"], 8);
  EXPECT_EQ(gml["triangles"], 14);
  EXPECT_EQ(gml["crs"], "EPSG:25833");
  EXPECT_EQ(gml["bbox"], (std::vector<double>{390990, 5818980, 35, 391050, 5819040, 45}));
  EXPECT_EQ(osm["lights"]["lamp"], 2);
  EXPECT_EQ(osm["bbox"][0], 13.394162598);
  const json scene = inspect(folder / "out/city.glb"), lights = inspect(folder / "out/city.lights");
  EXPECT_EQ(scene["buildings"], 1);
  EXPECT_EQ(scene["crs"], "EPSG:25833");
  EXPECT_NEAR(scene["bbox"][3].get<double>(), 391050, 1e-2);
  EXPECT_GE(lights["lights"]["lamp"], 1);
  EXPECT_EQ(lights["crs"], "EPSG:25833");
}

TEST(Nightbake, HelpAndVersionSucceed) {
  for (const char* arguments :
       {"--help", "run --help", "inspect --help", "town --help", "--version"}) {
    const Outcome outcome = nightbake(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << arguments;
    EXPECT_NE(outcome.out, "") << arguments;
    EXPECT_EQ(outcome.err, "") << arguments;
  }
}

TEST(Nightbake, WrongUsageEndsWith2) {
  for (const char* arguments : {"", "fly", "run", "run recipe.toml", "inspect",
                                "inspect --colour x", "run a b c --out d", "-v -q town --out x"}) {
    const Outcome outcome = nightbake(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments << outcome.err;
    EXPECT_NE(outcome.err, "") << arguments;
  }
}

TEST(Nightbake, BrokenInputsEndWith1AndNameTheFile) {
  const TempFolder folder;
  test::write_sample(folder);
  ASSERT_EQ(bake(folder / "recipe.toml", folder / "out").exit_code, 0);
  const std::string glb = test::read_text(folder / "out/city.glb"), gml = test::sample_gml();
  const std::string lights = test::read_text(folder / "out/city.lights");
  write_text(folder / "empty", "");
  write_text(folder / "text", "Lorem ipsum dolor sit amet\n");
  write_text(folder / "cut.gml", gml.substr(0, gml.size() / 2));
  write_text(folder / "cut.osm", test::sample_osm().substr(0, 200));
  write_text(folder / "cut.glb", glb.substr(0, glb.size() / 2));
  write_text(folder / "cut.lights", lights.substr(0, lights.size() - 1));
  write_text(folder / "wrong.gml", "<html><body>CityModel</body></html>");
  for (const char* name : {"absent", "empty", "text", "cut.gml", "cut.osm", "cut.glb", "cut.lights",
                           "wrong.gml", "city.gml/x", "."}) {
    const std::string path = (folder / name).string();
    expect_failure(nightbake("inspect '" + path + "'"), 1, path);
    expect_failure(nightbake("inspect --json '" + path + "'"), 1, path);
  }
}

TEST(Nightbake, ABakeThatFailsLeavesNothing) {
  const TempFolder folder;
  test::write_sample(folder);
  const std::string gml = test::sample_gml();
  write_text(folder / "cut.gml", gml.substr(0, gml.size() / 2));
  write_text(folder / "empty.osm", "");
  const auto fails = [&](const std::string& recipe, int exit_code, const std::string& what) {
    write_text(folder / "bad.toml", recipe);
    expect_failure(bake(folder / "bad.toml", folder / "new"), exit_code, what);
    EXPECT_FALSE(std::filesystem::exists(folder / "new")) << recipe;
    // The same into a folder that exists already: it keeps its files and gets no others.
    std::filesystem::create_directory(folder / "old");
    write_text(folder / "old/city.glb", "mine");
    EXPECT_EQ(bake(folder / "bad.toml", folder / "old").exit_code, exit_code);
    EXPECT_EQ(test::read_text(folder / "old/city.glb"), "mine");
    std::filesystem::remove(folder / "old/city.glb");
    EXPECT_TRUE(std::filesystem::is_empty(folder / "old")) << recipe;
    std::filesystem::remove_all(folder / "old");
  };
  fails("[city]\nfiles = [\"absent.gml\"]\n", 1, "absent.gml");
  fails("[city]\nfiles = [\"cut.gml\"]\n", 1, "cut.gml");
  fails("[city]\nfiles = [\"map.osm\"]\n", 1, "map.osm");
  fails("[city]\nfiles = [\"city.gml\"]\n[osm]\nfiles = [\"absent.osm\"]\n", 1, "absent.osm");
  fails("[city]\nfiles = [\"city.gml\"]\n[osm]\nfiles = [\"empty.osm\"]\n", 1, "empty.osm");
  fails("[city]\nfiles = [\"city.gml\"]\n[osm]\nfiles = [\"city.gml\"]\n", 1, "city.gml");
  fails("[city]\nfiles = [\"city.gml\"]\ncrs = \"EPSG:1\"\n", 1, "EPSG:1");
}

TEST(Nightbake, ARecipesFaultsAreNamedByLine) {
  const TempFolder folder;
  test::write_sample(folder);
  const auto fails = [&](const std::string& recipe, int exit_code, const std::string& what) {
    write_text(folder / "bad.toml", recipe);
    expect_failure(bake(folder / "bad.toml", folder / "new"), exit_code, what);
    EXPECT_FALSE(std::filesystem::exists(folder / "new")) << recipe;
  };
  fails("[city]\nflies = [\"city.gml\"]\n", 2,
        ".toml:2: unknown key [city] flies; did you mean \"files\"?");
  fails("[city]\nfiles = [\"city.gml\"]\n\n[ciy]\n", 2,
        ".toml:4: unknown table [ciy]; did you mean \"city\"?");
  fails("[city]\nfiles = [\"city.gml\"]\ntile_m = \"wide\"\n", 2,
        ".toml:3: [city] tile_m is not a number");
  fails("[city]\nfiles = [\"city.gml\"]\ntile_m = -4\n", 2, ".toml:3: ");
  fails("[city]\nfiles = [\"city.gml\"]\nreader = \"fast\"\n", 2, ".toml:3: ");
  fails("[city]\nfiles = 3\n", 2, ".toml:2: ");
  fails("[city]\nfiles = []\n", 2, ".toml:2: ");
  fails("", 2, "names no city");
  fails("[city\n", 1, ".toml:1: ");
  EXPECT_EQ(bake(folder / "absent.toml", folder / "new").exit_code, 1);
  EXPECT_EQ(bake(folder / "city.gml", folder / "new").exit_code, 1);
}

TEST(Nightbake, AnOutputFolderThatCannotBeIsSaidAtOnce) {
  const TempFolder folder;
  const auto recipe = test::write_sample(folder);
  write_text(folder / "file", "x");
  expect_failure(bake(recipe, folder / "file"), 1, "file");
  expect_failure(bake(recipe, folder / "file/below"), 1, "file/below");
  std::filesystem::create_directories(folder / "taken/city.glb");
  expect_failure(bake(recipe, folder / "taken"), 1, "city.glb");
  std::size_t entries = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder / "taken"))
    ++entries;
  EXPECT_EQ(entries, 1u);
}

}  // namespace
}  // namespace nightcity::nightbake
