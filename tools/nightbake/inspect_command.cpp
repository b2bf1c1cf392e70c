// nightbake inspect: what a CityGML, CityJSON, OSM, glTF, light or luminaire file holds.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "formats/program/number_check.h"
#include "formats/program/print_json.h"
#include "formats/to_lower.h"
#include "tools/inputs/file_format.h"
#include "tools/nightbake/commands.h"
#include "tools/nightbake/inspect.h"

namespace nightcity::nightbake {
namespace {

struct InspectArguments {
  std::string file;
  bool json = false;
  int lod = 2;
};

Inspection inspect(const std::filesystem::path& file, int lod) {
  const inputs::FileFormat& format = inputs::find_format(file);
  switch (format.kind) {
    case inputs::FileKind::city:
      return inspect_city(file, to_lower(format.name), lod);
    case inputs::FileKind::osm:
      return inspect_osm(file);
    case inputs::FileKind::scene:
      return inspect_scene(file);
    case inputs::FileKind::lights:
      return inspect_lights(file);
    case inputs::FileKind::luminaire:
      break;
  }
  return inspect_luminaire(file);
}

std::string describe(const Inspection& value) {
  if (value.is_null()) return "-";
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) return fmt::format("{:.3f}", value.get<double>());
  if (!value.is_structured()) return value.dump();
  std::string text;
  for (const auto& [key, element] : value.items()) {
    if (!text.empty()) text += ", ";
    if (value.is_object()) text += key + (element.is_structured() ? ": " : " ");
    text += element.is_structured() ? "(" + describe(element) + ")" : describe(element);
  }
  return text.empty() ? "none" : text;
}

void run(const InspectArguments& arguments) {
  const Inspection inspection = inspect(arguments.file, arguments.lod);
  if (arguments.json) return program::print_json(inspection);
  for (const auto& [key, value] : inspection.items())
    fmt::print("{:<22}{}\n", key, describe(value));
}

}  // namespace

void add_inspect_command(CLI::App& app) {
  auto* command = app.add_subcommand(
      "inspect",
      "Print what a CityGML, CityJSON, OSM, .glb/.gltf, .lights, IES, EULUMDAT, TM-33 or GLDF "
      "file holds");
  auto arguments = std::make_shared<InspectArguments>();
  command->add_option("file", arguments->file, "The file; its content decides what kind it is")
      ->required();
  command->add_flag(
      "--json", arguments->json,
      "Print JSON: kind, buildings, polygons, triangles, lights, crs, bbox, skipped, ...");
  command->add_option("--lod", arguments->lod, "City models: the highest level of detail to use")
      ->capture_default_str()
      ->check(program::count_from(0, 4));
  command->footer(
      "Examples:\n  nightbake inspect berlin/3910_5819.gml\n  nightbake inspect --json "
      "out/city.lights | jq .lights");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace nightcity::nightbake
