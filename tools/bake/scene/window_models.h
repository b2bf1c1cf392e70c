// Windows in city.glb: one quad each, in one mesh for each tile, with a primitive for each
// brightness and colour.
#pragma once

#include <cstdint>
#include <filesystem>
#include <utility>

#include "formats/georeference.h"
#include "formats/material_names.h"
#include "formats/scene_writer.h"
#include "tools/cell_file.h"
#include "tools/lights/windows.h"

namespace nightcity::bake {

/// Names of what luminous rectangles are: of meshes, of their nodes' kind and of materials.
struct RectangleNames {
  const char* meshes = "windows";
  const char* kind = "window";
  const char* material = window_pane_material;
};

/// Gathers windows and writes them as nodes of kind "window" that cast no shadow, because their
/// quads lie where their light starts. Materials round the luminance to a quarter of a stop and the
/// colour to 250 K: other programs show them; the lights themselves are exact. Every window has its
/// light's luminance at all hours: the hours are in city.lights alone.
class WindowModels {
 public:
  /// Keeps the windows in a scratch file beside `scratch`, so that memory does not grow with the
  /// city. `tile_m` is the side of a tile.
  WindowModels(const std::filesystem::path& scratch, double tile_m, RectangleNames names = {})
      : tiles_(scratch), tile_m_(tile_m), names_(names) {}

  /// `light` is the window's number in city.lights, which each vertex names.
  void add(const lights::LitRectangle& window, std::uint32_t light);
  void write(SceneWriter& writer, const Georeference& georeference);

 private:
  using Tile = std::pair<int, int>;
  struct Record {
    lights::LitRectangle window;
    std::uint32_t light;
  };

  CellFile<Tile, Record> tiles_;
  double tile_m_;
  RectangleNames names_;
};

}  // namespace nightcity::bake
