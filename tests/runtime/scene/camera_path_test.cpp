// Camera paths.
#include "runtime/scene/camera_path.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "formats/error.h"
#include "support/scenes.h"
#include "support/temp_folder.h"

namespace nightcity::test {
namespace {

scene::CameraPose at(const glm::vec3& position) {
  return {position, {0, 0, 0}, {0, 1, 0}, 50};
}

TEST(CameraPath, PassesThroughItsPosesInOrder) {
  const std::vector<glm::vec3> places{{0, 5, 10}, {4, 6, 9}, {9, 2, 1}, {8, 8, -7}};
  std::vector<scene::CameraPose> poses;
  for (const glm::vec3& place : places) poses.push_back(at(place));
  const scene::CameraPath path(poses);
  for (std::size_t i = 0; i < places.size(); ++i)
    EXPECT_LT(glm::distance(path.at(double(i) / 3).position, places[i]), 1e-5f) << i;
  EXPECT_EQ(path.at(-1).position, path.at(0).position);
  EXPECT_EQ(path.at(2).position, path.at(1).position);
}

TEST(CameraPath, IsStraightBetweenTwoPosesAndStillAtOne) {
  const scene::CameraPath line({at({0, 5, 0.1f}), at({10, 5, 0.1f})});
  for (const double u : {0.1, 0.5, 0.8}) {
    EXPECT_NEAR(line.at(u).position.y, 5, 1e-5);
    EXPECT_NEAR(line.at(u).position.z, 0.1, 1e-5);
  }
  EXPECT_EQ(scene::CameraPath({at({1, 2, 3})}).at(0.7).position, glm::vec3(1, 2, 3));
  EXPECT_THROW(scene::CameraPath({}), Error);
}

TEST(CameraPath, AnOrbitKeepsHeightAndDistance) {
  const scene::RenderScene scene = random_town(30, 50, 3).with(random_lamps(50, 40, 2));
  const scene::CameraPath path = scene::find_path("orbit", scene);
  const scene::CameraPose first = path.at(0);
  for (double u = 0; u <= 1; u += 0.05) {
    const scene::CameraPose pose = path.at(u);
    EXPECT_EQ(pose.target, first.target);
    EXPECT_NEAR(pose.position.y, first.position.y, 1e-3f);
    EXPECT_NEAR(
        glm::distance(pose.position, pose.target) / glm::distance(first.position, first.target), 1,
        0.01);
  }
}

TEST(CameraPath, PresetsSeeSomething) {
  const scene::RenderScene scene = random_town(30, 50, 3).with(random_lamps(50, 40, 2));
  for (const std::string& name : scene::path_presets())
    for (const double u : {0.0, 0.5, 1.0})
      EXPECT_NO_THROW(scene::make_camera(scene::find_path(name, scene).at(u), 1)) << name;
}

TEST(CameraPath, AFileHoldsPosesAndABrokenOneIsRefused) {
  const TempFolder folder;
  const scene::RenderScene scene = SceneBuilder().ground(10).with({});
  write_text(folder / "good.json", R"({"poses": [{"position": [0, 5, 5], "target": [0, 0, 0]},
                                                 {"position": [5, 5, 5], "target": [0, 0, 0], "fov_deg": 30}]})");
  EXPECT_EQ(scene::find_path((folder / "good.json").string(), scene).at(1).fov_deg, 30);
  write_text(folder / "none.json", R"({"poses": []})");
  write_text(folder / "blind.json", R"({"poses": [{"position": [0, 5, 5], "target": [0, 5, 5]}]})");
  write_text(folder / "text.json", "poses");
  for (const char* name : {"none.json", "blind.json", "text.json", "missing.json"})
    EXPECT_THROW(scene::find_path((folder / name).string(), scene), Error) << name;
}

TEST(CameraPath, IsRefusedWhereItsFileHasNoBottom) {
  const TempFolder folder;
  write_text(folder / "deep.json",
             "{\"poses\": [" + std::string(200'000, '[') + std::string(200'000, ']') + "]}");
  EXPECT_THROW(scene::read_poses(folder / "deep.json", glm::dvec3(0)), Error);
}

}  // namespace
}  // namespace nightcity::test
