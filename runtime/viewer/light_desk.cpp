#include "runtime/viewer/light_desk.h"

#include <algorithm>
#include <cmath>

#include "runtime/viewer/errand.h"

namespace nightcity::viewer {

void LightDesk::draw(double now_s) {
  if (!session_.picked || !session_.picked->emitter) return;
  City& city = workbench_.city();
  const std::size_t light = session_.picked->emitter->light;
  LightEdit edited = editor_.edit_of(city.scene.lights[light]);
  bool saves = false;
  if (draw_light_editor(edited, editor_.original_of(city.scene, light), editor_.is_unsaved(),
                        saves))
    edit([&](LightEdit& changed) { changed = edited; }, now_s);
  if (saves) save(now_s);
}

void LightDesk::edit(const std::function<void(LightEdit&)>& change, double now_s) {
  std::optional<Pick>& picked = session_.picked;
  if (!picked || !picked->emitter) {
    session_.notices.say("click a lamp or window first", now_s);
    return;
  }
  City& city = workbench_.city();
  const std::size_t light = picked->emitter->light;
  LightEdit edit = editor_.edit_of(city.scene.lights[light]);
  const double original_lm = double(editor_.original_of(city.scene, light).flux_lm);
  if (!edit.flux_lm) edit.flux_lm = original_lm;
  change(edit);
  if (edit.flux_lm) {
    edit.flux_lm = std::clamp(*edit.flux_lm, original_lm / 1000, original_lm * 1000);
    if (std::abs(*edit.flux_lm / original_lm - 1) < 1e-6) edit.flux_lm.reset();
  }
  editor_.edit(city.scene, *city.on_device, light, edit);
  const render::RenderSettings& settings = session_.state.settings;
  find_lights(*picked, city.scene, settings.time_s, settings.environment.lights);
}

void LightDesk::save(double now_s) {
  run_errand(session_.notices, now_s, [this] { return editor_.save(); });
}

}  // namespace nightcity::viewer
