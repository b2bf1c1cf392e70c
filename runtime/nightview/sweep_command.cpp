// nightview sweep SCENE.glb --out DIR: the price list of speed for accuracy.
#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <memory>

#include "formats/atomic_file.h"
#include "formats/error.h"
#include "runtime/nightview/commands.h"
#include "runtime/nightview/device_options.h"
#include "runtime/nightview/experiment.h"
#include "runtime/nightview/render_options.h"
#include "runtime/nightview/sweep.h"

namespace nightcity {
namespace {

struct SweepCommand {
  gpu::Device::Options device;
  std::string scene, folder, size = "640x360", views = "overview", frames = "1,16";
  std::map<std::string, std::string> lists;  // by knob
  std::uint32_t reference_frames = 64, warm_up = 8, repeats = 1;
  double minutes = 0;
};

std::vector<std::uint32_t> frame_counts(const std::string& text) {
  std::vector<std::uint32_t> counts;
  for (const std::string& word : split_list("--frames", text)) {
    char* end = nullptr;
    const long value = std::strtol(word.c_str(), &end, 10);
    if (*end != '\0' || value < 1 || value > 1000000 ||
        (!counts.empty() && value <= long(counts.back())))
      throw UsageError("--frames", "'" + text + "' is not a rising list of numbers from 1");
    counts.push_back(static_cast<std::uint32_t>(value));
  }
  return counts;
}

// A preset's name, or a camera file's without folder and extension.
std::string view_name(const std::string& view) {
  return std::filesystem::path(view).stem().string();
}

std::vector<std::string> columns() {
  std::vector<std::string> all{"view", "camera", "size", "device", "reference_frames", "repeats"};
  for (const Knob& knob : knobs()) all.push_back(knob.name);
  all.insert(all.end(), {"frames", "ms", "rmse8", "relative_mse", "mean_signed_error",
                         "relative_mean_signed_error", "fireflies"});
  return all;
}

class Progress {
 public:
  explicit Progress(std::size_t all) : all_(all) {}
  void tell(std::size_t done, const std::string& what) const {
    if (!isatty(STDERR_FILENO)) return spdlog::info("{}/{} {}", done, all_, what);
    fmt::print(stderr, "\r{}/{} {:<60}", done, all_, what.substr(0, 60));
    if (done == all_) fmt::print(stderr, "\n");
    std::fflush(stderr);
  }

 private:
  std::size_t all_;
};

void write_text(const std::filesystem::path& path, const std::string& text) {
  AtomicFile file(path);
  file.write(text);
  file.commit();
}

void write_summaries(const SweepCommand& command, const Table& table) {
  const std::filesystem::path folder = command.folder;
  write_text(folder / "sweep.md", to_markdown(table));
  for (const std::string& view : split_list("--views", command.views))
    write_text(folder / ("sweep-" + view_name(view) + ".svg"),
               to_svg(sweep_plot(table, view_name(view))));
}

void sweep(const SweepCommand& command) {
  const auto start = std::chrono::steady_clock::now();
  RenderOptions size;
  size.size = command.size;
  size.resolve();
  const auto views = split_list("--views", command.views);
  const auto frames = frame_counts(command.frames);
  const auto all = combinations(command.lists);

  Experiment experiment(load_render_scene(command.scene),
                        {command.device, size.width, size.height});
  std::vector<CameraPose> poses;
  for (const std::string& view : views) poses.push_back(find_camera(view, experiment.scene()));
  const std::size_t keys = columns().size() - 6;  // up to and with the frames
  SweepTable results(command.folder, scene_fingerprint(command.scene), columns(), keys);
  if (results.restarted()) spdlog::warn("{}: the scene has changed: measured anew", command.folder);
  spdlog::info("{}: {} triangles, {} lights; {} settings on {}", command.scene,
               experiment.scene().triangles.size(), experiment.scene().lights.size(),
               all.size() * views.size(), experiment.device_name());

  // Without commas, so that scripts may split the file at them.
  std::string device = experiment.device_name();
  std::replace(device.begin(), device.end(), ',', ';');
  const Progress progress(all.size() * views.size());
  std::size_t done = 0;
  bool out_of_time = false;
  for (std::size_t v = 0; v < views.size() && !out_of_time; ++v) {
    const std::string camera = pose_fingerprint(poses[v]);
    Image truth;  // made when the first row needs it
    for (const KnobValues& values : all) {
      std::vector<std::string> key{view_name(views[v]),
                                   camera,
                                   command.size,
                                   device,
                                   fmt::to_string(command.reference_frames),
                                   fmt::to_string(command.repeats)};
      for (const Knob& knob : knobs()) key.push_back(values.at(knob.name));
      const auto with_frames = [&](std::uint32_t n) {
        auto longer = key;
        longer.push_back(fmt::to_string(n));
        return longer;
      };
      if (!std::all_of(frames.begin(), frames.end(),
                       [&](auto n) { return results.holds(with_frames(n)); })) {
        const double minutes =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / 60;
        if (command.minutes > 0 && minutes > command.minutes) {
          out_of_time = true;
          break;
        }
        if (truth.pixels() == 0) {
          const std::filesystem::path cache =
              std::filesystem::path(command.folder) /
              fmt::format("reference-{}-{}-{}.exr", view_name(views[v]), camera, command.size);
          truth = experiment.reference(
              poses[v], settings_of({}), command.reference_frames, cache, [&](auto n) {
                progress.tell(done,
                              fmt::format("reference, frame {}/{}", n, command.reference_frames));
              });
        }
        for (const Measurement& m : experiment.measure(poses[v], settings_of(values), truth, frames,
                                                       command.warm_up, command.repeats)) {
          auto row = with_frames(m.frames);
          if (results.holds(row)) continue;
          for (const double value : {m.ms, m.rmse8, m.relative_mse, m.mean_signed_error,
                                     m.relative_mean_signed_error, m.fireflies})
            row.push_back(fmt::format("{:.6g}", value));
          results.add(std::move(row));
        }
      }
      progress.tell(++done, fmt::format("{} {}", view_name(views[v]), values.at("estimator")));
    }
  }
  experiment.check_validation();
  write_summaries(command, results.table());
  if (out_of_time)
    spdlog::warn("stopped after {} minutes with {} of {} settings done; the same command goes on",
                 command.minutes, done, all.size() * views.size());
  fmt::print("{}\n", (std::filesystem::path(command.folder) / "sweep.csv").string());
}

}  // namespace

void add_sweep_command(CLI::App& app) {
  auto command = std::make_shared<SweepCommand>();
  CLI::App* sub = app.add_subcommand(
      "sweep",
      "Error against milliseconds for every combination of settings: CSV, Markdown and a plot");
  sub->footer(
      "Lists are comma-separated. DIR gets sweep.csv, sweep.md, sweep-VIEW.svg and the reference "
      "pictures; "
      "run again, "
      "it goes on\nwhere it stopped, and anew where the scene changed.\n"
      "Examples:\n"
      "  nightview sweep city.glb --out sweep --estimator paper,pairwise --candidates "
      "1,2,4,8,16,32\n"
      "  nightview sweep city.glb --out sweep --size 1920x1080 --views overview,street --frames "
      "1,30 "
      "--minutes 9");
  sub->add_option("scene", command->scene, "SCENE.glb; SCENE.lights beside it is read too")
      ->required();
  sub->add_option("-o,--out", command->folder, "Folder of the results")->required();
  sub->add_option("--views", command->views, "Cameras: files or presets")->capture_default_str();
  sub->add_option("--size", command->size, "Picture size in pixels, WIDTHxHEIGHT")
      ->capture_default_str();
  sub->add_option("--frames", command->frames,
                  "Errors are those of the mean of so many frames; rising")
      ->capture_default_str();
  for (const Knob& knob : knobs())
    sub->add_option(std::string("--") + knob.name, command->lists[knob.name], knob.help)
        ->default_str(knob.defaults);
  sub->add_option("--warm-up", command->warm_up,
                  "Frames before the first that counts: they fill the history")
      ->capture_default_str()
      ->check(CLI::Range(0u, 100000u));
  sub->add_option("--repeats", command->repeats, "Seeds whose errors are averaged")
      ->capture_default_str()
      ->check(CLI::Range(1u, 1000u));
  sub->add_option("--reference-frames", command->reference_frames,
                  "Frames of the reference picture")
      ->capture_default_str()
      ->check(CLI::Range(1u, 100000u));
  sub->add_option("--minutes", command->minutes,
                  "Stop after the setting that takes longer than this; 0 = never")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 1e6));
  declare_device(*sub, command->device);
  sub->callback([command] { sweep(*command); });
}

}  // namespace nightcity
