// Runs the program in a virtual display; xdotool moves mouse and keys.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <set>
#include <string>

#include "formats/light_file.h"
#include "formats/scene_writer.h"
#include "runtime/measure/png.h"
#include "runtime/scene/camera.h"
#include "support/process.h"
#include "support/scenes.h"
#include "support/temp_folder.h"

namespace nightcity::viewer {
namespace {

bool has(const char* program) {
  return std::system((std::string("command -v ") + program + " > /dev/null 2>&1").c_str()) == 0;
}

class ViewerWindow : public testing::Test {
 protected:
  void SetUp() override {
    if (!has("Xvfb") || !has("xvfb-run") || !has("xauth"))
      GTEST_SKIP() << "Xvfb is not installed: no display to open a window on";
    write_scene();
  }

  void write_scene() const {
    test::SceneBuilder builder = test::random_town(30, 60, 7);
    const Scene& scene = builder.scene();
    SceneWriter writer(folder / "town.glb", {});
    for (const SceneMaterial& material : scene.materials) writer.add_material(material);
    for (const SceneMesh& mesh : scene.meshes) writer.add_mesh(mesh);
    for (const SceneNode& node : scene.nodes) writer.add_node(node);
    writer.finish(scene.georeference);
    const std::vector<Light> lights = test::random_lamps(20, 50, 8);
    const std::vector<LightProvenance> provenance(lights.size());
    write_light_file(folder / "town.lights", {scene.georeference, lights, provenance, {}, {}});
  }

  // Runs `script` (sh) in a virtual display of its own, in the test's folder; $V is nightview on
  // the scene, $S a small size.
  int run(const std::string& script) const {
    std::string text = "S='--size 320x240 --every 2'\nV='";
    text += NIGHTCITY_BUILD_DIR;
    text += "/nightview town.glb --validation'\n";
    test::write_text(folder / "script.sh", text + script);
    std::string command = "cd ";
    command += folder.path().string();
    command +=
        " && timeout 120 xvfb-run -a -s '-screen 0 800x600x24' sh script.sh > out.txt 2> err.txt";
    return std::system(command.c_str());
  }
  std::string text(const char* name) const { return test::read_text(folder / name); }

  test::TempFolder folder;
};

std::size_t colours(const measure::Image8& image, std::uint32_t x0, std::uint32_t x1,
                    std::uint32_t y0, std::uint32_t y1) {
  std::set<std::uint32_t> seen;
  for (std::uint32_t y = y0; y < y1; ++y)
    for (std::uint32_t x = x0; x < x1; ++x) {
      const std::uint8_t* rgb = &image.rgb[3 * (std::size_t{y} * image.width + x)];
      seen.insert(std::uint32_t{rgb[0]} << 16 | std::uint32_t{rgb[1]} << 8 | rgb[2]);
    }
  return seen.size();
}

TEST_F(ViewerWindow, ShowsThePictureAndSaysWhichEstimatorMadeIt) {
  ASSERT_EQ(run("exec $V $S --estimator pairwise --quit-after 6 --screenshot window.png\n"), 0)
      << text("err.txt");
  EXPECT_NE(text("out.txt").find("6 frames shown"), std::string::npos) << text("out.txt");
  EXPECT_NE(text("out.txt").find("estimator pairwise"), std::string::npos) << text("out.txt");
  const measure::Image8 window = measure::read_png(folder / "window.png");
  EXPECT_EQ(window.width, 320u);
  EXPECT_EQ(window.height, 240u);
  EXPECT_GT(colours(window, 0, 320, 0, 240), 100u);
  EXPECT_GT(colours(window, 12, 200, 214, 232), 1u);  // the caption's line
}

TEST_F(ViewerWindow, PanelAndMarkersAreDrawnOverThePicture) {
  // The same picture with and without markers: the difference shows the markers.
  ASSERT_EQ(run("$V $S --quit-after 3 --ev 3 --screenshot plain.png && $V $S --quit-after 3 --ev 3 "
                "--markers "
                "--screenshot marked.png\n"),
            0)
      << text("err.txt");
  const measure::Image8 plain = measure::read_png(folder / "plain.png"),
                        marked = measure::read_png(folder / "marked.png");
  ASSERT_EQ(plain.rgb.size(), marked.rgb.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < plain.rgb.size(); i += 3)
    different += std::abs(int{plain.rgb[i]} - int{marked.rgb[i]}) > 20;
  EXPECT_GT(different, 50u);
  EXPECT_LT(different, plain.rgb.size() / 6);
}

TEST_F(ViewerWindow, KeysChooseTheEstimatorAndQuit) {
  if (!has("xdotool")) GTEST_SKIP() << "xdotool is not installed: no mouse or keyboard";
  ASSERT_EQ(run("$V $S & viewer=$!\n"
                "xdotool search --sync --onlyvisible --name nightview > window.txt\n"
                "xdotool mousemove 300 220 key 2 key Escape\n"
                "wait $viewer\n"),
            0)
      << text("err.txt");
  EXPECT_NE(text("out.txt").find("estimator ris"), std::string::npos) << text("out.txt");
}

TEST_F(ViewerWindow, DraggingMovesTheCamera) {
  if (!has("xdotool")) GTEST_SKIP() << "xdotool is not installed: no mouse or keyboard";
  ASSERT_EQ(
      run("V=\"$V --size 700x300 --every 8\"\n"  // wide: the panel covers the left
          "$V --quit-after 1 --save-camera before.json\n"
          "$V --save-camera after.json & viewer=$!\n"
          "xdotool search --sync --onlyvisible --name nightview > window.txt\n"
          "xdotool mousemove 500 150 mousedown 1 mousemove_relative 40 0 mouseup 1 key Escape\n"
          "wait $viewer\n"),
      0)
      << text("err.txt");
  EXPECT_NE(text("before.json"), "");
  EXPECT_NE(text("before.json"), text("after.json"));
}

TEST_F(ViewerWindow, WithoutADisplayItSaysSoAndEndsWith1) {
  ::unsetenv("DISPLAY");
  ::unsetenv("WAYLAND_DISPLAY");
  const test::Outcome outcome = test::run_program("nightview", (folder / "town.glb").string());
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find("nightview render needs no window"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace nightcity::viewer
