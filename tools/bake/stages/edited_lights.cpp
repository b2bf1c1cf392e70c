#include "tools/bake/stages/edited_lights.h"

namespace nightcity::bake {

EditedLights::EditedLights(const std::vector<std::filesystem::path>& files, LightFileWriter& lights)
    : lights_(lights) {
  for (const std::filesystem::path& file : files)
    for (const auto& [id, edit] : read_light_edits(file)) edits_[id] = edit;
}

const LightEdit* EditedLights::find(std::uint32_t id) {
  const auto found = edits_.find(id);
  if (found == edits_.end()) return nullptr;
  used_.insert(id);
  return &found->second;
}

void EditedLights::change(lights::PlacedLamp& lamp) {
  const LightEdit* edit = find(lamp.id);
  if (!edit) return;
  if (edit->flux_lm) {
    lamp.flux_lm = *edit->flux_lm;
    lamp.provenance.flux = ValueSource::edit;
  }
  if (edit->is_off) lamp.provenance.schedule = ValueSource::edit;
}

void EditedLights::change(lights::LitRectangle& window) {
  const LightEdit* edit = find(window.id);
  if (!edit) return;
  if (edit->flux_lm) {
    window.luminance_cd_m2 *= static_cast<float>(*edit->flux_lm / window.flux_lm());
    window.provenance.flux = ValueSource::edit;
  }
  if (edit->is_off) window.provenance.schedule = ValueSource::edit;
}

void EditedLights::finish(Light& light) {
  const LightEdit* edit = find(light.id);
  if (!edit) return;
  if (edit->aim) {
    LightEdit aim;
    aim.aim = edit->aim;
    apply_edit(aim, light);
  }
  if (!edit->is_off) return;
  // A light of a file has flux; one that is off has a night without a switch.
  if (!never_) never_ = lights_.add_schedule({});
  light.schedule = *never_;
}

bool EditedLights::is_off(std::uint32_t id) const {
  const auto found = edits_.find(id);
  return found != edits_.end() && found->second.is_off;
}

}  // namespace nightcity::bake
