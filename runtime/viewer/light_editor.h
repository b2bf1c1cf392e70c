// Edits lights of the city that is shown: switches, dims and aims them, and keeps that as an
// overlay file.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "formats/light_edits.h"
#include "runtime/render/device_scene.h"
#include "runtime/scene/render_scene.h"

namespace nightcity::viewer {

/// A step of a key.
constexpr double dim_step = 1.25;

class LightEditor {
 public:
  /// Returns the file beside a scene, which need not exist.
  static std::filesystem::path find_file(const std::string& scene);

  /// Takes the edits of `file`, if it exists, over to the scene, before the device has it. Returns
  /// a sentence about them, "" without any. Throws Error where the file is broken.
  std::string open(const std::filesystem::path& file, scene::RenderScene& scene);

  /// Returns the edit of a light, empty where it has none.
  LightEdit edit_of(const Light& light) const;
  /// Returns the light without its edit.
  const Light& original_of(const scene::RenderScene& scene, std::size_t light) const;
  /// Edits a light, in the scene and on the device.
  void edit(scene::RenderScene& scene, render::DeviceScene& on_device, std::size_t light,
            const LightEdit& edit);
  /// Writes all edits to the file, and returns the sentence that says so. Throws Error.
  std::string save();
  bool is_unsaved() const { return unsaved_; }
  const LightEdits& edits() const { return edits_; }

 private:
  std::filesystem::path file_;
  LightEdits edits_;
  std::map<std::size_t, Light> originals_;  // of edited lights, by index
  bool unsaved_ = false;
};

/// Draws the widgets that edit a light, at the end of the window "here". Returns whether `edit`
/// changed. Sets `save` where the edits are to be saved.
bool draw_light_editor(LightEdit& edit, const Light& original, bool unsaved, bool& save);

}  // namespace nightcity::viewer
