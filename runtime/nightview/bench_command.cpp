// nightview bench SCENE.glb: GPU time of every pass, by the device's own clock.
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "formats/error.h"
#include "formats/median.h"
#include "formats/program/number_check.h"
#include "formats/program/print_json.h"
#include "runtime/experiments/experiment.h"
#include "runtime/nightview/commands.h"
#include "runtime/nightview/render_options.h"
#include "runtime/render/copy_speed.h"
#include "runtime/render/record_traffic.h"
#include "runtime/render/renderer.h"

namespace nightcity::nightview {
namespace {

struct BenchCommand {
  RenderOptions options;
  std::uint32_t frames = 32, warm_up = 4;
  bool json = false, forced = false;
};

// Milliseconds of the timed frames.
struct FrameTimes {
  std::vector<std::string> order;  // of the passes in a frame
  std::map<std::string, std::vector<double>> passes;
  std::vector<double> gpu, wall;
  std::vector<double> display;       // showing the picture through an eye, where the settings do
  double shadow_rays_per_pixel = 0;  // of a frame after the timed ones
};

// The least that each pass of a frame moves in memory, and how fast the device copies.
struct MemoryTraffic {
  std::map<std::string, double> bytes;  // of a frame; passes without a bound are absent
  double copied_per_s = 0;              // bytes; 0 = not known

  // Returns the milliseconds in which the device copies as much, nothing where either is unknown.
  std::optional<double> find_least_ms(const std::string& pass) const {
    const auto found = bytes.find(pass);
    if (found == bytes.end() || copied_per_s <= 0) return std::nullopt;
    return found->second / copied_per_s * 1000;
  }
};

// The device may have no room for what is copied, which is more than a scene needs: the times of
// passes stand without it.
double find_copy_speed(gpu::Device& device) {
  try {
    return render::measure_copy_speed(device);
  } catch (const Error& error) {
    spdlog::warn("how fast the device copies is not known: {}", error.what());
    return 0;
  }
}

// Returns the traffic of the frame that the renderer made last.
MemoryTraffic find_traffic(gpu::Device& device, const render::Renderer& renderer,
                           const render::RenderSettings& settings) {
  MemoryTraffic traffic{{}, find_copy_speed(device)};
  for (const auto& [pass, bytes] : render::find_record_bytes(settings))
    traffic.bytes[pass] = double(bytes) * renderer.width() * renderer.height();
  return traffic;
}

struct Spread {
  double min, median, max;
};

Spread spread(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return {values.front(), values[values.size() / 2], values.back()};
}

FrameTimes time_frames(render::Renderer& renderer, const scene::CameraPose& pose,
                       const render::RenderSettings& settings, std::uint32_t frames) {
  FrameTimes times;
  for (std::uint32_t i = 0; i < frames; ++i) {
    const auto start = std::chrono::steady_clock::now();
    renderer.render_frame(pose, settings);
    const std::chrono::duration<double, std::milli> wall = std::chrono::steady_clock::now() - start;
    times.wall.push_back(wall.count());
    std::map<std::string, double> frame;
    for (const auto& span : renderer.timings()) {
      if (!times.passes.count(span.name) && !frame.count(span.name))
        times.order.push_back(span.name);
      frame[span.name] += span.ms;
    }
    for (const auto& [name, ms] : frame) times.passes[name].push_back(ms);
    times.gpu.push_back(experiments::sum_gpu_ms(renderer));
  }
  return times;
}

// Returns the wall-clock milliseconds that it takes to show the picture, by number of the try.
std::vector<double> time_display(render::Renderer& renderer,
                                 const render::DisplaySettings& display) {
  std::vector<double> times;
  constexpr int tries = 17;
  for (int i = 0; i <= tries; ++i) {
    const auto start = std::chrono::steady_clock::now();
    renderer.expose(display);
    const std::chrono::duration<double, std::milli> wall = std::chrono::steady_clock::now() - start;
    if (i > 0) times.push_back(wall.count());  // the first one compiles
  }
  return times;
}

// Counting slows the passes down, so a frame is rendered for it alone.
double count_shadow_rays(render::Renderer& renderer, const scene::CameraPose& pose,
                         render::RenderSettings settings) {
  settings.count_rays = true;
  renderer.render_frame(pose, settings);
  return double(renderer.shadow_rays()) / (double(renderer.width()) * double(renderer.height()));
}

// Prints the cost of compiling in features that the scene lacks. Frames with and without the
// feature alternate, so that a drifting clock rate affects both alike.
void price_forced_features(const BenchCommand& command, render::Renderer& renderer,
                           const scene::CameraPose& pose) {
  const render::RenderSettings& needed = command.options.settings;
  const std::vector<render::Feature> features = renderer.list_unneeded(needed);
  std::vector<std::pair<std::string, std::uint32_t>> rows;
  std::uint32_t all = 0;
  for (const render::Feature& feature : features) {
    rows.emplace_back(feature.name, 1u << feature.constant);
    all |= 1u << feature.constant;
  }
  if (features.size() > 1) rows.emplace_back("all of these", all);
  fmt::print("\n| not needed here | ms without | ms with | ratio |\n|---|---:|---:|---:|\n");
  for (const auto& [name, forced] : rows) {
    render::RenderSettings settings = needed;
    settings.forced_features = forced;
    std::vector<double> without, with;
    for (std::uint32_t i = 0; i < command.warm_up; ++i) renderer.render_frame(pose, settings);
    for (std::uint32_t i = 0; i < command.frames; ++i) {
      renderer.render_frame(pose, needed);
      without.push_back(experiments::sum_gpu_ms(renderer));
      renderer.render_frame(pose, settings);
      with.push_back(experiments::sum_gpu_ms(renderer));
    }
    const double a = median(without), b = median(with);
    fmt::print("| {} | {:.3g} | {:.3g} | {:.2f} |\n", name, a, b, b / a);
  }
}

// Prints what it costs to show the picture with what an eye or a camera adds and these settings do
// without. It is no part of a frame.
void price_display(const render::DisplaySettings& needed, render::Renderer& renderer) {
  struct Row {
    const char* name;
    bool is_needed;
    void (*add)(render::DisplaySettings& display);
  };
  const Row rows[] = {
      {"glare", needed.glare_age > 0, [](render::DisplaySettings& d) { d.glare_age = 30; }},
      {"white balance", needed.white_balance_k > 0 || needed.adapt_white,
       [](render::DisplaySettings& d) { d.white_balance_k = 3200; }},
      {"mesopic colours", needed.mesopic, [](render::DisplaySettings& d) { d.mesopic = true; }}};
  fmt::print("\n| not shown here | display ms without | with | ratio |\n|---|---:|---:|---:|\n");
  for (const Row& row : rows) {
    if (row.is_needed) continue;
    render::DisplaySettings more = needed;
    row.add(more);
    const double a = median(time_display(renderer, needed)),
                 b = median(time_display(renderer, more));
    fmt::print("| {} | {:.3g} | {:.3g} | {:.2f} |\n", row.name, a, b, b / a);
  }
}

nlohmann::ordered_json to_json(const std::vector<double>& ms) {
  const Spread s = spread(ms);
  return {{"min", s.min}, {"median", s.median}, {"max", s.max}};
}

void print_as_json(const RenderOptions& options, const scene::RenderScene& scene,
                   const gpu::Device& device, std::size_t scene_bytes, const FrameTimes& times,
                   const MemoryTraffic& traffic) {
  nlohmann::ordered_json json{{"device", device.label()},
                              {"driver", device.info().driver},
                              {"scene", options.scene},
                              {"triangles", scene.triangles.size()},
                              {"instances", scene.instances.size()},
                              {"lights", scene.lights.size()},
                              {"scene_bytes", scene_bytes},
                              {"size", {options.width, options.height}},
                              {"estimator", render::name_of(options.settings.sampling.estimator)},
                              {"candidates", options.settings.sampling.candidates},
                              {"neighbours", options.settings.reuse.neighbours},
                              {"frames", times.gpu.size()},
                              {"gpu_ms", to_json(times.gpu)},
                              {"wall_ms", to_json(times.wall)}};
  json["shadow_rays_per_pixel"] = times.shadow_rays_per_pixel;
  if (!times.display.empty()) json["display_ms"] = to_json(times.display);
  for (const std::string& name : times.order)
    json["passes_ms"][name] = to_json(times.passes.at(name));
  json["copied_bytes_per_s"] = traffic.copied_per_s;
  for (const std::string& name : times.order)
    if (traffic.bytes.count(name)) json["record_bytes"][name] = traffic.bytes.at(name);
  program::print_json(json);
}

void print_as_table(const RenderOptions& options, const scene::RenderScene& scene,
                    const gpu::Device& device, const FrameTimes& times,
                    const MemoryTraffic& traffic) {
  fmt::print("{}: {} triangles, {} lights, {}x{}, {} on {}\n", options.scene,
             scene.triangles.size(), scene.lights.size(), options.width, options.height,
             render::name_of(options.settings.sampling.estimator), device.label());
  fmt::print("{:<15} {:>10} {:>10} {:>10} {:>10} {:>10}   ms of {} frames\n", "pass", "min",
             "median", "max", "MB", "copied in", times.gpu.size());
  const auto print_row = [&](const std::string& name, const std::vector<double>& ms) {
    const Spread s = spread(ms);
    fmt::print("{:<15} {:>10.3f} {:>10.3f} {:>10.3f}", name, s.min, s.median, s.max);
    const auto bytes = traffic.bytes.find(name);
    if (bytes != traffic.bytes.end()) fmt::print(" {:>10.1f}", bytes->second / 1e6);
    if (const auto least = traffic.find_least_ms(name)) fmt::print(" {:>10.3f}", *least);
    fmt::print("\n");
  };
  for (const std::string& name : times.order) print_row(name, times.passes.at(name));
  print_row("GPU", times.gpu);
  print_row("wall clock", times.wall);
  if (!times.display.empty()) print_row("display", times.display);
  fmt::print("{:.2f} shadow rays per pixel\n", times.shadow_rays_per_pixel);
  if (traffic.copied_per_s > 0)
    fmt::print(
        "MB: the records of pixels that a pass reads and writes, each once; the device copies "
        "{:.3g} GB/s\n",
        traffic.copied_per_s / 1e9);
}

void bench(BenchCommand& command) {
  RenderOptions& options = command.options;
  options.resolve();
  const scene::RenderScene scene = options.load();
  const scene::CameraPose pose = scene::find_camera(options.camera, scene);
  gpu::Device device(options.device);
  render::DeviceScene device_scene(device, scene, options.settings.light_moment());
  render::PassLibrary library(device);
  render::Renderer renderer(device, library, device_scene, options.width, options.height);
  for (std::uint32_t i = 0; i < command.warm_up; ++i) renderer.render_frame(pose, options.settings);
  experiments::wake(device, [&] { renderer.render_frame(pose, options.settings); });

  FrameTimes times = time_frames(renderer, pose, options.settings, command.frames);
  times.shadow_rays_per_pixel = count_shadow_rays(renderer, pose, options.settings);
  if (render::has_eye(options.settings.display))
    times.display = time_display(renderer, options.settings.display);
  const MemoryTraffic traffic = find_traffic(device, renderer, options.settings);
  device.check_validation();
  if (command.json) {
    print_as_json(options, scene, device, device_scene.bytes(), times, traffic);
    return;
  }
  print_as_table(options, scene, device, times, traffic);
  if (!command.forced) return;
  price_forced_features(command, renderer, pose);
  price_display(options.settings.display, renderer);
}

}  // namespace

void add_bench_command(CLI::App& app) {
  auto command = std::make_shared<BenchCommand>();
  CLI::App* sub = app.add_subcommand("bench", "Time every pass of a frame by the device's clock");
  sub->footer(
      "Examples:\n"
      "  nightview bench city.glb --json --estimator paper --candidates 32 --size 1920x1080\n"
      "  nightview bench city.glb --forced");
  command->options.declare(*sub);
  sub->add_option("--frames", command->frames, "Frames timed")
      ->capture_default_str()
      ->check(program::count_from(1, 100000));
  sub->add_option("--warm-up", command->warm_up,
                  "Frames before the first timed one; on a GPU, one more second of frames follows")
      ->capture_default_str()
      ->check(program::count_from(0, 100000));
  auto* json = sub->add_flag("--json", command->json, "Print the results as JSON");
  sub->add_flag("--forced,--needless", command->forced,
                "Also time passes with features compiled in that this scene does not need, and the "
                "display with what these settings do not show: what leaving them out saves")
      ->excludes(json);
  sub->callback([command] { bench(*command); });
}

}  // namespace nightcity::nightview
