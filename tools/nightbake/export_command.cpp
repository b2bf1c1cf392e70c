// nightbake export: a baked scene in the formats of other programs.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <system_error>

#include "formats/error.h"
#include "formats/light_file.h"
#include "formats/program/number_check.h"
#include "formats/program/output.h"
#include "formats/scene_reader.h"
#include "formats/to_lower.h"
#include "tools/exports/light_layer.h"
#include "tools/exports/tileset.h"
#include "tools/nightbake/commands.h"

namespace nightcity::nightbake {
namespace {

struct ExportArguments {
  std::filesystem::path scene, out;
  exports::TilesetOptions tiles;
};

// The file itself, or the one of that name in a folder of a bake.
std::filesystem::path find_file(const std::filesystem::path& scene, const char* name) {
  std::error_code error;
  if (std::filesystem::is_directory(scene, error)) return scene / name;
  const std::string ending = to_lower(scene.extension().string());
  if (ending != ".glb" && ending != ".gltf" && ending != ".lights")
    throw Error(scene.string(),
                "is no scene: name the folder of a bake, or the city.glb or city.lights in it");
  return scene.extension() == std::filesystem::path(name).extension() ? scene
                                                                      : scene.parent_path() / name;
}

void export_layer(const ExportArguments& arguments) {
  const LightFile lights = LightFile::open(find_file(arguments.scene, "city.lights"));
  lights.verify();
  const std::size_t rows = exports::write_light_layer(lights, arguments.out);
  fmt::print("wrote {}: {} lights\n", arguments.out.string(), rows);
}

void export_tileset(const ExportArguments& arguments) {
  const std::filesystem::path glb = find_file(arguments.scene, "city.glb"),
                              file = find_file(arguments.scene, "city.lights");
  const Scene scene = read_scene(glb);
  std::optional<LightFile> lights;
  if (std::error_code error; std::filesystem::exists(file, error)) {
    lights = LightFile::open(file);
    lights->verify();
    const std::string &a = lights->georeference().scene_id, &b = scene.georeference.scene_id;
    if (!a.empty() && !b.empty() && a != b)
      throw Error(file.string(), "belongs to another scene than " + glb.string());
  }
  const exports::TilesetReport report =
      exports::write_tileset(scene, lights ? &*lights : nullptr, arguments.out, arguments.tiles);
  fmt::print("wrote {}: {} tiles, {} triangles, {} features, {} lights\n",
             (arguments.out / "tileset.json").string(), report.tiles, report.triangles,
             report.features, report.lights);
  if (report.vehicles > 0)
    fmt::print("left out: {} meshes of vehicles, which move\n", report.vehicles);
  if (arguments.tiles.geoid_m == 0)
    fmt::print(
        "heights are taken as above the ellipsoid of WGS 84: --geoid says how far their zero "
        "lies above it\n");
}

}  // namespace

void add_export_command(CLI::App& app) {
  auto* command = app.add_subcommand(
      "export",
      "Write the lights of a scene as GeoPackage or FlatGeobuf, or the scene as 3D Tiles");
  auto arguments = std::make_shared<ExportArguments>();
  command->add_option("scene", arguments->scene, "Folder of a bake, or its city.glb or city.lights")
      ->required();
  command
      ->add_option("-o,--out", arguments->out,
                   "NAME.gpkg or NAME.fgb: the lights; any other name: a folder for 3D Tiles 1.1")
      ->required();
  command->add_option("--tile", arguments->tiles.cell_m, "3D Tiles: side of a tile, m")
      ->capture_default_str()
      ->check(program::number_from(10, 100000));
  command
      ->add_option("--geoid", arguments->tiles.geoid_m,
                   "3D Tiles: height of the geoid above WGS 84's ellipsoid there, m")
      ->capture_default_str()
      ->check(program::number_from(-200, 200));
  command
      ->add_option("--lamps", arguments->tiles.lamps,
                   "3D Tiles: lamps as points and spots (punctual, KHR_lights_punctual), or those "
                   "with a luminaire's profile by it (ies, EXT_lights_ies)")
      ->transform(CLI::CheckedTransformer(std::map<std::string, exports::LampForm>{
          {"punctual", exports::LampForm::punctual}, {"ies", exports::LampForm::ies}}))
      ->default_str("punctual");
  command->footer(
      "Examples:\n  nightbake export out/berlin -o lights.gpkg\n  nightbake export out/berlin -o "
      "tiles --geoid 39.5");
  command->callback([arguments] {
    const std::string ending = to_lower(arguments->out.extension().string());
    if (ending == ".gpkg" || ending == ".fgb")
      export_layer(*arguments);
    else
      export_tileset(*arguments);
  });
}

}  // namespace nightcity::nightbake
