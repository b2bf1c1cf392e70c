#include "runtime/experiments/sweep.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>

#include "formats/atomic_file.h"
#include "formats/error.h"
#include "runtime/experiments/experiment.h"
#include "runtime/experiments/fingerprint.h"
#include "runtime/experiments/sweep_points.h"
#include "runtime/experiments/sweep_table.h"
#include "runtime/render/model_parts.h"
#include "runtime/render/settings_file.h"
#include "runtime/scene/light_families.h"

namespace nightcity::experiments {
namespace {

using Clock = std::chrono::steady_clock;
using Row = std::vector<std::string>;

// The last ones are measured; those before identify a row.
constexpr std::size_t measured_columns = 10;

std::vector<std::string> list_columns(const SweepOptions& options) {
  std::vector<std::string> all{"view", "camera", "size", "device", "reference_frames", "repeats"};
  if (options.time_step_s > 0) all.push_back("time_step_s");
  for (const render::Setting& setting : list_swept_settings())
    all.push_back(render::column_of(setting));
  all.insert(all.end(), {"frames", "ms", "rmse8", "relative_mse", "mean_signed_error",
                         "relative_mean_signed_error", "fireflies", "rmse8_ci95",
                         "relative_mse_ci95", "relative_mean_signed_error_ci95", "front"});
  return all;
}

// A preset's name, or a camera file's without folder and extension.
std::string name_of_view(const std::string& view) {
  return std::filesystem::path(view).stem().string();
}

std::string to_text(const render::PictureSize& size) {
  return fmt::format("{}x{}", size.width, size.height);
}

void write_text(const std::filesystem::path& path, const std::string& text) {
  AtomicFile file(path);
  file.write(text);
  file.commit();
}

void write_summaries(const SweepOptions& options, const measure::Table& table) {
  write_text(options.folder / "sweep.md", measure::to_markdown(table));
  write_text(options.folder / "sweep.json", to_json(table));
  for (const std::string& view : options.views) {
    const std::string name = name_of_view(view);
    write_text(options.folder / ("sweep-" + name + ".svg"),
               measure::to_svg(make_sweep_plot(table, name)));
  }
}

// Returns the fingerprint of the scene, and of what is not swept where that is not the default.
std::string fingerprint_run(const SweepOptions& options) {
  std::string text = fingerprint_scene(options.scene);
  for (const render::NamedText& change : list_changes(options.base, {}))
    text += " " + change.name + "=" + change.text;
  const render::EnvironmentSettings& environment = options.base.environment;
  if (environment.moon_lux != glm::vec3(0))
    text += fmt::format(" moon={:g},{:g},{:g},{:g}", environment.moon_direction.x,
                        environment.moon_direction.y, environment.moon_direction.z,
                        environment.moon_lux.x);
  if (environment.lights != scene::all_families)
    text += " lights=" + scene::text_of(environment.lights);
  if (options.base.time_s != render::RenderSettings{}.time_s)
    text += fmt::format(" time={:g}", options.base.time_s);
  if (options.left_out.any()) text += " leave-out=" + render::name_parts(options.left_out);
  return text;
}

class Sweep {
 public:
  Sweep(const SweepOptions& options, program::ProgressDisplay& progress)
      : options_(options),
        progress_(progress),
        points_(list_combinations(options.values)),
        experiment_(scene::load_render_scene(options.scene, options.left_out),
                    {options.device, options.size.width, options.size.height}),
        results_(options.folder, fingerprint_run(options), list_columns(options),
                 list_columns(options).size() - measured_columns),
        device_(experiment_.device_name()) {
    for (const std::string& view : options.views)
      poses_.push_back(scene::find_camera(view, experiment_.scene()));
    // Without commas, so that scripts may split the file at them.
    std::replace(device_.begin(), device_.end(), ',', ';');
    report_.total = points_.size() * options.views.size();
    if (results_.restarted())
      spdlog::warn("{}: the scene has changed, so everything is measured again",
                   options.folder.string());
    spdlog::info("{}: {} triangles, {} lights; {} combinations on {}", options.scene,
                 experiment_.scene().triangles.size(), experiment_.scene().lights.size(),
                 report_.total, experiment_.device_name());
  }

  SweepReport run() {
    for (std::size_t view = 0; view < poses_.size(); ++view)
      if (!run_view(view)) break;
    experiment_.check_validation();
    results_.mark_front();
    write_summaries(options_, results_.table());
    return report_;
  }

 private:
  // Returns false when the time is up.
  bool run_view(std::size_t view) {
    measure::Image truth;  // rendered when the first row needs it
    for (const SweepPoint& point : points_) {
      const Row key = make_key(view, point);
      if (!has_all(key)) {
        if (is_out_of_time()) return false;
        if (truth.pixels() == 0) truth = make_reference(view);
        measure(view, point, key, truth);
      }
      ++report_.done;
      progress_.show({name_of_view(options_.views[view]) + " " + point.at("estimator"),
                      report_.done, report_.total, "combinations"});
    }
    return true;
  }

  bool is_out_of_time() const {
    const std::chrono::duration<double, std::ratio<60>> minutes = Clock::now() - start_;
    return options_.minutes > 0 && minutes.count() > options_.minutes;
  }

  Row make_key(std::size_t view, const SweepPoint& point) const {
    Row key{name_of_view(options_.views[view]),
            fingerprint_pose(poses_[view]),
            to_text(options_.size),
            device_,
            fmt::to_string(options_.reference_frames),
            fmt::to_string(options_.repeats)};
    if (options_.time_step_s > 0) key.push_back(fmt::format("{:g}", options_.time_step_s));
    for (const render::Setting& setting : list_swept_settings())
      key.push_back(point.at(setting.name));
    return key;
  }

  static Row with_frames(Row key, std::uint32_t frames) {
    key.push_back(fmt::to_string(frames));
    return key;
  }

  bool has_all(const Row& key) const {
    return std::all_of(options_.frames.begin(), options_.frames.end(),
                       [&](auto frames) { return results_.holds(with_frames(key, frames)); });
  }

  measure::Image make_reference(std::size_t view) {
    const std::filesystem::path cache =
        options_.folder / fmt::format("reference-{}-{}-{}.exr", name_of_view(options_.views[view]),
                                      fingerprint_pose(poses_[view]), to_text(options_.size));
    const std::string what = "reference of " + name_of_view(options_.views[view]);
    return experiment_.reference(
        poses_[view], full_model(), options_.reference_frames, cache, [&](auto done) {
          progress_.show({what, done, options_.reference_frames, "frames"});
        });
  }

  // Returns the settings of the reference: light bounces as often as at any point, so that what
  // fewer bounces leave out is an error.
  render::RenderSettings full_model() const {
    render::RenderSettings settings = to_settings({}, options_.base);
    for (const SweepPoint& point : points_)
      settings.indirect.bounces =
          std::max(settings.indirect.bounces, to_settings(point, options_.base).indirect.bounces);
    return settings;
  }

  void measure(std::size_t view, const SweepPoint& point, const Row& key,
               const measure::Image& truth) {
    for (const Measurement& m : experiment_.measure(poses_[view], to_settings(point, options_.base),
                                                    truth, options_.frames, options_.warm_up,
                                                    options_.repeats, options_.time_step_s)) {
      Row row = with_frames(key, m.frames);
      if (results_.holds(row)) continue;
      for (const double value : {m.ms, m.rmse8, m.relative_mse, m.mean_signed_error,
                                 m.relative_mean_signed_error, m.fireflies})
        row.push_back(fmt::format("{:.6g}", value));
      for (const std::optional<double>& half :
           {m.rmse8_ci95, m.relative_mse_ci95, m.relative_mean_signed_error_ci95})
        row.push_back(half ? fmt::format("{:.3g}", *half) : "");
      row.emplace_back();  // the front is known at the end
      results_.add(std::move(row));
    }
  }

  const SweepOptions& options_;
  program::ProgressDisplay& progress_;
  Clock::time_point start_ = Clock::now();
  std::vector<SweepPoint> points_;
  Experiment experiment_;
  SweepTable results_;
  std::string device_;
  std::vector<scene::CameraPose> poses_;
  SweepReport report_;
};

}  // namespace

SweepReport run_sweep(const SweepOptions& options, program::ProgressDisplay& progress) {
  if (options.time_step_s > 0 && options.frames != std::vector<std::uint32_t>{1})
    throw UsageError("--time-step",
                     "above 0 needs --frames 1: a mean over moments has no reference");
  return Sweep(options, progress).run();
}

}  // namespace nightcity::experiments
