// Edits of single lights (formats/light_edits.h) in a bake.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <set>
#include <vector>

#include "formats/light_edits.h"
#include "formats/light_file_writer.h"
#include "tools/lights/place_lamps.h"
#include "tools/lights/windows.h"

namespace nightcity::bake {

class EditedLights {
 public:
  /// Reads the files; of several edits of one light, that of the last file holds. `lights` must
  /// outlive the object. Throws Error.
  EditedLights(const std::vector<std::filesystem::path>& files, LightFileWriter& lights);

  /// Changes what a lamp or window gives, before its model is made of it.
  void change(lights::PlacedLamp& lamp);
  void change(lights::LitRectangle& window);
  /// Aims the light, and switches it off for good, as its edit says.
  void finish(Light& light);
  /// Returns whether a light was switched off by its edit.
  bool is_off(std::uint32_t id) const;

  std::size_t used() const { return used_.size(); }
  std::size_t unused() const { return edits_.size() - used_.size(); }

 private:
  const LightEdit* find(std::uint32_t id);

  LightFileWriter& lights_;
  LightEdits edits_;
  std::set<std::uint32_t> used_;
  std::optional<std::uint32_t> never_;  // the schedule of lights that are off
};

}  // namespace nightcity::bake
