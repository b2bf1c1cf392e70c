// nightview rays SCENE.glb: how many rays a second the device traces.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>

#include "formats/error.h"
#include "formats/median.h"
#include "formats/program/number_check.h"
#include "formats/program/print_json.h"
#include "runtime/experiments/ray_set.h"
#include "runtime/nightview/commands.h"
#include "runtime/nightview/device_options.h"
#include "runtime/nightview/render_options.h"
#include "runtime/render/parse.h"
#include "runtime/render/ray_probe.h"

namespace nightcity::nightview {
namespace {

constexpr std::uint64_t max_rays = 4'000'000;

struct RaysCommand {
  std::string scene, camera = "street", size = "960x540";
  gpu::Device::Options device;
  std::uint32_t repeats = 20;
  bool json = false;
};

struct RayRate {
  const char* kind;
  std::size_t rays;
  double hit_share, ms;
  double million_a_second() const { return double(rays) / ms / 1000; }
};

RayRate measure(const char* kind, const render::TracedRays& traced) {
  const auto hits = std::count_if(traced.distances.begin(), traced.distances.end(),
                                  [](float distance) { return distance >= 0; });
  // The first times warm the device up.
  const auto timed = std::span(traced.ms).subspan(traced.ms.size() / 2);
  return {kind, traced.distances.size(), double(hits) / double(traced.distances.size()),
          median(std::vector<double>(timed.begin(), timed.end()))};
}

void count_rays(const RaysCommand& command) {
  const render::PictureSize size = render::parse_size(command.size);
  if (std::uint64_t{size.width} * size.height > max_rays)
    throw Error("--size", "has more than 4 million pixels: so many rays are one dispatch");
  const scene::RenderScene scene = load_and_report(command.scene);
  const scene::CameraPose pose = scene::find_camera(command.camera, scene);
  gpu::Device device(command.device);
  render::DeviceScene device_scene(device, scene);
  render::PassLibrary library(device);
  const auto primary = experiments::make_primary_rays(pose, size.width, size.height);
  const auto shadow = experiments::make_shadow_rays(scene, primary);
  const auto trace = [&](const std::vector<gpu::ProbeRay>& rays, bool any_hit) {
    return render::trace_rays(device, library, device_scene, rays, any_hit, 2 * command.repeats);
  };
  std::vector<RayRate> rates{measure("primary", trace(primary, false))};
  if (!shadow.empty()) rates.push_back(measure("shadow", trace(shadow, true)));
  device.check_validation();
  if (command.json) {
    nlohmann::ordered_json json{{"device", device.label()}, {"scene", command.scene}};
    for (const RayRate& rate : rates)
      json[rate.kind] = {{"rays", rate.rays},
                         {"hit_share", rate.hit_share},
                         {"ms", rate.ms},
                         {"million_rays_per_s", rate.million_a_second()}};
    program::print_json(json);
    return;
  }
  fmt::print("{}: {} triangles, {}, on {}\n", command.scene, scene.triangles.size(), command.camera,
             device.label());
  fmt::print("{:<8} {:>10} {:>8} {:>10} {:>14}\n", "rays", "number", "hit", "ms", "million a s");
  for (const RayRate& rate : rates)
    fmt::print("{:<8} {:>10} {:>7.1f}% {:>10.3f} {:>14.1f}\n", rate.kind, rate.rays,
               100 * rate.hit_share, rate.ms, rate.million_a_second());
}

}  // namespace

void add_rays_command(CLI::App& app) {
  auto command = std::make_shared<RaysCommand>();
  CLI::App* sub = app.add_subcommand(
      "rays", "Tell how many million primary and shadow rays a second the device traces");
  sub->footer(
      "Primary rays are the camera's; shadow rays go from where these end to lights near there.\n"
      "Nothing else is computed. Vehicles do not move here, and are not met.\n"
      "Examples:\n"
      "  nightview rays city.glb --camera overview --json\n"
      "  nightview rays city.glb --trace pipeline");
  declare_scene(*sub, command->scene);
  sub->add_option("--camera", command->camera, "View: overview, street, or a camera file")
      ->capture_default_str();
  sub->add_option("--size", command->size, "Primary rays, WIDTHxHEIGHT; at most 4 million")
      ->capture_default_str();
  sub->add_option("--repeats", command->repeats, "Times that all rays are traced and timed")
      ->capture_default_str()
      ->check(program::count_from(1, 10'000));
  declare_device(*sub, command->device);
  sub->add_flag("--json", command->json, "Print the results as JSON");
  sub->callback([command] { count_rays(*command); });
}

}  // namespace nightcity::nightview
