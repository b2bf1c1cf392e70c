// nightview record SCENE.glb --path PATH --out DIR: pictures along a path, and a film of them.
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "formats/error.h"
#include "formats/program/number_check.h"
#include "formats/program/output.h"
#include "formats/program/progress_display.h"
#include "runtime/measure/exposure.h"
#include "runtime/nightview/commands.h"
#include "runtime/nightview/recording.h"
#include "runtime/nightview/render_options.h"
#include "runtime/render/parse.h"

namespace nightcity::nightview {
namespace {

struct RecordCommand {
  RenderOptions render;
  RecordingOptions recording;
  std::string exposure = "auto", tone = "filmic", projection = "perspective", film;
};

void run_record(RecordCommand& command) {
  RenderOptions& render = command.render;
  RecordingOptions& recording = command.recording;
  render.to_be_looked_at = !recording.exr;
  render.resolve();
  render.settings.display.tone = measure::tone_curve_from_name(command.tone);
  render.settings.projection = render::find_projection(command.projection);
  recording.ev100 = render::parse_exposure(command.exposure);
  recording.scene = render.scene;
  program::require_writable_folder(recording.folder);
  if (!command.film.empty()) program::require_writable_folder_of(command.film);

  const scene::RenderScene scene = render.load();
  const scene::CameraPath path = scene::find_path(recording.path, scene);
  gpu::Device device(render.device);
  render::DeviceScene device_scene(device, scene, render.settings.light_moment());
  render::PassLibrary passes(device);
  render::Renderer renderer(device, passes, device_scene, render.width, render.height);
  program::ProgressDisplay progress;
  const std::uint32_t pictures = count_pictures(recording);
  const std::uint32_t rendered =
      record(recording, renderer, scene, path, render.settings, [&](std::uint32_t done) {
        progress.show({"recording", done, pictures, "pictures"});
      });
  progress.clear();
  device.check_validation();
  fmt::print("{} pictures in {}, {} of them rendered now\n", pictures, recording.folder.string(),
             rendered);
  if (command.film.empty()) return;
  if (make_film(recording, command.film))
    fmt::print("{}\n", command.film);
  else
    throw Error("ffmpeg",
                "is not installed, so there is no film; the pictures are there, and the "
                "same command makes the film of them later");
}

}  // namespace

void add_record_command(CLI::App& app) {
  auto command = std::make_shared<RecordCommand>();
  RecordingOptions& recording = command->recording;
  CLI::App* sub = app.add_subcommand(
      "record", "Render pictures along a camera path at fixed steps of time, and a film of them");
  sub->footer(
      "DIR gets frame-00000.png and so on, and record.json. A recording that was ended, by a kill "
      "too, goes\n"
      "on with the same command.\n"
      "Examples:\n"
      "  nightview record city.glb --path orbit --out film --film orbit.mp4\n"
      "  nightview record city.glb --path city.cameras.json --duration 30 --clock-speed 60 --out "
      "film --exr");
  command->render.declare(*sub);
  program::add_output_option(*sub, recording.folder, "Folder of the pictures")->required();
  std::string presets;
  for (const std::string& name : scene::path_presets())
    presets += (presets.empty() ? "" : ", ") + name;
  sub->add_option(
         "--path", recording.path,
         "File {\"poses\": [camera, ...]}, as the window's bookmarks are, or preset: " + presets)
      ->required();
  sub->add_option("--duration", recording.duration_s,
                  "Seconds from the path's beginning to its end")
      ->capture_default_str()
      ->check(program::number_from(0.001, 36000));
  sub->add_option("--fps", recording.pictures_per_s, "Pictures per second")
      ->capture_default_str()
      ->check(program::number_from(0.1, 240));
  sub->add_option("--clock-speed", recording.clock_speed,
                  "Seconds of the night per second of the film; 0 = the clock stands")
      ->capture_default_str()
      ->check(program::number_from(0, 3600));
  sub->add_option("--frames", recording.frames, "Frames that are averaged in each picture")
      ->capture_default_str()
      ->check(program::count_from(1, 1000000));
  sub->add_option("--ev", command->exposure,
                  "Exposure, EV100, or 'auto': metered from the first picture")
      ->capture_default_str();
  sub->add_option("--tone", command->tone, "Tone curve: filmic, reinhard or linear")
      ->capture_default_str();
  declare_projection(*sub, command->projection);
  sub->add_flag("--exr", recording.exr, "Write OpenEXR in cd/m2 with layers beside each PNG");
  sub->add_option("--film", command->film, "Make this MP4 of the pictures, with ffmpeg");
  sub->callback([command] { run_record(*command); });
}

}  // namespace nightcity::nightview
