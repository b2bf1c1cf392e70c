#include "formats/light_edits.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "formats/error.h"
#include "support/temp_folder.h"

namespace nightcity {
namespace {

Light lamp(std::uint32_t id) {
  Light light{};
  light.axis = {0, -1, 0};
  light.tangent = {1, 0, 0};
  light.flux_lm = 3000;
  light.id = id;
  return light;
}

TEST(LightEdits, GoToAFileAndBack) {
  const test::TempFolder folder;
  LightEdits edits;
  edits[0x1a2b].flux_lm = 1234.5;
  edits[0xffffffff].is_off = true;
  edits[7].aim = glm::vec3(0, 1, 0);
  write_light_edits(folder / "city.edits.json", edits);
  EXPECT_EQ(read_light_edits(folder / "city.edits.json"), edits);
  write_light_edits(folder / "city.edits.json", {});
  EXPECT_TRUE(read_light_edits(folder / "city.edits.json").empty());
}

TEST(LightEdits, ChangeTheLightsTheyNameAndCountTheOthers) {
  std::array<Light, 3> lights{lamp(1), lamp(2), lamp(3)};
  LightEdits edits;
  edits[1].flux_lm = 500;
  edits[2].is_off = true;
  edits[9].is_off = true;
  EXPECT_EQ(apply_edits(edits, lights), 1u);
  EXPECT_EQ(lights[0].flux_lm, 500);
  EXPECT_EQ(lights[1].flux_lm, 0);
  EXPECT_EQ(lights[2].flux_lm, 3000);
}

// East, north, up become x, -z, y.
TEST(LightEdits, AimTheAxisAndKeepTheTangentPerpendicular) {
  for (const glm::vec3 aim : {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, -1),
                              glm::vec3(0.6f, 0, -0.8f), glm::vec3(-1, 0, 0)}) {
    Light light = lamp(1);
    LightEdit edit;
    edit.aim = aim;
    apply_edit(edit, light);
    EXPECT_NEAR(glm::distance(light.axis, glm::vec3(aim.x, aim.z, -aim.y)), 0, 1e-6);
    EXPECT_NEAR(glm::dot(light.axis, light.tangent), 0, 1e-6);
    EXPECT_NEAR(glm::length(light.tangent), 1, 1e-6);
  }
}

TEST(LightEdits, BrokenFilesAreRefusedWithFileAndPlace) {
  const test::TempFolder folder;
  const auto error_of = [&](const std::string& text) -> std::string {
    test::write_text(folder / "e.json", text);
    try {
      read_light_edits(folder / "e.json");
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  for (const char* text :
       {"", "[]", "{}", "{\"lights\": 3}", "{\"version\": 2, \"lights\": []}", "{\"lights\": [3]}",
        "{\"lights\": [{\"flux_lm\": 3}]}", "{\"lights\": [{\"id\": \"xyz\"}]}",
        "{\"lights\": [{\"id\": \"123456789\"}]}",
        "{\"lights\": [{\"id\": \"1\", \"flux_lm\": 0}]}",
        "{\"lights\": [{\"id\": \"1\", \"flux_lm\": -3}]}",
        "{\"lights\": [{\"id\": \"1\", \"flux_lm\": 1e300}]}",
        "{\"lights\": [{\"id\": \"1\", \"aim\": [0, 0, 0]}]}",
        "{\"lights\": [{\"id\": \"1\", \"aim\": [0, 1]}]}",
        "{\"lights\": [{\"id\": \"1\", \"dim\": 3}]}",
        "{\"lights\": [{\"id\": \"1\"}, {\"id\": \"01\"}]}"}) {
    const std::string error = error_of(text);
    EXPECT_NE(error.find("e.json"), std::string::npos) << text << error;
  }
  EXPECT_NE(
      error_of("{\"lights\": [{\"id\": \"1\"}, {\"id\": \"2\", \"off\": 1}]}").find("lights[1]"),
      std::string::npos);
  EXPECT_THROW(read_light_edits(folder / "missing.json"), Error);
}

}  // namespace
}  // namespace nightcity
