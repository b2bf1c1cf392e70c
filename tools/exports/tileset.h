// A scene as 3D Tiles 1.1 (OGC 22-025r4), for programs that show the whole Earth.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>

#include "formats/light_file.h"
#include "formats/scene.h"

namespace nightcity::exports {

/// How lamps are written: as points and spots (KHR_lights_punctual), or, those that have a profile,
/// by it (EXT_lights_ies).
enum class LampForm : std::uint8_t { punctual, ies };

struct TilesetOptions {
  double cell_m = 500;        // side of a tile
  double geoid_m = 0;         // height of the zero of the scene's heights above WGS 84's ellipsoid
  int shown_minute = 5 * 60;  // after 17:00: the lamps that are lit then are written as lights
  LampForm lamps = LampForm::punctual;
};

struct TilesetReport {
  std::size_t tiles = 0, triangles = 0, features = 0, lights = 0;
  std::size_t vehicles = 0;  // meshes of vehicles, which are left out: they move
};

/// Writes `folder`/tileset.json and a glTF for each tile, each in a frame of its own, so that the
/// Earth's curvature is followed. City objects, lamps and windows are features (EXT_mesh_features)
/// with their identity, class and, of lights, where each value comes from
/// (EXT_structural_metadata); lamps are lights too, as LampForm says. `lights`: of the same scene; null:
/// no lights. `folder` must not hold a tileset. Throws Error: the scene has no CRS, a file cannot
/// be written.
TilesetReport write_tileset(const Scene& scene, const LightFile* lights,
                            const std::filesystem::path& folder, const TilesetOptions& options);

}  // namespace nightcity::exports
