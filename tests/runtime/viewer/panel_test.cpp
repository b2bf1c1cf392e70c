#include "runtime/viewer/panel.h"

#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <functional>

#include "runtime/render/setting_table.h"
#include "runtime/viewer/drawing.h"

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
    for (float y = 30; y < 950; y += 4) {
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

TEST_F(Panel, KindsOfLightGoOffOneByOne) {
  const auto is_off = [&](const PanelRequests&) {
    return state.settings.environment.lights != scene::all_families;
  };
  EXPECT_TRUE(click_through(28, is_off));
}

TEST_F(Panel, ClickOnAccumulateTurnsItOff) {
  EXPECT_TRUE(click_through(28, [&](const PanelRequests&) { return !state.accumulate; }));
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

// Ctrl and click open a text box in a slider.
TEST_F(Panel, TypedValuesAreBounded) {
  ImGuiIO& io = ImGui::GetIO();
  state.auto_exposure = false;
  state.camera.motion = Motion::fly;
  state.night_changes = true;
  for (const char* typed : {"1e38", "-1e38", "nan", "inf", "-inf"})
    for (float y = 30; y < 700; y += 4) {
      io.MousePos = {120, y};
      io.KeyCtrl = true;
      frame();
      io.MouseDown[0] = true;
      frame();
      io.MouseDown[0] = false;
      frame();
      io.KeyCtrl = false;
      if (!io.WantTextInput) {
        if (ImGui::GetCurrentContext()->OpenPopupStack.Size > 0) ImGui::ClosePopupToLevel(0, false);
        frame();
        continue;
      }
      for (const char* c = typed; *c; ++c) io.AddInputCharacter(static_cast<unsigned>(*c));
      frame();
      io.MousePos = {700, 900};  // a click elsewhere ends the typing
      io.MouseDown[0] = true;
      frame();
      io.MouseDown[0] = false;
      frame();
      const render::RenderSettings& settings = state.settings;
      EXPECT_NO_THROW(render::check_settings(settings)) << typed << " at " << y;
      EXPECT_GE(settings.display.ev100, -6) << typed;
      EXPECT_LE(settings.display.ev100, 16) << typed;
      EXPECT_GE(state.camera.speed_m_s, 0.5f) << typed;
      EXPECT_LE(state.camera.speed_m_s, 500) << typed;
      EXPECT_GE(state.clock_speed, 1) << typed;
      EXPECT_LE(state.clock_speed, 3600) << typed;
      EXPECT_LE(settings.environment.sky_cd_m2.x, 1) << typed;
      EXPECT_GE(settings.environment.sky_cd_m2.x, 0) << typed;
    }
}

TEST_F(Panel, StaysOnTheScreen) {
  ImGuiIO& io = ImGui::GetIO();
  ImGuiWindow* panel = ImGui::FindWindowByName("nightview");
  ASSERT_TRUE(panel);
  for (const ImVec2& at : {ImVec2(790, 990), ImVec2(-300, -400), ImVec2(5000, 5)}) {
    ImGui::SetWindowPos(panel, at);
    for (int i = 0; i < 3; ++i) frame();
    EXPECT_GE(panel->Pos.x, 0);
    EXPECT_GE(panel->Pos.y, 0);
    EXPECT_LE(panel->Pos.x + panel->Size.x, 800.5f);
    EXPECT_LE(panel->Pos.y + panel->Size.y, 1000.5f);
  }
  io.DisplaySize = {1500, 60};  // a small window, and back
  for (int i = 0; i < 3; ++i) frame();
  io.DisplaySize = {960, 300};
  for (int i = 0; i < 3; ++i) frame();
  EXPECT_GE(panel->Pos.y, 0);
  EXPECT_LE(panel->Pos.y + panel->Size.y, 300 - ImGui::GetFontSize());  // the caption stays free
}

TEST_F(Panel, WithoutLightsItSaysSoAndOffersSkyAndMoon) {
  stats.has_light = false;
  EXPECT_TRUE(click_through(
      28, [&](const PanelRequests&) { return state.settings.environment.sky_cd_m2.x > 0; }));
  EXPECT_GT(state.settings.environment.moon_lux.x, 0);
}

TEST_F(Panel, OneOfSeveralCitiesCanBeOpened) {
  stats.cities = {"a.glb", "b.glb"};
  frame();
  ImGuiIO& io = ImGui::GetIO();
  std::string opened;
  for (float y = 25; y < 120 && opened.empty(); y += 3) {
    io.MousePos = {60, 36};
    if (ImGui::GetCurrentContext()->OpenPopupStack.Size == 0) {
      for (const bool down : {true, false}) {
        io.MouseDown[0] = down;
        frame();
      }
    }
    io.MousePos = {60, y};
    frame();
    for (const bool down : {true, false}) {
      io.MouseDown[0] = down;
      if (const std::string open = frame().open; !open.empty()) opened = open;
    }
  }
  EXPECT_TRUE(opened == "a.glb" || opened == "b.glb") << opened;
}

// While the first scene is opened, widgets that need it are grey, and the others work.
TEST_F(Panel, WithoutASceneNothingIsAskedOfIt) {
  stats.scene = "";
  for (int i = 0; i < 3; ++i) frame();
  for (const float x : {28.0f, 160.0f})
    EXPECT_FALSE(click_through(x, [&](const PanelRequests& requests) {
      return requests.save || requests.film || !requests.camera_preset.empty() ||
             !requests.go_to.empty();
    }));
  state.markers = false;
  EXPECT_TRUE(click_through(28, [&](const PanelRequests&) { return state.markers; }));
  EXPECT_EQ(make_bottom_line(state, stats), "");
}

TEST_F(Panel, TheBottomLineSaysHowManyPixelsThereAreAndWhatGoesOn) {
  stats.frames = 1;
  stats.divisor = 4;
  stats.work = "refining";
  EXPECT_EQ(make_bottom_line(state, stats),
            "traced, 24 candidates, 2 neighbours, mean of 1 frame, every 4th pixel - refining");
}

// Wide windows of little height, and narrow ones in which licences take many lines.
TEST_F(Panel, LeavesTheLicencesFree) {
  for (int i = 0; i < 4; ++i) stats.licences.push_back("Map data of somebody, under some licence");
  for (const ImVec2 size : {ImVec2(1280, 720), ImVec2(640, 360), ImVec2(400, 900)}) {
    ImGui::GetIO().DisplaySize = size;
    for (int i = 0; i < 3; ++i) frame();
    const ImGuiWindow* panel = ImGui::FindWindowByName("nightview");
    ASSERT_NE(panel, nullptr);
    EXPECT_LE(panel->Pos.y + panel->Size.y, size.y - measure_lines(state, stats, {size.x, size.y}));
  }
}

TEST_F(Panel, CaptionNamesWhatMadeThePicture) {
  stats.frames = 64;
  state.settings.sampling.estimator = render::Estimator::paper;
  EXPECT_EQ(caption(state, stats), "paper, 24 candidates, 2 neighbours, mean of 64 frames");
  state.settings.sampling.estimator = render::Estimator::ris;
  EXPECT_EQ(caption(state, stats), "ris, 24 candidates, mean of 64 frames");
  state.settings.sampling.estimator = render::Estimator::reference;
  stats.frames = 1;
  EXPECT_EQ(caption(state, stats), "reference, mean of 1 frame");
  // The picture on the screen is another's until the reference's is there.
  stats.made_with = render::RenderSettings{};
  stats.made_with->sampling.candidates = 8;
  stats.made_with->reuse.neighbours = 0;
  EXPECT_EQ(caption(state, stats), "traced, 8 candidates, 0 neighbours, mean of 1 frame");
}

}  // namespace
}  // namespace nightcity::viewer
