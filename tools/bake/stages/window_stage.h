// The windows of a city that have light at some time of the night.
#pragma once

#include <filesystem>

#include "formats/material_names.h"
#include "tools/bake/city/city.h"
#include "tools/bake/city/city_consumer.h"
#include "tools/bake/stages/window_options.h"
#include "tools/lights/windows.h"

namespace nightcity::bake {

/// Lays windows on the walls of a city while it is read. Their places wait on disk.
class WindowConsumer final : public CityConsumer {
 public:
  /// The use of a building comes from `use_at` (make_use_finder) where the model does not give it.
  /// Scratch files lie beside `scratch`. Throws Error where they cannot be made.
  WindowConsumer(lights::UseAt use_at, const WindowStageOptions& options,
                 const std::filesystem::path& scratch);

  Turn prepare(const std::shared_ptr<const PreparedObject>& prepared) override;
  /// Returns the walls and windows of one object, without regard to others.
  lights::WindowLayout::WindowBatch find_windows(const city::CityObject& object) const {
    return layout_.make_batch(object);
  }

  /// Passes every window that can be where it is to `sink`, or groups of them where the options ask
  /// for it, in the order of the buildings; call once, when the city's ground has been built.
  lights::WindowReport finish(const City& city, const lights::WindowLayout::Sink& sink);

  /// Returns the name of the material that windows are of.
  const char* material_name() const {
    return panes_ && grouping_ == lights::WindowGrouping::none ? window_pane_material
                                                               : even_window_material;
  }

 private:
  lights::WindowLayout layout_;
  lights::WindowGrouping grouping_;
  bool panes_;
};

}  // namespace nightcity::bake
