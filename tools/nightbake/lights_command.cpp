// nightbake lights: what the lights of a light file are, and where their values come from.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "formats/program/print_json.h"
#include "formats/scene_identity.h"
#include "formats/scene_reader.h"
#include "tools/bake/report/report_text.h"
#include "tools/bake/scene/light_places.h"
#include "tools/lights/light_statistics.h"
#include "tools/nightbake/commands.h"

namespace nightcity::nightbake {
namespace {

using nlohmann::json;

struct LightsArguments {
  std::string file, scene;
  bool json = false;
};

std::string hour_name(std::size_t index) {
  return fmt::format("{:02}:00", lights::clock_hour(index));
}

json statistics_json(const LightFile& file, const lights::LightStatistics& statistics) {
  json families = json::object();
  for (const auto& [name, family] : statistics.families) {
    json hours = json::object();
    for (std::size_t hour = 0; hour < lights::night_hours; ++hour)
      hours[hour_name(hour)] = family.lit[hour];
    families[name] = {{"count", family.count},         {"flux_lm", family.flux_lm},
                      {"kinds", family.kinds},         {"sources", family.sources},
                      {"always_on", family.always_on}, {"lit", hours}};
  }
  return {{"lights", file.lights().size()},
          {"profiles", file.profiles().size()},
          {"schedules", file.schedules().size()},
          {"families", families},
          {"traffic",
           {{"drives", file.traffic().trips.size()},
            {"kinds", file.traffic().vehicles.size()},
            {"lights", file.traffic().vehicle_lights.size()}}},
          {"faults", statistics.faults}};
}

void print(const LightFile& file, const lights::LightStatistics& statistics) {
  fmt::print("{} lights, {} profiles, {} schedules\n", file.lights().size(), file.profiles().size(),
             file.schedules().size());
  for (const auto& [name, family] : statistics.families) {
    std::string kinds;
    for (const auto& [kind, count] : family.kinds)
      kinds += fmt::format("{}{} {}", kinds.empty() ? "" : ", ", count, kind);
    fmt::print("\n{}: {} ({}), {:.1f} klm, {} always on\n", name, family.count, kinds,
               family.flux_lm / 1000, family.always_on);
    fmt::print("{:<10}{:>10}{:>10}{:>10}{:>10}{:>10}\n", "from", "tag", "attribute", "rule",
               "standard", "inventory", "unknown");
    for (const auto& [value, sources] : family.sources) {
      fmt::print("{:<10}", value);
      for (const char* source : {"tag", "attribute", "rule", "standard", "inventory", "unknown"}) {
        const auto found = sources.find(source);
        fmt::print("{:>10}", found == sources.end() ? 0 : found->second);
      }
      fmt::print("\n");
    }
    std::string hours = fmt::format("{:<10}", "hour"), shares = fmt::format("{:<10}", "% lit");
    for (std::size_t hour = 0; hour < lights::night_hours; ++hour) {
      hours += fmt::format("{:>4}", lights::clock_hour(hour));
      shares += fmt::format("{:>4.0f}", 100 * static_cast<double>(family.lit[hour]) /
                                            static_cast<double>(family.count));
    }
    fmt::print("{}\n{}\n", hours, shares);
  }
  if (const TrafficContent traffic = file.traffic(); !traffic.trips.empty())
    fmt::print("\ntraffic: {} trips in {:.0f} s, {} kinds of vehicle\n", traffic.trips.size(),
               traffic.cycle.cycle_s, traffic.vehicles.size());
  fmt::print("\nfaults: {}\n", bake::in_words(statistics.faults));
}

void run(const LightsArguments& arguments) {
  const LightFile file = LightFile::open(arguments.file);
  file.verify();
  lights::PlaceFault place_fault;
  if (!arguments.scene.empty()) {
    require_same_scene(arguments.scene, read_scene_georeference(arguments.scene), arguments.file,
                       file.georeference());
    place_fault = bake::find_place_faults(arguments.scene);
  }
  const lights::LightStatistics statistics = lights::count_lights(file, place_fault);
  if (arguments.json)
    program::print_json(statistics_json(file, statistics));
  else
    print(file, statistics);
}

}  // namespace

void add_lights_command(CLI::App& app) {
  auto* command = app.add_subcommand(
      "lights", "Summarise a light file: kinds, lumens, hours, sources of the values");
  auto arguments = std::make_shared<LightsArguments>();
  command->add_option("file,--report", arguments->file, "The light file (.lights)")->required();
  command->add_option("--scene", arguments->scene,
                      "Its city.glb: also count lights below the ground and inside buildings");
  command->add_flag("--json", arguments->json, "Print JSON");
  command->footer("Example: nightbake lights out/city.lights --scene out/city.glb");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace nightcity::nightbake
