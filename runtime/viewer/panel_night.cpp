#include "runtime/viewer/panel_night.h"

#include <imgui.h>

#include <string>

#include "runtime/viewer/panel_settings.h"
#include "shaders/tonemap.glsl.h"

namespace nightcity::viewer {
namespace {

// Typed values are bounded as dragged ones are.
constexpr ImGuiSliderFlags bounded_night = ImGuiSliderFlags_AlwaysClamp;

// Sky and moon. A moon that was not placed stands where it lights most streets: 35 degrees high, in
// the south.
void draw_sky(render::EnvironmentSettings& environment) {
  float sky = environment.sky_cd_m2.x,
        moon = tonemap::luminance_709(environment.moon_lux.r, environment.moon_lux.g,
                                      environment.moon_lux.b);
  const bool glows = environment.glow != render::SkyGlow::none;
  if (ImGui::SliderFloat("sky", &sky, 0, glows ? 10 : 1, glows ? "%.3f of its glow" : "%.4f cd/m2",
                         bounded_night | ImGuiSliderFlags_Logarithmic))
    environment.sky_cd_m2 = glm::vec3(sky);
  if (!ImGui::SliderFloat("moon", &moon, 0, 0.3f, "%.3f lx", bounded_night)) return;
  const glm::vec3 direction = environment.moon_direction;
  render::set_moon(environment, 160, 35, double(moon));
  if (direction != render::EnvironmentSettings{}.moon_direction)
    environment.moon_direction = direction;
}

void draw_families(scene::LightFamilies& on) {
  constexpr struct {
    LightFamily family;
    const char* label;
    bool begins_row = false;
  } boxes[] = {{LightFamily::lamp, "street lamps", true},
               {LightFamily::window, "windows"},
               {LightFamily::headlamp, "headlights", true},
               {LightFamily::tail_lamp, "tail lights"},
               {LightFamily::other, "others"}};
  for (const auto& box : boxes) {
    if (!box.begins_row) ImGui::SameLine();
    bool shines = scene::has_family(on, box.family);
    if (ImGui::Checkbox(box.label, &shines)) on ^= scene::to_set(box.family);
  }
}

}  // namespace

// The clock runs from 17:00 to 07:00, which is 5 to 19 hours after noon.
void draw_night(ViewerState& state) {
  ImGui::BeginDisabled(!state.night_changes);
  int minutes = static_cast<int>(state.settings.time_s / 60);
  const std::string shown = clock_text(state.settings.time_s);
  if (ImGui::SliderInt("clock", &minutes, night_begin_s / 60, night_end_s / 60, shown.c_str(),
                       bounded_night))
    state.settings.time_s = minutes * 60.0;
  ImGui::Checkbox("run", &state.play);
  ImGui::SameLine();
  ImGui::SliderFloat("##speed", &state.clock_speed, 1, 3600, "%.0f times",
                     bounded_night | ImGuiSliderFlags_Logarithmic);
  ImGui::EndDisabled();
  draw_families(state.settings.environment.lights);
  draw_sky(state.settings.environment);
  draw_sliders(render::SettingGroup::environment, state.settings);
  draw_sliders(render::SettingGroup::air, state.settings);
}

}  // namespace nightcity::viewer
