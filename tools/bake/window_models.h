// What windows look like: one quad each, batched by tile and brightness.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <utility>
#include <vector>

#include "formats/atomic_file.h"
#include "formats/georeference.h"
#include "formats/scene_file.h"
#include "tools/lights/windows.h"

namespace nightcity {

/// Gathers windows and writes them as nodes of kind "window" that cast no shadow (their quads lie where their
/// light starts). Materials hold the luminance to a quarter of a stop and the colour to 250 K, which is for
/// the eye of other programs; the lights themselves are exact. Every window has its light's luminance,
/// whatever its hours: those are in city.lights alone.
class WindowModels {
 public:
  /// Keeps a scratch file beside `scratch`; 4 bytes a window in memory.
  WindowModels(const std::filesystem::path& scratch, double tile_m) : file_(scratch), tile_m_(tile_m) {}

  /// `light`: its number in city.lights, which each vertex names.
  void add(const LitRectangle& window, std::uint32_t light);
  void write(SceneWriter& writer, const Georeference& georeference);

 private:
  using Tile = std::pair<int, int>;
  using Look = std::pair<int, int>;  // brightness and colour as an index into steps
  struct Record;

  ScratchFile file_;
  double tile_m_;
  std::uint32_t count_ = 0;
  std::map<Tile, std::map<Look, std::vector<std::uint32_t>>> tiles_;
};

}  // namespace nightcity
