#include "runtime/experiments/flight.h"

#include <fmt/format.h>

#include "formats/program/output.h"
#include "runtime/measure/exposure.h"
#include "runtime/measure/png.h"
#include "runtime/measure/table.h"
#include "runtime/scene/camera_path.h"

namespace nightcity::experiments {
namespace {

std::vector<std::string> make_row(std::uint32_t frame, double time_s, const scene::CameraPose& pose,
                                  double ms) {
  return {fmt::to_string(frame),
          fmt::format("{:.4f}", time_s),
          fmt::format("{:.3f}", pose.position.x),
          fmt::format("{:.3f}", pose.position.y),
          fmt::format("{:.3f}", pose.position.z),
          fmt::format("{:.4g}", ms)};
}

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
  const double first_s = settings.time_s;
  std::optional<float> ev100 = options.ev100;
  for (std::uint32_t i = 0; i < options.frames; ++i) {
    const scene::CameraPose pose =
        path.at(options.frames > 1 ? double(i) / (options.frames - 1) : 0.0);
    settings.time_s = first_s + i * options.time_step_s;
    experiment.renderer().render_frame(pose, settings);
    const double ms = sum_gpu_ms(experiment.renderer());
    std::vector<std::string> row = make_row(i, settings.time_s, pose, ms);
    if (i > 0) report.ms.push_back(ms);
    const measure::Image picture = experiment.renderer().download(false);
    if (i > 0 && i % options.every == 0) {
      const measure::Image truth =
          experiment.reference(pose, settings, options.reference_frames, {});
      add_errors(measure::compare(picture, truth), row, report);
    }
    row.resize(table.columns.size());
    table.rows.push_back(std::move(row));
    if (options.pictures) {
      if (!ev100)  // one exposure for the whole flight
        ev100 = measure::auto_exposure_ev100(experiment.renderer().sample_mean(picture.pixels()));
      measure::write_png(options.folder / fmt::format("frame-{:04}.png", i),
                         measure::to_display(picture, *ev100), measure::png_text(picture.info));
    }
    progress.show({"flying", i + 1, options.frames, "frames"});
  }
  experiment.check_validation();
  measure::write_csv(options.folder / "flight.csv", table);
  return report;
}

}  // namespace nightcity::experiments
