// nightview bench SCENE.glb: GPU time of every pass, by the device's own clock.
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "runtime/nightview/commands.h"
#include "runtime/nightview/experiment.h"
#include "runtime/nightview/render_options.h"
#include "runtime/render/renderer.h"

namespace nightcity {
namespace {

struct BenchCommand {
  RenderOptions options;
  std::uint32_t frames = 32, warm_up = 4;
  bool json = false, needless = false;
};

struct Spread {
  double min, median, max;
};

Spread spread(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return {values.front(), values[values.size() / 2], values.back()};
}

// What the passes would cost if they could do what the scene lacks: frames with and without, turn by turn.
void price_what_is_not_needed(const BenchCommand& command, Renderer& renderer,
                              const CameraPose& pose) {
  const RenderSettings& plain = command.options.settings;
  const std::vector<Feature> features = renderer.not_needed(plain);
  std::vector<std::pair<std::string, std::uint32_t>> rows;
  std::uint32_t all = 0;
  for (const Feature& feature : features) {
    rows.emplace_back(feature.name, 1u << feature.constant);
    all |= 1u << feature.constant;
  }
  if (features.size() > 1) rows.emplace_back("all of these", all);
  fmt::print("\n| not needed here | ms without | ms with | ratio |\n|---|---:|---:|---:|\n");
  for (const auto& [name, needless] : rows) {
    RenderSettings settings = plain;
    settings.needless = needless;
    std::vector<double> without, with;
    for (std::uint32_t i = 0; i < command.warm_up; ++i) renderer.render_frame(pose, settings);
    for (std::uint32_t i = 0; i < command.frames; ++i) {
      renderer.render_frame(pose, plain);
      without.push_back(gpu_ms(renderer));
      renderer.render_frame(pose, settings);
      with.push_back(gpu_ms(renderer));
    }
    const double a = median(without), b = median(with);
    fmt::print("| {} | {:.3g} | {:.3g} | {:.2f} |\n", name, a, b, b / a);
  }
}

void bench(BenchCommand& command) {
  RenderOptions& options = command.options;
  options.resolve();
  const RenderScene scene = options.load();
  const CameraPose pose = find_camera(options.camera, scene);
  gpu::Device device(options.device);
  DeviceScene device_scene(device, scene);
  PassLibrary library(device);
  Renderer renderer(device, library, device_scene, options.width, options.height);
  for (std::uint32_t i = 0; i < command.warm_up; ++i) renderer.render_frame(pose, options.settings);
  wake(device, [&] { renderer.render_frame(pose, options.settings); });

  std::vector<std::string> order;
  std::map<std::string, std::vector<double>> passes;
  std::vector<double> total_ms, wall_ms;
  for (std::uint32_t i = 0; i < command.frames; ++i) {
    const auto start = std::chrono::steady_clock::now();
    renderer.render_frame(pose, options.settings);
    wall_ms.push_back(
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
            .count());
    std::map<std::string, double> frame;
    for (const auto& span : renderer.timings()) {
      if (!passes.count(span.name) && !frame.count(span.name)) order.push_back(span.name);
      frame[span.name] += span.ms;
    }
    for (const auto& [name, ms] : frame) passes[name].push_back(ms);
    total_ms.push_back(gpu_ms(renderer));
  }
  device.check_validation();

  const auto as_json = [](const Spread& s) {
    return nlohmann::ordered_json{{"min", s.min}, {"median", s.median}, {"max", s.max}};
  };
  if (command.json) {
    nlohmann::ordered_json json{{"device", device.label()},
                                {"driver", device.info().driver},
                                {"scene", options.scene},
                                {"triangles", scene.triangles.size()},
                                {"instances", scene.instances.size()},
                                {"lights", scene.lights.size()},
                                {"scene_bytes", device_scene.bytes()},
                                {"size", {options.width, options.height}},
                                {"estimator", name_of(options.settings.estimator)},
                                {"candidates", options.settings.candidates},
                                {"neighbours", options.settings.neighbours},
                                {"frames", command.frames},
                                {"gpu_ms", as_json(spread(total_ms))},
                                {"wall_ms", as_json(spread(wall_ms))}};
    for (const std::string& name : order) json["passes_ms"][name] = as_json(spread(passes[name]));
    fmt::print("{}\n", json.dump(2));
    return;
  }
  fmt::print("{}: {} triangles, {} lights, {}x{}, {} on {}\n", options.scene,
             scene.triangles.size(), scene.lights.size(), options.width, options.height,
             name_of(options.settings.estimator), device.label());
  fmt::print("{:<12} {:>10} {:>10} {:>10}   ms of {} frames\n", "pass", "min", "median", "max",
             command.frames);
  for (const std::string& name : order) {
    const Spread s = spread(passes[name]);
    fmt::print("{:<12} {:>10.3f} {:>10.3f} {:>10.3f}\n", name, s.min, s.median, s.max);
  }
  const Spread total = spread(total_ms), wall = spread(wall_ms);
  fmt::print("{:<12} {:>10.3f} {:>10.3f} {:>10.3f}\n", "GPU", total.min, total.median, total.max);
  fmt::print("{:<12} {:>10.3f} {:>10.3f} {:>10.3f}\n", "wall clock", wall.min, wall.median,
             wall.max);
  if (command.needless) price_what_is_not_needed(command, renderer, pose);
}

}  // namespace

void add_bench_command(CLI::App& app) {
  auto command = std::make_shared<BenchCommand>();
  CLI::App* sub = app.add_subcommand("bench", "Time every pass of a frame by the device's clock");
  sub->footer(
      "Examples:\n  nightview bench city.glb --json --estimator paper --candidates 32 --size "
      "1920x1080\n"
      "  nightview bench city.glb --needless");
  command->options.declare(*sub);
  sub->add_option("--frames", command->frames, "Frames timed")
      ->capture_default_str()
      ->check(CLI::Range(1u, 100000u));
  sub->add_option("--warm-up", command->warm_up,
                  "Frames before the first timed one; on a GPU, those of a second besides")
      ->capture_default_str();
  auto* json = sub->add_flag("--json", command->json, "Machine-readable");
  sub->add_flag("--needless", command->needless,
                "Also time passes compiled for what this scene lacks: what leaving it out saves")
      ->excludes(json);
  sub->callback([command] { bench(*command); });
}

}  // namespace nightcity
