// nightview render SCENE.glb -o night.png: renders a picture without a window.
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <future>
#include <limits>
#include <memory>
#include <optional>

#include "formats/error.h"
#include "formats/program/number_check.h"
#include "formats/program/output.h"
#include "formats/program/progress_display.h"
#include "runtime/experiments/governed.h"
#include "runtime/measure/exposure.h"
#include "runtime/measure/noise.h"
#include "runtime/nightview/commands.h"
#include "runtime/nightview/governor_options.h"
#include "runtime/nightview/picture_outputs.h"
#include "runtime/nightview/render_options.h"
#include "runtime/render/parse.h"
#include "runtime/render/renderer.h"

namespace nightcity::nightview {
namespace {

using Clock = std::chrono::steady_clock;

struct RenderCommand {
  RenderOptions options;
  PictureOutputs outputs;
  std::string exposure = "auto";
  std::string tone = "filmic";
  std::string projection = "perspective";
  std::string save_camera;
  std::uint32_t frames = 64;
  render::GovernorOptions governor;
};

float find_exposure(const std::string& text, const render::Renderer& renderer) {
  if (const std::optional<float> chosen = render::parse_exposure(text)) return *chosen;
  const std::size_t pixels = std::size_t{renderer.width()} * renderer.height();
  return measure::auto_exposure_ev100(renderer.sample_mean(pixels));
}

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// The frames of a picture, and what they were made with.
struct RenderedFrames {
  std::uint32_t frames = 0;
  measure::Image image;
  std::optional<double> noise;  // of the picture, where it was asked for
};

// Returns the effort that keeps the budget of milliseconds, and logs the choice.
render::Effort choose_effort(const RenderCommand& command,
                             const std::function<render::Renderer()>& make_renderer,
                             const scene::CameraPose& pose, program::ProgressDisplay& progress) {
  render::GovernorOptions options = command.governor;
  options.target_error = 0;  // more frames keep it
  if (!(options.budget_ms > 0)) return {};
  const render::Governor governor(
      experiments::measure_rungs(make_renderer,
                                 {render::at_rest(pose, command.options.settings.time_s)},
                                 command.options.settings, false,
                                 [&](std::size_t done, std::size_t all) {
                                   progress.show({"measuring settings", done, all, "settings"});
                                 }),
      options);
  progress.clear();
  spdlog::info("{}", render::describe_start(governor, options));
  return governor.effort();
}

void render_frame(render::Renderer& renderer, const scene::CameraPose& pose,
                  const render::RenderSettings& settings, const render::Effort& effort) {
  constexpr double whole = std::numeric_limits<double>::infinity();
  renderer.begin_frame(pose, settings, effort);
  while (!renderer.continue_frame(whole, whole)) {
  }
}

// Renders the frames asked for; with a target, two pictures with other seeds side by side, until
// the noise of their mean is below it: half of their difference's. The noise of frames of one
// picture is not seen in that picture, because they reuse each other's samples.
RenderedFrames render_frames(const RenderCommand& command, render::Renderer& renderer,
                             const std::function<render::Renderer()>& make_renderer,
                             const scene::CameraPose& pose, program::ProgressDisplay& progress) {
  const render::RenderSettings& settings = command.options.settings;
  const render::Effort effort = choose_effort(command, make_renderer, pose, progress);
  const bool layers = settings.sampling.layers || writes_figures(command.outputs);
  const double target = command.governor.target_error;
  RenderedFrames result;
  std::unique_ptr<render::Renderer> other;
  render::RenderSettings other_settings = settings;
  if (target > 0) {
    other.reset(new render::Renderer(make_renderer()));  // it cannot be moved
    other_settings.sampling.seed = ~settings.sampling.seed;
  }
  const std::uint32_t rounds = other ? (command.frames + 1) / 2 : command.frames;
  std::uint32_t next_look = 2;
  for (std::uint32_t i = 1; i <= rounds; ++i) {
    render_frame(renderer, pose, settings, effort);
    if (other) render_frame(*other, pose, other_settings, effort);
    result.frames += other ? 2 : 1;
    progress.show({"rendering", result.frames, other ? 2 * rounds : rounds, "frames"});
    if (!other || (i < next_look && i < rounds)) continue;
    const std::array<measure::Image, 2> pictures{renderer.download(false), other->download(false)};
    result.noise = measure::find_relative_noise(pictures) / std::sqrt(2.0);
    if (*result.noise <= target) break;
    next_look = i + std::max(1u, i / 4);
  }
  result.image = renderer.download(layers);
  if (other) measure::average_light(result.image, other->download(layers));
  return result;
}

void warn_of_lights(const RenderOptions& options, const scene::RenderScene& scene) {
  if (scene.lights.empty())
    spdlog::warn("{}: no lights, so only surfaces that emit light are seen", options.scene);
}

void render(RenderCommand& command) {
  RenderOptions& options = command.options;
  const bool measures = writes_figures(command.outputs);
  options.to_be_looked_at =
      !measures && (command.outputs.show == "picture" || find_device_view(command.outputs.show));
  options.resolve();
  options.settings.display.tone = measure::tone_curve_from_name(command.tone);
  options.settings.projection = render::find_projection(command.projection);
  if (command.outputs.markers && options.settings.projection != PROJECTION_PERSPECTIVE)
    throw UsageError("--markers", "are drawn in perspective pictures alone");
  render::parse_exposure(command.exposure);  // throws early
  check_outputs(command.outputs);
  // At half rate an EXR has the picture and its surfaces: light by kind is kept where every pixel
  // is sampled.
  options.settings.sampling.layers = find_illumination(command.outputs.show).has_value() ||
                                     (measures && !render::is_half_rate(options.settings));
  if (const auto view = find_device_view(command.outputs.show)) {
    render::keep_what_view_needs(*view, options.settings.sampling);
    options.settings.sampling.resolution_scale = 1;
  }

  const auto load_start = Clock::now();
  // The driver starts while the scene is read.
  auto starting =
      std::async(std::launch::async, [&] { return std::make_unique<gpu::Device>(options.device); });
  scene::RenderScene scene = options.load();
  const std::size_t triangles = scene.triangles.size();
  const scene::CameraPose pose = scene::find_camera(options.camera, scene);
  if (!command.save_camera.empty()) scene::write_camera(command.save_camera, pose);
  const std::unique_ptr<gpu::Device> started = starting.get();
  gpu::Device& device = *started;
  render::DeviceScene device_scene(device, scene, render::ReleaseGeometry{},
                                   options.settings.light_moment());
  render::PassLibrary passes(device);
  render::Renderer renderer(device, passes, device_scene, options.width, options.height);
  spdlog::info("{}: {} triangles, {} lights, loaded in {:.2f} s; rendering on {}", options.scene,
               triangles, scene.lights.size(), seconds_since(load_start), device.label());
  warn_of_lights(options, scene);

  const auto start = Clock::now();
  program::ProgressDisplay progress;
  RenderedFrames rendered = render_frames(
      command, renderer,
      [&] { return render::Renderer(device, passes, device_scene, options.width, options.height); },
      pose, progress);
  progress.clear();
  const double seconds = seconds_since(start);
  device.check_validation();

  measure::Image& image = rendered.image;
  render::DisplaySettings& display = options.settings.display;
  display.ev100 = find_exposure(command.exposure, renderer);
  if (display.adapt_white)
    display.adapted_to = measure::mean_light(renderer.sample_mean(image.pixels()));
  image.info.ev100 = display.ev100;
  if (command.outputs.show == "picture") image.info.eye = render::describe_eye(display);
  image.info.licences = scene::describe_licences(scene);
  image.info.camera = scene::to_text(pose);
  image.info.time = render::time_text(options.settings.time_s);
  write_outputs(command.outputs, image, renderer, display, scene, pose);
  spdlog::info("{} frames of {} in {:.2f} s, EV100 {:.1f}", rendered.frames,
               render::name_of(options.settings.sampling.estimator), seconds, *image.info.ev100);
  if (rendered.noise)
    spdlog::info("noise {:.3g} of relative RMSE, {} the target of {:g}", *rendered.noise,
                 *rendered.noise <= command.governor.target_error ? "within" : "ABOVE",
                 command.governor.target_error);
  for (const std::string& output : command.outputs.files) fmt::print("{}\n", output);
}

}  // namespace

void add_render_command(CLI::App& app) {
  auto command = std::make_shared<RenderCommand>();
  CLI::App* sub =
      app.add_subcommand("render", "Render a baked scene to a picture, without a window");
  sub->footer(
      "Examples:\n"
      "  nightview render out/demo/city.glb -o night.png --camera street\n"
      "  nightview render city.glb -o truth.exr --estimator reference --frames 64 --size 960x540\n"
      "  nightview render city.glb -o wet.png --camera street --time 23:30 --wet 0.8 --moon "
      "160,35\n"
      "  nightview render city.glb -o lux.png --camera top --show illuminance\n"
      "  nightview render city.glb -o yard.png --camera street --bounces 8 --show "
      "indirect-illuminance\n"
      "  nightview render city.glb -o clean.png --target-error 0.02 --frames 4096\n"
      "  nightview render city.glb -o quick.png --preset fast --settings cheap.toml\n"
      "  nightview render city.glb -o a.exr -o a.png --candidates 8 --neighbours 2 --ev 2.5");
  command->options.settings.indirect.bounces = render::picture_bounces;
  command->options.settings.air.candidates = render::picture_air_candidates;
  command->options.settings.air.block = render::picture_air_block;
  command->options.declare(*sub);
  program::add_output_option(
      *sub, command->outputs.files,
      "NAME.png (8-bit sRGB) or NAME.exr (cd/m2 with layers); may be repeated")
      ->required();
  sub->add_option("--frames", command->frames,
                  "Frames that are averaged; with --target-error, at most")
      ->capture_default_str()
      ->check(program::count_from(1, 1000000));
  declare_governor(*sub, command->governor);
  sub->add_option("--ev", command->exposure, "Exposure, EV100, or 'auto'")->capture_default_str();
  sub->add_option("--tone", command->tone, "Tone curve of the PNG: filmic, reinhard or linear")
      ->capture_default_str();
  sub->add_option(
         "--show", command->outputs.show,
         "What a PNG shows: picture; in false colours with a scale luminance, illuminance, "
         "direct-illuminance or indirect-illuminance; wireframe: the picture with the edges of all "
         "triangles; or tiles: a colour for each piece of 256 triangles")
      ->capture_default_str()
      ->check(CLI::IsMember({"picture", "luminance", "illuminance", "direct-illuminance",
                             "indirect-illuminance", "wireframe", "tiles"}));
  declare_projection(*sub, command->projection);
  sub->add_flag("--markers", command->outputs.markers,
                "Mark every light in the PNG, hidden ones too");
  sub->add_option("--save-camera", command->save_camera, "Write the camera used to a JSON file");
  sub->callback([command] { render(*command); });
}

}  // namespace nightcity::nightview
