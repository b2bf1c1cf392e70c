// What windows look like: one quad each, batched by tile and brightness.
#pragma once

#include <cstdint>
#include <filesystem>
#include <utility>

#include "formats/georeference.h"
#include "formats/scene_file.h"
#include "tools/cell_file.h"
#include "tools/lights/windows.h"

namespace nightcity {

/// Gathers windows and writes them as nodes of kind "window" that cast no shadow (their quads lie where their
/// light starts). Materials hold the luminance to a quarter of a stop and the colour to 250 K, which is for
/// the eye of other programs; the lights themselves are exact. Every window has its light's luminance,
/// whatever its hours: those are in city.lights alone.
class WindowModels {
 public:
  /// Keeps them in a scratch file beside `scratch`, so that memory does not grow with the city.
  WindowModels(const std::filesystem::path& scratch, double tile_m)
      : tiles_(scratch), tile_m_(tile_m) {}

  /// `light`: its number in city.lights, which each vertex names.
  void add(const LitRectangle& window, std::uint32_t light);
  void write(SceneWriter& writer, const Georeference& georeference);

 private:
  using Tile = std::pair<int, int>;
  struct Record {
    LitRectangle window;
    std::uint32_t light;
  };

  CellFile<Tile, Record> tiles_;
  double tile_m_;
};

}  // namespace nightcity
