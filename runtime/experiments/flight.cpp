#include "runtime/experiments/flight.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <limits>

#include "formats/program/output.h"
#include "runtime/experiments/governed.h"
#include "runtime/measure/exposure.h"
#include "runtime/measure/png.h"
#include "runtime/measure/table.h"
#include "runtime/scene/camera_path.h"

namespace nightcity::experiments {
namespace {

std::vector<std::string> make_row(std::uint32_t frame, double time_s, const scene::CameraPose& pose,
                                  double ms) {
  const glm::dvec3 place = glm::dvec3(pose.position) + pose.origin;
  return {fmt::to_string(frame),          fmt::format("{:.4f}", time_s),
          fmt::format("{:.3f}", place.x), fmt::format("{:.3f}", place.y),
          fmt::format("{:.3f}", place.z), fmt::format("{:.4g}", ms)};
}

// The milliseconds of each pass, frame by frame.
class PassTimes {
 public:
  void add(const std::vector<gpu::Timer::Span>& spans) {
    std::vector<double>& frame = frames_.emplace_back(names_.size());
    for (const gpu::Timer::Span& span : spans) {
      const auto at = std::find(names_.begin(), names_.end(), span.name);
      const auto column = static_cast<std::size_t>(at - names_.begin());
      if (at == names_.end()) names_.emplace_back(span.name);
      frame.resize(names_.size());
      frame[column] += span.ms;
    }
  }

  // Appends a column for each pass to a table with a row for each frame.
  void append_to(measure::Table& table) const {
    for (const std::string& name : names_) table.columns.push_back(name + " ms");
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      for (const double ms : frames_[i]) table.rows.at(i).push_back(fmt::format("{:.4g}", ms));
      table.rows[i].resize(table.columns.size(), "0");
    }
  }

 private:
  std::vector<std::string> names_;
  std::vector<std::vector<double>> frames_;
};

void add_errors(const measure::Comparison& errors, std::vector<std::string>& row,
                FlightReport& report) {
  for (const double value :
       {errors.rmse8, errors.relative_mse, errors.relative_mean_signed_error, errors.fireflies})
    row.push_back(fmt::format("{:.5g}", value));
  report.rmse8.push_back(errors.rmse8);
  report.relative_mse.push_back(errors.relative_mse);
  report.mean_signed_error.push_back(errors.relative_mean_signed_error);
  report.fireflies.push_back(errors.fireflies);
}

// Returns what frame i of a flight shows; before and after the flight it goes on at the path's
// ends.
render::Moment moment_at(const FlightOptions& options, const scene::CameraPath& path,
                         double first_s, std::uint32_t i) {
  return {path.at(options.frames > 1 ? double(i) / (options.frames - 1) : 0.0),
          first_s + i * options.time_step_s};
}

// Returns the moments of the flight's first, middle and last frames.
std::vector<std::vector<render::Moment>> list_places(const FlightOptions& options,
                                                     const scene::CameraPath& path,
                                                     double first_s) {
  const std::uint32_t last = options.frames - std::min(options.frames, render::rung_frames);
  std::vector<std::vector<render::Moment>> places;
  for (const std::uint32_t first : {0u, last / 2, last}) {
    std::vector<render::Moment>& place = places.emplace_back();
    for (std::uint32_t i = 0; i < render::rung_frames; ++i)
      place.push_back(moment_at(options, path, first_s, first + i));
  }
  return places;
}

std::optional<render::Governor> make_governor(const FlightOptions& flight,
                                              const Experiment& experiment,
                                              const scene::CameraPath& path,
                                              const render::RenderSettings& settings,
                                              program::ProgressDisplay& progress) {
  const render::GovernorOptions& options = flight.governor;
  if (!(options.budget_ms > 0) && !(options.target_error > 0)) return {};
  const std::vector<render::Rung> rungs =
      measure_rungs([&] { return experiment.make_renderer(); },
                    list_places(flight, path, settings.time_s), settings, options.target_error > 0,
                    [&](std::size_t done, std::size_t all) {
                      progress.show({"measuring settings", done, all, "settings"});
                    });
  render::Governor governor(rungs, options);
  progress.clear();
  spdlog::info("{}", render::describe_start(governor, options));
  return governor;
}

// Renders a frame with the governor's effort, tells it the time, and logs what it decides.
double render_governed(render::Governor& governor, render::Renderer& renderer,
                       const scene::CameraPose& pose, const render::RenderSettings& settings,
                       program::ProgressDisplay& progress) {
  constexpr double whole = std::numeric_limits<double>::infinity();
  renderer.begin_frame(pose, settings, governor.effort());
  while (!renderer.continue_frame(whole, whole)) {
  }
  const double ms = sum_gpu_ms(renderer);
  const std::size_t decided = governor.decisions().size();
  governor.observe(ms);
  if (governor.decisions().size() > decided) {
    progress.clear();
    spdlog::info("{}", render::describe(governor, governor.decisions().back()));
  }
  return ms;
}

}  // namespace

FlightReport fly(const FlightOptions& options, Experiment& experiment,
                 render::RenderSettings settings, program::ProgressDisplay& progress) {
  settings.sampling.jitter = false;  // as in the reference: edges are not what is measured
  const scene::CameraPath path = scene::find_path(options.path, experiment.scene());
  program::require_writable_folder(options.folder);
  experiment.warm_up(path.at(0), settings);

  FlightReport report;
  report.device = experiment.device_name();
  measure::Table table{{"frame", "time_s", "x", "y", "z", "ms", "rmse8", "relative_mse",
                        "relative_mean_signed_error", "fireflies"},
                       {}};
  PassTimes passes;
  report.governor = make_governor(options, experiment, path, settings, progress);
  if (report.governor)
    table.columns.insert(table.columns.end(), {"candidates", "neighbours", "cell_paths",
                                               "resolution_scale", "half_rate"});
  const double first_s = settings.time_s;
  std::optional<float> ev100 = options.ev100;
  for (std::uint32_t i = 0; i < options.frames; ++i) {
    const auto [pose, time_s] = moment_at(options, path, first_s, i);
    settings.time_s = time_s;
    const render::Effort effort = report.governor ? report.governor->effort() : render::Effort{};
    double ms = 0;
    if (report.governor) {
      ms = render_governed(*report.governor, experiment.renderer(), pose, settings, progress);
    } else {
      experiment.renderer().render_frame(pose, settings);
      ms = sum_gpu_ms(experiment.renderer());
    }
    std::vector<std::string> row = make_row(i, settings.time_s, pose, ms);
    if (i > 0) report.ms.push_back(ms);
    passes.add(experiment.renderer().timings());
    // A picture that nobody needs stays on the device: while it is fetched, a GPU has nothing to do
    // and lowers its clock rate, which the next frame then pays for.
    const bool is_measured = i > 0 && i % options.every == 0;
    const measure::Image picture =
        is_measured || options.pictures ? experiment.renderer().download(false) : measure::Image{};
    if (is_measured) {
      // Each reference has noise of its own: else the frames' errors would not average out.
      render::RenderSettings truth_settings = settings;
      truth_settings.sampling.seed += i;
      const measure::Image truth =
          experiment.reference(pose, truth_settings, options.reference_frames, {});
      add_errors(measure::compare(picture, truth), row, report);
    }
    row.resize(table.columns.size());
    if (report.governor) {
      row[row.size() - 5] = fmt::to_string(effort.max_candidates);
      row[row.size() - 4] = fmt::to_string(effort.max_neighbours);
      // Without a bound, the settings say how many there are.
      constexpr auto unbounded = std::numeric_limits<std::uint32_t>::max();
      row[row.size() - 3] =
          effort.max_cell_paths == unbounded ? "" : fmt::to_string(effort.max_cell_paths);
      row[row.size() - 2] = fmt::format("{:g}", effort.resolution_scale);
      row[row.size() - 1] = effort.half_rate ? "yes" : "no";
    }
    table.rows.push_back(std::move(row));
    if (is_measured || options.pictures) experiment.wake_up(pose, settings);
    if (options.pictures) {
      if (!ev100)  // one exposure for the whole flight
        ev100 = measure::auto_exposure_ev100(experiment.renderer().sample_mean(picture.pixels()));
      measure::write_png(options.folder / fmt::format("frame-{:04}.png", i),
                         measure::to_display(picture, *ev100), measure::png_text(picture.info));
    }
    progress.show({"flying", i + 1, options.frames, "frames"});
  }
  passes.append_to(table);
  experiment.check_validation();
  measure::write_csv(options.folder / "flight.csv", table);
  return report;
}

}  // namespace nightcity::experiments
