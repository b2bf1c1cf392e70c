#include "runtime/scene/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>

#include "formats/error.h"
#include "runtime/scene/brute_force.h"
#include "support/scenes.h"

namespace nightcity::test {
namespace {

TEST(Camera, AxesAreRightHandedAndOfUnitLength) {
  const gpu::Camera camera = scene::make_camera({{1, 2, 3}, {-4, 1, 9}, {0, 1, 0}, 50}, 1.5f);
  EXPECT_NEAR(glm::length(camera.right), 1, 1e-6);
  EXPECT_NEAR(glm::length(camera.up), 1, 1e-6);
  EXPECT_NEAR(glm::length(glm::cross(camera.forward, camera.right) + camera.up), 0, 1e-5);
  EXPECT_NEAR(camera.tan_half_height, std::tan(25 * 3.14159265 / 180), 1e-6);
}

TEST(Camera, RefusesWhatIsNoView) {
  EXPECT_THROW(scene::make_camera({{1, 1, 1}, {1, 1, 1}, {0, 1, 0}, 50}, 1), Error);
  EXPECT_THROW(scene::make_camera({{0, 5, 0}, {0, 0, 0}, {0, 1, 0}, 50}, 1),
               Error);  // up along the view
  EXPECT_THROW(scene::make_camera({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0}, 1), Error);
  EXPECT_THROW(scene::make_camera({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 180}, 1), Error);
}

TEST(Camera, UpMayHaveAnyLength) {
  for (const float length : {1e-44f, 1e-30f, 1.0f, 1e30f, 3e38f}) {
    const gpu::Camera camera = scene::make_camera({{0, 2, 5}, {0, 1, 0}, {0, length, 0}, 60}, 1.5f);
    EXPECT_NEAR(camera.right.x, 1, 1e-6f) << length;
    EXPECT_NEAR(glm::length(camera.up), 1, 1e-6f) << length;
  }
}

TEST(Camera, FilesRoundTrip) {
  const auto file = std::filesystem::temp_directory_path() / "nightcity_camera_test.json";
  const scene::CameraPose pose{{1.5f, 2.25f, -3}, {4, 5, 6}, {0, 0, -1}, 33};
  scene::write_camera(file, pose);
  const scene::CameraPose back = scene::find_camera(file.string(), scene::RenderScene{});
  EXPECT_EQ(back.position, pose.position);
  EXPECT_EQ(back.target, pose.target);
  EXPECT_EQ(back.up, pose.up);
  EXPECT_EQ(back.fov_deg, pose.fov_deg);
  std::filesystem::remove(file);
}

TEST(Camera, BrokenFilesAreNamed) {
  const auto file = std::filesystem::temp_directory_path() / "nightcity_broken_camera.json";
  for (const char* text : {"", "{", "{}", "{\"position\": [1, 2], \"target\": [1, 2, 3]}",
                           "{\"position\": [1, 2, \"x\"], \"target\": [1, 2, 3]}",
                           "{\"position\": [1e99, 2, 3], \"target\": [1, 2, 3]}"}) {
    std::ofstream(file) << text;
    try {
      scene::find_camera(file.string(), scene::RenderScene{});
      FAIL() << "accepted: " << text;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(file.string()), std::string::npos) << error.what();
    }
  }
  std::filesystem::remove(file);
  EXPECT_THROW(scene::find_camera("no-such-preset", scene::RenderScene{}), Error);
}

TEST(Camera, StreetStandsOnTheGroundUnderALampAndOutsideWalls) {
  const scene::RenderScene scene = random_town(40, 80, 5).with(random_lamps(60, 80, 6));
  const scene::CameraPose pose = scene::find_camera("street", scene);
  const auto below =
      scene::brute_force_hit(scene, glm::dvec3(pose.position), {0, -1, 0}, 100, MASK_SHADOW);
  ASSERT_TRUE(below);
  EXPECT_NEAR(*below, 1.7, 0.3);
}

TEST(Camera, PresetsWorkWithoutLightsAndWithoutAnything) {
  for (const std::string& preset : scene::camera_presets()) {
    EXPECT_NO_THROW(
        scene::make_camera(scene::find_camera(preset, SceneBuilder().ground(10).with({})), 1.5f))
        << preset;
    EXPECT_NO_THROW(scene::make_camera(scene::find_camera(preset, scene::RenderScene{}), 1.5f))
        << preset;
  }
}

}  // namespace
}  // namespace nightcity::test
