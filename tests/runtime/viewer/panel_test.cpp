#include "runtime/viewer/panel.h"

#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <functional>

namespace nightcity::viewer {
namespace {

// Dear ImGui without a window: frames are not shown, and the test moves the mouse.
class Panel : public testing::Test {
 protected:
  void SetUp() override {
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = {800, 1000};
    io.DeltaTime = 1.0f / 60;
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
    stats.scene = "town.glb";
    stats.device = "a device";
    for (int i = 0; i < 3; ++i) frame();  // the panel finds its size
  }
  void TearDown() override { ImGui::DestroyContext(); }

  PanelRequests frame() {
    ImGui::NewFrame();
    const PanelRequests requests = draw_panel(state, stats);
    ImGui::Render();
    return requests;
  }

  // Clicks every spot of the panel's column, from the top, until `done`; a spot is 4 pixels high.
  bool click_through(float x, const std::function<bool(const PanelRequests&)>& done) {
    ImGuiIO& io = ImGui::GetIO();
    for (float y = 30; y < 600; y += 4) {
      io.MousePos = {x, y};
      frame();
      io.MouseDown[0] = true;
      if (done(frame())) return true;
      io.MouseDown[0] = false;
      if (done(frame())) return true;
      // An open list would cover the widgets below it.
      if (ImGui::GetCurrentContext()->OpenPopupStack.Size > 0) ImGui::ClosePopupToLevel(0, false);
    }
    return false;
  }

  ViewerState state;
  FrameStats stats;
};

TEST_F(Panel, DrawsSomethingAndChangesNothingByItself) {
  const ViewerState before = state;
  const PanelRequests requests = frame();
  EXPECT_GT(ImGui::GetDrawData()->TotalVtxCount, 500);
  EXPECT_FALSE(requests.restart);
  EXPECT_FALSE(requests.save);
  EXPECT_EQ(requests.camera_preset, "");
  EXPECT_EQ(state.settings.sampling.candidates, before.settings.sampling.candidates);
  EXPECT_EQ(state.settings.reuse.neighbours, before.settings.reuse.neighbours);
  EXPECT_EQ(state.settings.display.ev100, before.settings.display.ev100);
  EXPECT_EQ(state.divisor, before.divisor);
}

TEST_F(Panel, ClickOnLampMarkersTurnsThemOn) {
  ASSERT_FALSE(state.markers);
  EXPECT_TRUE(click_through(28, [&](const PanelRequests&) { return state.markers; }));
}

TEST_F(Panel, ClickOnAccumulateTurnsItOffAndAsksForARender) {
  bool asked = false;
  EXPECT_TRUE(click_through(28, [&](const PanelRequests& requests) {
    asked = requests.restart;
    return !state.accumulate;
  }));
  EXPECT_TRUE(asked);
}

TEST_F(Panel, ClickOnASliderChangesCandidates) {
  const std::uint32_t before = state.settings.sampling.candidates;
  EXPECT_TRUE(click_through(
      200, [&](const PanelRequests&) { return state.settings.sampling.candidates != before; }));
  EXPECT_GE(state.settings.sampling.candidates, 1u);
  EXPECT_LE(state.settings.sampling.candidates, render::max_candidates);
}

TEST_F(Panel, MovingTheExposureEndsItsMetering) {
  ASSERT_TRUE(state.auto_exposure);
  const float before = state.settings.display.ev100;
  EXPECT_TRUE(click_through(
      200, [&](const PanelRequests&) { return state.settings.display.ev100 != before; }));
  EXPECT_FALSE(state.auto_exposure);
}

TEST_F(Panel, CameraPresetIsAskedForByName) {
  std::string preset;
  EXPECT_TRUE(click_through(160, [&](const PanelRequests& requests) {
    preset = requests.camera_preset;
    return !preset.empty();
  }));
  EXPECT_NE(std::find(scene::camera_presets().begin(), scene::camera_presets().end(), preset),
            scene::camera_presets().end());
}

TEST_F(Panel, CaptionNamesWhatMadeThePicture) {
  stats.frames = 64;
  state.settings.sampling.estimator = render::Estimator::paper;
  EXPECT_EQ(caption(state, stats), "paper, 32 candidates, 4 neighbours, mean of 64 frames");
  state.settings.sampling.estimator = render::Estimator::ris;
  EXPECT_EQ(caption(state, stats), "ris, 32 candidates, mean of 64 frames");
  state.settings.sampling.estimator = render::Estimator::reference;
  stats.frames = 1;
  EXPECT_EQ(caption(state, stats), "reference, mean of 1 frame");
}

}  // namespace
}  // namespace nightcity::viewer
