#include "runtime/experiments/fingerprint.h"

#include <gtest/gtest.h>

#include "support/temp_folder.h"

namespace nightcity::experiments {
namespace {

TEST(Fingerprint, OfASceneChangesWithEitherFile) {
  const test::TempFolder folder;
  test::write_text(folder / "a.glb", "scene");
  test::write_text(folder / "a.lights", "lights");
  const std::string first = fingerprint_scene(folder / "a.glb");
  EXPECT_EQ(first.size(), 16u);
  EXPECT_EQ(fingerprint_scene(folder / "a.glb"), first);
  test::write_text(folder / "a.lights", "Lights");
  const std::string second = fingerprint_scene(folder / "a.glb");
  EXPECT_NE(second, first);
  test::write_text(folder / "a.glb", "Scene");
  EXPECT_NE(fingerprint_scene(folder / "a.glb"), second);
}

TEST(Fingerprint, OfAPoseChangesWithEveryPartOfIt) {
  const scene::CameraPose pose;
  scene::CameraPose moved = pose, turned = pose, rolled = pose, zoomed = pose;
  moved.position.x += 1;
  turned.target.y += 1;
  rolled.up.z += 1;
  zoomed.fov_deg += 1;
  EXPECT_EQ(fingerprint_pose(pose).size(), 8u);
  for (const scene::CameraPose& other : {moved, turned, rolled, zoomed})
    EXPECT_NE(fingerprint_pose(other), fingerprint_pose(pose));
}

}  // namespace
}  // namespace nightcity::experiments
