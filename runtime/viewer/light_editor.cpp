#include "runtime/viewer/light_editor.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "runtime/scene/scene_file.h"

namespace nightcity::viewer {
namespace {

// The axis of a light as east, north, up.
glm::vec3 aim_of(const Light& light) {
  return {light.axis.x, -light.axis.z, light.axis.y};
}

}  // namespace

std::filesystem::path LightEditor::find_file(const std::string& scene) {
  return std::filesystem::path(scene::find_scene_file(scene)).replace_extension(".edits.json");
}

std::string LightEditor::open(const std::filesystem::path& file, scene::RenderScene& scene) {
  file_ = file;
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return "";
  edits_ = read_light_edits(file);
  for (std::size_t i = 0; i < scene.lights.size(); ++i)
    if (edits_.count(scene.lights[i].id) != 0) originals_.emplace(i, scene.lights[i]);
  const std::size_t unknown = apply_edits(edits_, scene.lights);
  scene.has_edited_lights = unknown < edits_.size();
  std::string text = fmt::format("{} edited lights of {}", edits_.size() - unknown, file.string());
  if (unknown > 0) text += fmt::format("; {} more are not in this scene", unknown);
  return text;
}

LightEdit LightEditor::edit_of(const Light& light) const {
  const auto found = edits_.find(light.id);
  return found == edits_.end() ? LightEdit{} : found->second;
}

const Light& LightEditor::original_of(const scene::RenderScene& scene, std::size_t light) const {
  const auto found = originals_.find(light);
  return found == originals_.end() ? scene.lights[light] : found->second;
}

void LightEditor::edit(scene::RenderScene& scene, render::DeviceScene& on_device, std::size_t light,
                       const LightEdit& edit) {
  originals_.try_emplace(light, scene.lights[light]);
  Light& edited = scene.lights[light];
  edited = originals_.at(light);
  apply_edit(edit, edited);
  on_device.edit_light(static_cast<std::uint32_t>(light), edited);
  if (edit.is_empty())
    edits_.erase(edited.id);
  else
    edits_[edited.id] = edit;
  unsaved_ = true;
}

std::string LightEditor::save() {
  write_light_edits(file_, edits_);
  unsaved_ = false;
  return fmt::format("{} edited light{} saved in {}", edits_.size(), edits_.size() == 1 ? "" : "s",
                     file_.string());
}

bool draw_light_editor(LightEdit& edit, const Light& original, bool unsaved, bool& save) {
  const LightEdit before = edit;
  if (ImGui::Begin("here")) {
    ImGui::Separator();
    ImGui::PushItemWidth(14 * ImGui::GetFontSize());
    bool on = !edit.is_off;
    if (ImGui::Checkbox("on", &on)) edit.is_off = !on;
    float flux = static_cast<float>(edit.flux_lm.value_or(double(original.flux_lm)));
    const float least = std::max(1e-3f, original.flux_lm / 100), most = 100 * original.flux_lm;
    if (ImGui::SliderFloat("flux", &flux, least, most, "%.0f lm",
                           ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic))
      edit.flux_lm = double(flux);
    if (light_kind(original) == LightKind::sphere) {
      const glm::vec3 aim = edit.aim.value_or(aim_of(original));
      float bearing = glm::degrees(std::atan2(aim.x, aim.y)),
            down = glm::degrees(std::asin(std::clamp(-aim.z, -1.0f, 1.0f)));
      bool turned = ImGui::SliderFloat("aim, from north", &bearing, -180, 180, "%.0f degrees");
      turned |= ImGui::SliderFloat("aim, down", &down, -90, 90, "%.0f degrees");
      // Straight down, every bearing is the same: a little off it, they are kept apart.
      const float steep = glm::radians(std::clamp(down, -89.9f, 89.9f)),
                  turn = glm::radians(bearing);
      if (turned)
        edit.aim = glm::normalize(glm::vec3(std::cos(steep) * std::sin(turn),
                                            std::cos(steep) * std::cos(turn), -std::sin(steep)));
    }
    if (ImGui::SmallButton("as it was")) edit = {};
    ImGui::SameLine();
    save |= ImGui::SmallButton(unsaved ? "save edits *" : "save edits");
    ImGui::PopItemWidth();
  }
  ImGui::End();
  return !(edit == before);
}

}  // namespace nightcity::viewer
