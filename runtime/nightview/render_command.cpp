// nightview render SCENE.glb -o night.png: a picture without a window.
#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>

#include "formats/error.h"
#include "runtime/measure/exposure.h"
#include "runtime/measure/exr.h"
#include "runtime/measure/false_colour.h"
#include "runtime/measure/png.h"
#include "runtime/nightview/commands.h"
#include "runtime/nightview/render_options.h"
#include "runtime/render/renderer.h"
#include "runtime/scene/markers.h"

namespace nightcity {
namespace {

using Clock = std::chrono::steady_clock;

struct RenderCommand {
  RenderOptions options;
  std::vector<std::string> outputs;
  std::string exposure = "auto";
  std::string tone = "filmic";
  std::string show = "picture";
  bool markers = false;
  std::string save_camera;
  std::uint32_t frames = 64;
};

bool has_extension(const std::string& file, const char* extension) {
  std::string e = std::filesystem::path(file).extension().string();
  std::transform(e.begin(), e.end(), e.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return e == extension;
}

// Before any work: what cannot be written is said at once, not after the last frame.
void check_outputs(const std::vector<std::string>& outputs) {
  for (const std::string& output : outputs) {
    if (!has_extension(output, ".png") && !has_extension(output, ".exr"))
      throw UsageError("--output", "'" + output + "': a picture's name ends in .png or .exr");
    const std::filesystem::path folder = std::filesystem::absolute(output).parent_path();
    std::error_code ignored;
    std::filesystem::create_directories(folder, ignored);
    if (!std::filesystem::is_directory(folder))
      throw Error(folder.string(), "is not a folder that can be written to");
  }
}

void show_progress(std::uint32_t done, std::uint32_t all, Clock::time_point start) {
  if (!isatty(STDERR_FILENO) || !spdlog::should_log(spdlog::level::info)) return;
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  fmt::print(stderr, "\rframe {}/{}, {:.1f} s left   {}", done, all, seconds / done * (all - done),
             done == all ? "\n" : "");
  std::fflush(stderr);
}

float exposure_of(const std::string& text, const Image& image) {
  if (text == "auto") return auto_exposure_ev100(image);
  try {
    std::size_t end = 0;
    const float value = std::stof(text, &end);
    if (end == text.size() && value >= -20 && value <= 40) return value;
  } catch (const std::exception&) {
  }
  throw UsageError("--ev", "expected 'auto' or a number from -20 to 40, not '" + text + "'");
}

// The PNG: the picture as a camera takes it, or a quantity in false colours; with the lights marked where
// asked for.
Image8 shown(const RenderCommand& command, const Image& image, const RenderScene& scene,
             const gpu::Camera& camera) {
  Image8 result;
  if (command.show == "luminance") {
    const std::vector<float> values = luminance_of(image);
    result = false_colour(values, image.width, image.height, fitting_scale(values, "cd/m2"));
  } else if (command.show == "illuminance") {
    const std::vector<float> values = illuminance_of(image);
    result = false_colour(values, image.width, image.height, fitting_scale(values, "lx"));
  } else {
    result = to_display(image, *image.info.ev100, command.options.settings.tone);
  }
  if (!command.markers) return result;
  constexpr std::size_t most = 1'000'000;
  for (const Marker& marker : find_markers(camera, scene.lights, most)) {
    const auto x = static_cast<std::uint32_t>(marker.at.x * float(image.width));
    const auto y = static_cast<std::uint32_t>(marker.at.y * float(image.height));
    // Lamps as green squares, windows as single blue pixels: colours that no night picture has of itself.
    const bool window = scene.families[marker.light] == LightFamily::window;
    const int reach = window ? 0 : 1;
    for (int dy = -reach; dy <= reach; ++dy)
      for (int dx = -reach; dx <= reach; ++dx) {
        const std::int64_t px = std::int64_t{x} + dx, py = std::int64_t{y} + dy;
        if (px < 0 || py < 0 || px >= image.width || py >= image.height) continue;
        std::uint8_t* to = &result.rgb[3 * (static_cast<std::size_t>(py) * result.width +
                                            static_cast<std::size_t>(px))];
        to[0] = 0;
        to[1] = window ? 120 : 255;
        to[2] = window ? 255 : 0;
      }
  }
  return result;
}

void render(RenderCommand& command) {
  RenderOptions& options = command.options;
  options.resolve();
  options.settings.tone = tone_curve_from_name(command.tone);
  if (command.exposure != "auto") exposure_of(command.exposure, Image{});
  check_outputs(command.outputs);
  options.settings.layers = command.show == "illuminance" ||
                            std::any_of(command.outputs.begin(), command.outputs.end(),
                                        [](auto& o) { return has_extension(o, ".exr"); });

  const auto load_start = Clock::now();
  const RenderScene scene = options.load();
  const CameraPose pose = find_camera(options.camera, scene);
  if (!command.save_camera.empty()) write_camera(command.save_camera, pose);
  gpu::Device device(options.device);
  DeviceScene device_scene(device, scene);
  PassLibrary passes(device);
  Renderer renderer(device, passes, device_scene, options.width, options.height);
  spdlog::info("{}: {} triangles, {} lights, loaded in {:.2f} s; rendering on {}", options.scene,
               scene.triangles.size(), scene.lights.size(),
               std::chrono::duration<double>(Clock::now() - load_start).count(), device.label());
  if (scene.lights.empty())
    spdlog::warn("{}: no lights; only what shines by itself will be seen", options.scene);
  if (scene.bad_lights)
    spdlog::warn("{} lights are not finite or have no flux: switched off", scene.bad_lights);

  const auto start = Clock::now();
  for (std::uint32_t i = 0; i < command.frames; ++i) {
    renderer.render_frame(pose, options.settings);
    show_progress(i + 1, command.frames, start);
  }
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  device.check_validation();

  Image image = renderer.download(options.settings.layers);
  const float ev100 = exposure_of(command.exposure, image);
  image.info.ev100 = ev100;
  for (const std::string& output : command.outputs) {
    if (has_extension(output, ".exr"))
      write_exr(output, image);
    else
      write_png(
          output,
          shown(command, image, scene, make_camera(pose, float(image.width) / float(image.height))),
          png_text(image.info));
  }
  spdlog::info("{} frames of {} in {:.2f} s, EV100 {:.1f}", renderer.frames(),
               name_of(options.settings.estimator), seconds, ev100);
  for (const std::string& output : command.outputs) fmt::print("{}\n", output);
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
      "  nightview render city.glb -o a.exr -o a.png --candidates 8 --neighbours 2 --ev 2.5");
  command->options.declare(*sub);
  sub->add_option("-o,--output", command->outputs,
                  "NAME.png (8-bit sRGB) or NAME.exr (cd/m2 with layers); may be repeated")
      ->required();
  sub->add_option("--frames", command->frames, "Frames that are averaged")
      ->capture_default_str()
      ->check(CLI::Range(1u, 1000000u));
  sub->add_option("--ev", command->exposure, "Exposure, EV100, or 'auto'")->capture_default_str();
  sub->add_option("--tone", command->tone, "Tone curve of the PNG: filmic, reinhard or linear")
      ->capture_default_str();
  sub->add_option(
         "--show", command->show,
         "What a PNG shows: picture, or in false colours with a scale luminance or illuminance")
      ->capture_default_str()
      ->check(CLI::IsMember({"picture", "luminance", "illuminance"}));
  sub->add_flag("--markers", command->markers, "Mark every light in the PNG, hidden ones too");
  sub->add_option("--save-camera", command->save_camera, "Write the camera used to a JSON file");
  sub->callback([command] { render(*command); });
}

}  // namespace nightcity
