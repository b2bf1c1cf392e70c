// Runs the program in a virtual display; xdotool moves mouse and keys.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>
#include <sstream>
#include <string>
#include <utility>

#include "formats/light_file.h"
#include "runtime/measure/png.h"
#include "runtime/scene/camera.h"
#include "support/process.h"
#include "support/scene_files.h"
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
    write_town();
  }

  void write_town() const {
    test::SceneBuilder builder = test::random_town(30, 60, 7);
    test::write_scene_files(folder / "town.glb", builder.scene(), test::random_lamps(20, 50, 8),
                            georeference());
  }
  static Georeference georeference() {
    Georeference place;
    place.licences = {"Somebody's data"};
    return place;
  }

  // Runs `script` (sh) in a virtual display of its own, in the test's folder; $V is nightview on
  // the scene, $S a small size.
  int run(const std::string& script) const {
    std::string text = "export XDG_CONFIG_HOME=$PWD/config\nS='--size 320x240 --every 2'\nV='";
    text += NIGHTCITY_BUILD_DIR;
    text += "/nightview town.glb --validation'\n";
    test::write_text(folder / "script.sh", text + script);
    std::string command = "cd ";
    command += folder.path().string();
    command +=
        " && timeout 300 xvfb-run -a -s '-screen 0 800x600x24' sh script.sh > out.txt 2> err.txt";
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

TEST_F(ViewerWindow, TakesASettingsFile) {
  test::write_text(folder / "s.toml",
                   "[render]\nestimator = \"ris\"\nbounces = 1\nhalf-rate = true\n");
  ASSERT_EQ(run("exec $V $S --settings s.toml --quit-after 6 --screenshot window.png\n"), 0)
      << text("err.txt");
  EXPECT_NE(text("out.txt").find("estimator ris"), std::string::npos) << text("out.txt");
  EXPECT_GT(colours(measure::read_png(folder / "window.png"), 0, 320, 0, 240), 100u);
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

// A van with a headlamp drives past a wall, 12 m/s, for two seconds from 20:00.
void write_moving_scene(const std::filesystem::path& folder) {
  const test::SceneBuilder builder = test::SceneBuilder()
                                         .ground(20)
                                         .box({-6, 0, -4}, {6, 3, -3.5f})
                                         .box({1, 0, -2}, {2, 1.5f, -1});
  std::vector<Light> lights{test::lamp({0, 6, -2.5f}, 4000, 0.1f),
                            test::lamp({-5, 5, 3}, 1000, 0.1f)};
  for (std::size_t i = 0; i < lights.size(); ++i) lights[i].id = static_cast<uint>(i + 1);
  Light front = test::lamp({3.15f, 0.7f, 0}, 3000, 0.05f);
  front.schedule = VEHICLE_LIGHT_ALWAYS;
  front.id = static_cast<uint>(LightFamily::headlamp);
  const std::vector<VehicleKind> vehicles{{{3, 1.6f, 1.1f}, 0, 1, {}}};
  const std::vector<Light> vehicle_lights{front};
  const std::vector<Trip> trips{{0, 2, 0, 0, 0, 0, {}}};
  const std::vector<TripKnot> knots{{{-12, 0, 0.5f}, 0, {12, 0, 0}, 0},
                                    {{12, 0, 0.5f}, 2, {12, 0, 0}, 0}};
  TrafficCycle cycle{};
  cycle.cycle_s = 100;
  for (float& share : cycle.density) share = 1;
  const std::vector<LightProvenance> provenance(lights.size());
  test::write_scene_files(folder / "moving.glb", builder.scene(),
                          {.georeference = builder.scene().georeference,
                           .lights = lights,
                           .provenance = provenance,
                           .traffic = {cycle, vehicles, vehicle_lights, trips, knots}});
}

// Returns the mean of the window's linear light right of the panel and above the caption.
double mean_light(const measure::Image8& window) {
  double sum = 0, count = 0;
  for (std::uint32_t y = 0; y < window.height - 40; ++y)
    for (std::uint32_t x = window.width / 2; x < window.width; ++x)
      for (std::size_t c = 0; c < 3; ++c) {
        const double v = window.rgb[3 * (std::size_t{y} * window.width + x) + c] / 255.0;
        sum += v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
        ++count;
      }
  return sum / count;
}

// Returns the mean of the window's linear light in a part of its width, above the caption.
double mean_light(const measure::Image8& window, double from, double to) {
  measure::Image8 part{2, window.height, {}};
  const auto first = static_cast<std::uint32_t>(from * window.width),
             end = static_cast<std::uint32_t>(to * window.width);
  double sum = 0;
  for (std::uint32_t x = first; x < end; ++x) {
    part.rgb.assign(std::size_t{6} * window.height, 0);
    for (std::uint32_t y = 0; y < window.height; ++y)
      std::copy_n(&window.rgb[3 * (std::size_t{y} * window.width + x)], 3,
                  &part.rgb[3 * (std::size_t{2} * y + 1)]);
    sum += mean_light(part);
  }
  return sum / (end - first);
}

// The clock that moves on by steps counts pictures: the last one is of the same moment in every run,
// however many drafts stood for the first while shaders were being compiled.
TEST_F(ViewerWindow, AClockThatMovesByStepsEndsOnTheSamePictureInEveryRun) {
  write_moving_scene(folder.path());
  ASSERT_EQ(
      run("W=\"$(dirname ${V%% *})/nightview moving.glb --validation --size 800x400 --every 8 "
          "--time 20:00 --play --time-step 0.0333 --ev 3 --tone linear --bounces 0 "
          "--estimator ris\"\n"
          "$W --quit-after 12 --screenshot first.png && "
          "$W --quit-after 12 --screenshot second.png && "
          "$W --quit-after 13 --screenshot later.png\n"),
      0)
      << text("err.txt");
  const measure::Image8 first = measure::read_png(folder / "first.png"),
                        second = measure::read_png(folder / "second.png"),
                        later = measure::read_png(folder / "later.png");
  EXPECT_EQ(mean_light(first), mean_light(second));
  EXPECT_NE(mean_light(first), mean_light(later));
}

// The window's own loop, with its clock running, shows the mean of the same last moments with the
// default estimator and with one that reuses nothing. History that meets the vehicles of another
// moment brightens the first.
TEST_F(ViewerWindow, TheRunningClockShowsTheSameLightWithReuseAndWithout) {
  write_moving_scene(folder.path());
  test::write_text(folder / "camera.json",
                   "{\"position\": [4, 9, 12], \"target\": [0, 0.5, -1], \"fov_deg\": 50}\n");
  ASSERT_EQ(
      run("W=\"$(dirname ${V%% *})/nightview moving.glb --validation --size 800x400 --every 4 "
          "--camera camera.json --time 20:00 --play --time-step 0.0333 --ev 3 --tone linear "
          "--no-jitter --bounces 0 --quit-after 24\"\n"
          "for SEED in 0 1 2; do $W --seed $SEED --screenshot default$SEED.png || exit 1; done\n"
          "$W --estimator ris --screenshot truth.png\n"),
      0)
      << text("err.txt");
  // Moments that share samples vary by 1 % from seed to seed.
  double ours = 0;
  for (const char* picture : {"default0.png", "default1.png", "default2.png"})
    ours += mean_light(measure::read_png(folder / picture)) / 3;
  const double truth = mean_light(measure::read_png(folder / "truth.png"));
  std::printf("  mean light %.4f, without reuse %.4f: %+.2f %%\n", ours, truth,
              100 * (ours / truth - 1));
  EXPECT_GT(truth, 0.02);
  EXPECT_LT(truth, 0.7);
  EXPECT_NEAR(ours / truth, 1, 0.02);
}

// Nobody sees the images that are drawn into memory: panel and picture are there all the same.
TEST_F(ViewerWindow, OffscreenDrawsWhatTheScreenWouldShow) {
  ASSERT_EQ(run("for WAY in '' --offscreen; do $V --size 800x400 --every 4 --ev 3 --bounces 0 "
                "--quit-after 3 --screenshot w$WAY.png $WAY || exit 1; done\n"),
            0)
      << text("err.txt");
  const measure::Image8 seen = measure::read_png(folder / "w.png");
  const measure::Image8 unseen = measure::read_png(folder / "w--offscreen.png");
  ASSERT_EQ(unseen.width, seen.width);
  ASSERT_EQ(unseen.height, seen.height);
  const std::uint32_t w = seen.width, h = seen.height;
  EXPECT_GT(colours(unseen, 0, w, 0, h), 100u);
  EXPECT_GT(mean_light(seen), 0.005);
  EXPECT_NEAR(mean_light(unseen) / mean_light(seen), 1, 0.02);
}

// By the pixels of the coarsest picture, a frame of every pixel takes far more than a moving view
// has time for. By the measured budget it does not.
TEST_F(ViewerWindow, FramesWithinABudgetAreCompletedWhereAllPixelsKeepIt) {
  write_moving_scene(folder.path());
  ASSERT_EQ(
      run("timeout 100 \"$(dirname ${V%% *})\"/nightview moving.glb --validation --size 192x128 "
          "--time 20:00 --play --candidates 2 --neighbours 0 --bounces 0 "
          "--budget-ms 100000 --quit-after 8\n"),
      0)
      << text("err.txt");
  EXPECT_NE(text("out.txt").find("8 frames shown"), std::string::npos) << text("out.txt");
}

// Budgets that are kept by every device and by none: what is chosen does not depend on the machine.
TEST_F(ViewerWindow, ABudgetGovernsFramesWhileTheClockRuns) {
  write_moving_scene(folder.path());
  ASSERT_EQ(
      run("W=\"$(dirname ${V%% *})/nightview moving.glb --validation --size 320x200 --every 8 "
          "--time 20:00 --play --time-step 0.0333 --candidates 4 --neighbours 1 --bounces 0 "
          "--quit-after 30\"\n"
          "$W --budget-ms 100000 > rich.txt 2> rich.log && "
          "$W --budget-ms 0.00001 > poor.txt 2> poor.log && "
          "$W --target-error 1000 > easy.txt 2> easy.log && "
          "$W --preset fast > fast.txt\n"),
      0)
      << text("err.txt") << text("rich.log") << text("poor.log") << text("easy.log");
  EXPECT_NE(text("rich.log").find("Starts with 4 candidates, 1 neighbours"), std::string::npos)
      << text("rich.log");
  EXPECT_NE(text("rich.txt").find("budget: 4 candidates, 1 neighbours; 100.0 % of"),
            std::string::npos)
      << text("rich.txt");
  EXPECT_NE(text("rich.txt").find("between pictures in motion: 29 intervals, "), std::string::npos)
      << text("rich.txt");
  EXPECT_NE(text("poor.log")
                .find("Starts with 1 candidates, 0 neighbours, 50 % of each side: none keeps"),
            std::string::npos)
      << text("poor.log");
  EXPECT_NE(
      text("poor.txt").find("budget: 1 candidates, 0 neighbours, 50 % of each side; 0.0 % of"),
      std::string::npos)
      << text("poor.txt");
  EXPECT_NE(text("easy.txt").find("budget: 1 candidates, 0 neighbours\n"), std::string::npos)
      << "more noise than that is never asked for: " << text("easy.txt");
  EXPECT_NE(text("fast.txt").find("estimator pairwise"), std::string::npos) << text("fast.txt");
}

TEST_F(ViewerWindow, KindsOfLightThatAreOffDoNotShine) {
  write_moving_scene(folder.path());
  ASSERT_EQ(
      run("W=\"$(dirname ${V%% *})/nightview moving.glb --validation --size 800x400 --every 8 "
          "--ev 0 --tone linear --time 20:00 --quit-after 12\"\n"
          "$W --screenshot all.png && $W --lights none --screenshot none.png && "
          "$W --lights headlamp --traffic 0 --screenshot empty.png\n"),
      0)
      << text("err.txt");
  // Between the panel and the compass.
  EXPECT_GT(mean_light(measure::read_png(folder / "all.png"), 0.5, 0.8), 0.02);
  EXPECT_LT(mean_light(measure::read_png(folder / "none.png"), 0.5, 0.8), 1e-4);
  EXPECT_LT(mean_light(measure::read_png(folder / "empty.png"), 0.5, 0.8), 1e-4);
  EXPECT_EQ(run("$V --lights candles --quit-after 1; test $? = 2\n"), 0);
  EXPECT_NE(text("err.txt").find("tail_lamp"), std::string::npos) << text("err.txt");
}

TEST_F(ViewerWindow, TwoPicturesAreComparedLeftAndRightOfALine) {
  write_moving_scene(folder.path());
  test::write_text(folder / "camera.json",
                   "{\"position\": [4, 9, 12], \"target\": [4, 0.5, -1], \"fov_deg\": 50}\n");
  // A begins when B has its 16 frames if the lights of the two differ.
  ASSERT_EQ(
      run("W=\"$(dirname ${V%% *})/nightview moving.glb --validation --size 1200x500 --every 8 "
          "--camera camera.json --ev 0 --tone linear --time 20:00 --sky 0 --quit-after 28\"\n"
          "$W --compare lights=none,estimator=ris --screenshot split.png && "
          "$W --compare estimator=ris --screenshot estimators.png\n"),
      0)
      << text("err.txt");
  const measure::Image8 split = measure::read_png(folder / "split.png"),
                        both = measure::read_png(folder / "estimators.png");
  // The panel ends at a third of the width, and the names of the sides are near the line.
  EXPECT_LT(mean_light(split, 0.42, 0.49), 0.01);
  EXPECT_GT(mean_light(split, 0.55, 0.7), 0.02);
  EXPECT_GT(mean_light(both, 0.42, 0.49), 0.02);
  EXPECT_NEAR(mean_light(both, 0.55, 0.7) / mean_light(split, 0.55, 0.7), 1, 0.05);
  EXPECT_EQ(run("$V --compare candles=3 --quit-after 1; test $? = 2\n"), 0);
  EXPECT_EQ(run("$V --compare ris --quit-after 1; test $? = 2\n"), 0);
  EXPECT_EQ(run("$V --compare candidates=-3 --quit-after 1; test $? = 2\n"), 0);
}

TEST_F(ViewerWindow, ViewsHaveFalseColoursAndAScale) {
  for (const char* view : {"luminance", "illuminance", "kinds-of-light", "city-objects", "history",
                           "noise", "wireframe", "tiles"}) {
    ASSERT_EQ(
        run(std::string("$V --size 640x400 --every 8 --quit-after 4 --screenshot a.png --show ") +
            view + "\n"),
        0)
        << view << text("err.txt");
    const measure::Image8 window = measure::read_png(folder / "a.png");
    std::size_t coloured = 0;
    for (std::size_t i = 0; i < window.rgb.size(); i += 3)
      coloured += std::abs(int{window.rgb[i]} - int{window.rgb[i + 1]}) > 20;
    EXPECT_GT(coloured, 2000u) << view;
  }
  EXPECT_EQ(run("$V --show heat --quit-after 1; test $? = 2\n"), 0);
  EXPECT_NE(text("err.txt").find("kinds-of-light"), std::string::npos) << text("err.txt");
}

// With few candidates the estimator is far from its reference, which gathers by turns with it:
// there are pixels that are darker and pixels that are brighter, blue and red. Both have six frames,
// however long the shaders of the reference are being compiled.
TEST_F(ViewerWindow, TheDifferenceToTheReferenceIsSigned) {
  ASSERT_EQ(run("$V --size 640x400 --every 8 --estimator ris --candidates 1 --bounces 0 "
                "--frames 6 --quit-after 12 --screenshot a.png --show difference\n"),
            0)
      << text("err.txt");
  const measure::Image8 window = measure::read_png(folder / "a.png");
  std::size_t blue = 0, red = 0;
  for (std::uint32_t y = 0; y < 350; ++y)
    for (std::uint32_t x = 330; x < 480; ++x) {  // between the panel and the scale
      const std::uint8_t* rgb = &window.rgb[3 * (std::size_t{y} * window.width + x)];
      blue += rgb[2] > rgb[0] + 40;
      red += rgb[0] > rgb[2] + 40;
    }
  EXPECT_GT(blue, 500u);
  EXPECT_GT(red, 500u);
  EXPECT_EQ(run("$V --show difference --compare estimator=ris --quit-after 1; test $? = 2\n"), 0);
}

TEST_F(ViewerWindow, KeysChooseTheEstimatorAndQuit) {
  if (!has("xdotool")) GTEST_SKIP() << "xdotool is not installed: no mouse or keyboard";
  ASSERT_EQ(run("$V $S & viewer=$!\n"
                "xdotool search --sync --onlyvisible --name nightview > window.txt\n"
                "xdotool mousemove 300 220\n"
                "for i in $(seq 20); do xdotool key 2; sleep 0.2; done\n"
                "xdotool key Escape\n"
                "wait $viewer\n"),
            0)
      << text("err.txt");
  EXPECT_NE(text("out.txt").find("estimator ris"), std::string::npos) << text("out.txt");
}

// The key is pressed again until the window's title names the city.
TEST_F(ViewerWindow, PageKeysGoThroughTheCities) {
  if (!has("xdotool")) GTEST_SKIP() << "xdotool is not installed: no mouse or keyboard";
  ASSERT_EQ(
      run("cp town.glb other.glb; cp town.lights other.lights; cp town.glb third.glb\n"
          "$V other.glb third.glb $S & viewer=$!\n"
          "xdotool search --sync --onlyvisible --name nightview > window.txt\n"
          "go() { for i in $(seq 40); do xdotool search --name \"^$2\" > found.txt && return\n"
          "  xdotool key $1; sleep 1; done; kill $viewer; exit 1; }\n"
          "xdotool search --sync --name '^town.glb' > found.txt\n"
          "go Page_Down other.glb; go Page_Up town.glb; go Page_Up third.glb\n"
          "kill -TERM $viewer; wait $viewer; test $? = 143\n"),
      0)
      << text("err.txt");
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

// A key is pressed, and the files that the window wrote are read.
TEST_F(ViewerWindow, AStillViewGetsEveryPixelAndTheSavedPictureHasThemAll) {
  if (!has("xdotool")) GTEST_SKIP() << "xdotool is not installed: no mouse or keyboard";
  ASSERT_EQ(
      run("${V} --size 320x240 --picture-frames 2 & viewer=$!\n"
          "xdotool search --sync --onlyvisible --name nightview > window.txt\n"
          "xdotool mousemove 300 220\n"
          "for i in $(seq 160); do test -e night-001.exr && break; xdotool key p; sleep 0.5; done\n"
          // The first may stop another picture that a later p has asked for.
          "while kill -0 $viewer 2> gone.txt; do xdotool key Escape; sleep 0.5; done\n"
          "wait $viewer\n"),
      0)
      << text("err.txt");
  const measure::Image8 saved = measure::read_png(folder / "night-001.png");
  EXPECT_EQ(saved.width, 320u);
  EXPECT_EQ(saved.height, 240u);
  EXPECT_NE(text("err.txt").find("night-001.png"), std::string::npos) << text("err.txt");
  const std::string png = text("night-001.png");
  EXPECT_NE(png.find("Camera"), std::string::npos);
  EXPECT_NE(png.find("Copyright"), std::string::npos);
  EXPECT_NE(png.find("Somebody's data"), std::string::npos);
}

// The reference of this many lights takes minutes; the window obeys meanwhile.
TEST_F(ViewerWindow, KeysAreObeyedInOrderWhileAFrameTakesLong) {
  if (!has("xdotool")) GTEST_SKIP() << "xdotool is not installed: no mouse or keyboard";
  write_light_file(folder / "town.lights", {georeference(),
                                            test::random_lamps(20000, 50, 8),
                                            std::vector<LightProvenance>(20000),
                                            {},
                                            {}});
  ASSERT_EQ(run("timeout 100 ${V} --size 640x480 --every 1 & viewer=$!\n"
                "xdotool search --sync --onlyvisible --name nightview > window.txt\n"
                "xdotool mousemove 600 440 key 1; sleep 1\n"
                "xdotool key 3 key 2 key Escape\n"
                "wait $viewer\n"),
            0)
      << text("err.txt");
  EXPECT_NE(text("out.txt").find("estimator ris"), std::string::npos) << text("out.txt");
}

// The keys are pressed again until the window has opened its scene and done what they ask for.
TEST_F(ViewerWindow, APlaceThatIsTypedIsGoneTo) {
  if (!has("xdotool")) GTEST_SKIP() << "xdotool is not installed: no mouse or keyboard";
  ASSERT_EQ(run("$V --size 700x500 --every 8 --save-camera camera.json & viewer=$!\n"
                "xdotool search --sync --onlyvisible --name nightview > window.txt\n"
                "xdotool mousemove 600 400\n"
                "for i in 1 2 3 4 5; do\n"
                "  sleep 2; xdotool key g; sleep 0.3; xdotool type --delay 40 '3 -4'\n"
                "  sleep 0.3; xdotool key Return\n"
                "done\n"
                "sleep 1; kill -TERM $viewer; wait $viewer; test $? = 143\n"),
            0)
      << text("err.txt");
  const scene::CameraPose pose = scene::parse_camera(text("camera.json"), "camera.json");
  EXPECT_NEAR(pose.target.x, 3, 0.01) << text("camera.json");
  EXPECT_NEAR(pose.target.z, 4, 0.01);
}

// Enter goes to the better of two streets, and once more to the other.
TEST_F(ViewerWindow, AStreetThatIsTypedIsStoodOn) {
  if (!has("xdotool")) GTEST_SKIP() << "xdotool is not installed: no mouse or keyboard";
  Scene scene = test::SceneBuilder().ground(100).scene();
  scene.places.streets = {{"Lange Straße", {{{-80, 20}, {80, 20}}}},
                          {"Kurze Straße im Tal", {{{30, -80}, {30, 80}}}}};
  test::write_scene_files(folder / "town.glb", scene, test::random_lamps(5, 50, 8), georeference());
  const auto type = [&](const std::string& text, const std::string& more) {
    ASSERT_EQ(run("$V --size 700x500 --every 8 --save-camera camera.json & viewer=$!\n"
                  "xdotool search --sync --onlyvisible --name nightview > window.txt\n"
                  "xdotool search --sync --name '^town.glb' > found.txt\n"  // it is open
                  "xdotool mousemove 600 400; sleep 0.5\n"
                  "xdotool key g; sleep 0.5; xdotool type --delay 40 '" +
                  text + "'; sleep 0.5; xdotool key Return; sleep 1\n" + more +
                  "kill -TERM $viewer; wait $viewer; test $? = 143\n"),
              0)
        << this->text("err.txt");
  };
  type("strasse", "");
  const auto read_pose = [&] { return scene::parse_camera(text("camera.json"), "camera.json"); };
  EXPECT_NEAR(read_pose().position.z, 20, 0.01) << text("err.txt");
  EXPECT_NEAR(read_pose().position.y, 1.7, 0.01);
  EXPECT_NE(text("err.txt").find("the first of 2 whose names contain"), std::string::npos);
  type("strasse", "xdotool key g; sleep 0.5; xdotool key Return; sleep 1\n");
  EXPECT_NEAR(read_pose().position.x, 30, 0.01) << text("err.txt");
  // The second text replaces the first.
  type("lange",
       "xdotool key g; sleep 0.5; xdotool type --delay 40 'im tal'; sleep 0.5\n"
       "xdotool key Return; sleep 1\n");
  EXPECT_NEAR(read_pose().position.x, 30, 0.01) << text("err.txt");
  // The same by an option, for the first frame.
  ASSERT_EQ(run("$V --camera 'street:IM TAL' --quit-after 1 --save-camera camera.json\n"), 0)
      << text("err.txt");
  EXPECT_NEAR(read_pose().position.x, 30, 0.01);
}

// A way of the camera is recorded, and filmed by a second process: Esc stops the film, and the same
// key goes on with it.
TEST_F(ViewerWindow, AFilmOfTheWayIsRecordedStoppedAndGoneOnWith) {
  if (!has("xdotool")) GTEST_SKIP() << "xdotool is not installed: no mouse or keyboard";
  ASSERT_EQ(
      run("mkdir films\n"
          "$V --size 320x240 --every 8 --picture-size 64x48 --picture-frames 1 --bounces 0 \\\n"
          "  --sky 0 --picture-folder films & viewer=$!\n"
          "xdotool search --sync --onlyvisible --name nightview > window.txt\n"
          "xdotool mousemove 300 220\n"
          // Until the scene is open, R is answered with a line.
          "for i in 1 2 3 4 5 6 7 8 9; do\n"
          "  sleep 2; xdotool key r; sleep 1.5; xdotool key w; sleep 1; xdotool key r\n"
          "  sleep 0.5; test -e town.path-001.json && break\n"
          "done\n"
          "xdotool key ctrl+r\n"
          "until test -e films/town.path-001/frame-00002.png; do sleep 0.05; done\n"
          "xdotool key Escape; sleep 2; ls films/town.path-001 > stopped.txt\n"
          "xdotool key ctrl+r\n"
          "for i in $(seq 300); do\n"
          "  grep -q 'pictures in\\|pictures are in' err.txt && break; sleep 0.2\n"
          "done\n"
          "kill -TERM $viewer; wait $viewer; test $? = 143\n"),
      0)
      << text("err.txt");
  EXPECT_NE(text("stopped.txt").find("frame-00002.png"), std::string::npos);
  std::size_t pictures = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder / "films/town.path-001"))
    pictures += file.path().extension() == ".png";
  EXPECT_GE(pictures, 25u) << text("err.txt");  // a second at least
  EXPECT_EQ(measure::read_png(folder / "films/town.path-001/frame-00000.png").width, 64u);
  // Without ffmpeg, the line says that it is missing, and that the pictures are there.
  EXPECT_NE(text("err.txt").find(has("ffmpeg") ? "filmed: " : "ffmpeg"), std::string::npos)
      << text("err.txt");
  EXPECT_EQ(std::filesystem::exists(folder / "films/town.path-001.mp4"), has("ffmpeg"));
  EXPECT_FALSE(std::filesystem::exists(folder / "films/town.path-001-2"));
}

// A lamp fills the middle of the window. It is clicked and switched off, then dimmed, and the edits
// are saved; the next window begins with them.
TEST_F(ViewerWindow, ALampIsEditedAndTheEditsAreKept) {
  if (!has("xdotool")) GTEST_SKIP() << "xdotool is not installed: no mouse or keyboard";
  test::SceneBuilder builder = test::SceneBuilder().ground(20);
  builder.box({-0.2f, 4.8f, -0.2f}, {0.2f, 5.2f, 0.2f});
  Scene scene = builder.scene();
  for (SceneMesh& mesh : scene.meshes) {
    for (ScenePrimitive& primitive : mesh.primitives) {
      primitive.light_ids.assign(primitive.positions.size(), no_id);
      for (std::size_t i = 0; i < primitive.positions.size(); ++i)
        if (primitive.positions[i].y > 4) primitive.light_ids[i] = 0;
    }
  }
  std::vector<Light> lights{test::lamp({0, 5, 0}, 4000, 0.3f)};
  lights[0].id = 0xabc;
  test::write_scene_files(folder / "lamp.glb", scene,
                          {georeference(), lights, std::vector<LightProvenance>(1), {}, {}});
  test::write_text(folder / "camera.json",
                   "{\"position\": [0, 5, 4], \"target\": [0, 5, 0], \"fov_deg\": 30}\n");
  ASSERT_EQ(run("W=\"$(dirname ${V%% *})/nightview lamp.glb --validation --size 1200x500 --every 8 "
                "--camera camera.json\"\n"
                "$W & viewer=$!\n"
                "xdotool search --sync --onlyvisible --name nightview > window.txt\n"
                "xdotool mousemove 600 250\n"
                "for i in 1 2 3 4 5 6 7 8 9; do\n"
                "  sleep 2; xdotool click 1; sleep 0.3; xdotool key period key ctrl+e\n"
                "  sleep 0.5; test -e lamp.edits.json && break\n"
                "done\n"
                "xdotool key o key ctrl+e; sleep 1\n"
                "kill -TERM $viewer; wait $viewer; test $? = 143 || exit 1\n"
                "cat lamp.edits.json\n"
                "$W --quit-after 3 --ev 0 --tone linear --bounces 0 --screenshot off.png\n"
                "for e in '' '--edits lamp.edits.json'; do\n"
                "  ${W%% *} render lamp.glb -o \"r${e%% *}.png\" $e --frames 1 --size 64x48 \\\n"
                "    --camera camera.json --ev 0 --tone linear --bounces 0\n"
                "done\n"),
            0)
      << text("err.txt");
  const std::string edits = text("lamp.edits.json");
  EXPECT_NE(edits.find("00000abc"), std::string::npos) << edits;
  EXPECT_NE(edits.find("\"off\": true"), std::string::npos) << edits;
  EXPECT_NE(edits.find("\"flux_lm\": "), std::string::npos) << edits;
  EXPECT_LT(mean_light(measure::read_png(folder / "off.png"), 0.45, 0.55), 1e-3);
  EXPECT_GT(colours(measure::read_png(folder / "r.png"), 0, 64, 0, 48), 1u);
  EXPECT_EQ(colours(measure::read_png(folder / "r--edits.png"), 0, 64, 0, 48), 1u);  // black
}

// A shell reports 128 and the signal's number, so that Ctrl-C ends its loops too.
TEST_F(ViewerWindow, ASignalEndsItAsClosingDoes) {
  for (const auto& [signal, code] : {std::pair{"INT", 130}, {"TERM", 143}, {"HUP", 129}}) {
    ASSERT_EQ(run(std::string("rm -f camera.json; timeout --preserve-status -s ") + signal +
                  " 5 $V $S --save-camera camera.json\ntest $? = " + std::to_string(code) + "\n"),
              0)
        << text("err.txt");
    EXPECT_NE(text("camera.json"), "") << signal;
    EXPECT_NE(text("out.txt").find("frames shown"), std::string::npos) << signal;
  }
}

// The files stay mapped, so that nothing is missing until it ends.
TEST_F(ViewerWindow, ASignalEndsItWhereTheScenesFolderIsGone) {
  ASSERT_EQ(run("mkdir gone; cp town.glb town.lights gone\n"
                "${V%% *} gone/town.glb --size 160x120 --every 8 & viewer=$!\n"
                "sleep 5; rm -r gone; sleep 1\n"
                "kill -TERM $viewer; wait $viewer; test $? = 143\n"),
            0)
      << text("err.txt");
  EXPECT_NE(text("out.txt").find("frames shown"), std::string::npos);
}

TEST_F(ViewerWindow, AtRestItSleeps) {
  ASSERT_EQ(run("$V --size 160x120 --every 8 --frames 1 & viewer=$!\n"
                "sleep 10; cp /proc/$viewer/stat before.txt\n"
                "sleep 4; cp /proc/$viewer/stat after.txt\n"
                "kill -TERM $viewer; wait $viewer; test $? = 143\n"),
            0)
      << text("err.txt");
  const auto ticks = [&](const char* name) {
    const std::string stat = text(name);
    std::istringstream fields(stat.substr(stat.rfind(')') + 1));
    std::string field;
    long sum = 0;
    for (int i = 3; i <= 15 && fields >> field; ++i)
      if (i >= 14) sum += std::stol(field);  // utime, stime
    return sum;
  };
  // Four seconds passed, 400 ticks: a window that renders uses them all, one at rest not a quarter.
  EXPECT_LT(ticks("after.txt") - ticks("before.txt"), 100);
}

TEST_F(ViewerWindow, ThePanelStaysWhereItWasLeft) {
  if (!has("xdotool")) GTEST_SKIP() << "xdotool is not installed: no mouse or keyboard";
  ASSERT_EQ(run("V=\"$V --size 700x500 --every 8\"\n"
                "$V & viewer=$!\n"
                "xdotool search --sync --onlyvisible --name nightview > window.txt; sleep 2\n"
                "xdotool mousemove 100 20 mousedown 1; sleep 0.3\n"
                "xdotool mousemove 250 60; sleep 0.3; xdotool mouseup 1 mousemove 650 450\n"
                "sleep 0.3; xdotool key Escape; wait $viewer\n"
                "cp config/nightcity/window.ini first.ini\n"
                "$V --quit-after 2\n"),
            0)
      << text("err.txt");
  EXPECT_NE(text("first.ini").find("Pos=160,"), std::string::npos) << text("first.ini");
  EXPECT_NE(text("config/nightcity/window.ini").find("Pos=160,"), std::string::npos)
      << text("config/nightcity/window.ini");
}

TEST_F(ViewerWindow, FoldersUpperCaseNamesLightsAndTwoScenesAreUnderstood) {
  std::filesystem::create_directory(folder / "baked");
  for (const char* name : {"town.glb", "town.lights"})
    std::filesystem::copy(folder / name, folder / "baked" / name);
  std::filesystem::copy(folder / "town.glb", folder / "UPPER.GLB");
  std::filesystem::copy(folder / "town.lights", folder / "UPPER.LIGHTS");
  ASSERT_EQ(run("P=\"$(dirname ${V%% *})/nightview\"\n"
                "for scene in baked UPPER.GLB town.lights 'town.glb UPPER.GLB'; do\n"
                "  $P $scene $S --quit-after 1 || exit 1\n"
                "done\n"
                "$P town.glb $S --ev auto --quit-after 1\n"),
            0)
      << text("err.txt");
}

TEST_F(ViewerWindow, WhatWouldBeIgnoredIsRefused) {
  EXPECT_EQ(run("$V $S --screenshot a.png; test $? = 2\n"), 0) << text("err.txt");
  EXPECT_NE(text("err.txt").find("--quit-after"), std::string::npos) << text("err.txt");
  EXPECT_EQ(run("$V $S --quit-after 1 --screenshot missing/there/x.png; test $? != 0\n") == 0 ||
                std::filesystem::exists(folder / "missing/there/x.png"),
            true)
      << text("err.txt");
}

TEST_F(ViewerWindow, AFolderThatTakesNoFilesDoesNotEndIt) {
  if (!has("xdotool")) GTEST_SKIP() << "xdotool is not installed: no mouse or keyboard";
  // The scene's name must not depend on the folder that goes while the scene is being read.
  ASSERT_EQ(run("T=$PWD; mkdir gone; cd gone; P=\"$(dirname ${V%% *})/nightview\"\n"
                "HOME= $P $T/town.glb $S --picture-frames 1 --validation & viewer=$!\n"
                "rmdir $T/gone\n"
                "xdotool search --sync --onlyvisible --name nightview > $T/window.txt\n"
                "xdotool mousemove 300 220 key p\n"
                // A busy machine may not have opened the scene yet.
                "for i in 1 2 3 4 5 6 7 8 9 10 11 12; do\n"
                "  sleep 4; kill -0 $viewer || break; xdotool key 2 key Escape\n"
                "done\n"
                "wait $viewer\n"),
            0)
      << text("err.txt");
  EXPECT_NE(text("out.txt").find("estimator ris"), std::string::npos) << text("out.txt");
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
