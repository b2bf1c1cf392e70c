#include "runtime/experiments/vehicles.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <map>
#include <string>

#include "formats/median.h"
#include "runtime/experiments/experiment.h"
#include "runtime/experiments/lamp_field.h"

namespace nightcity::experiments {
namespace {

constexpr double start_s = 8 * 3600;
constexpr std::uint32_t warm_up_frames = 4;

// Milliseconds of the timed frames.
struct Times {
  std::vector<double> all;
  std::map<std::string, std::vector<double>> passes;
};

Times time_frames(Experiment& experiment, render::RenderSettings settings,
                  const VehiclesOptions& options) {
  Times times;
  render::Renderer& renderer = experiment.renderer();
  settings.time_s = start_s;
  experiment.warm_up(lamp_field_camera(), settings);
  for (std::uint32_t i = 0; i < options.frames + warm_up_frames; ++i) {
    settings.time_s = start_s + 10 + options.time_step_s * i;
    renderer.render_frame(lamp_field_camera(), settings);
    if (i < warm_up_frames) continue;
    std::map<std::string, double> frame;
    for (const auto& span : renderer.timings()) frame[span.name] += span.ms;
    for (const auto& [name, ms] : frame) times.passes[name].push_back(ms);
    times.all.push_back(sum_gpu_ms(renderer));
  }
  experiment.check_validation();
  return times;
}

}  // namespace

measure::Table time_vehicles(const VehiclesOptions& options) {
  render::RenderSettings settings;
  settings.sampling.estimator = options.estimator;
  std::vector<std::string> vehicle_passes{"vehicle poses", "vehicle BVH"};
  if (options.device.trace != gpu::Trace::compute) vehicle_passes.push_back("top level");
  measure::Table table{{"vehicles", "lights", "ms"}, {}};
  for (const std::string& pass : vehicle_passes) table.columns.push_back(pass + ", ms");
  table.columns.push_back("others, ms");
  for (const std::size_t vehicles : options.vehicles) {
    Experiment experiment(make_lamp_field(options.lamps, vehicles),
                          {options.device, options.width, options.height});
    spdlog::info("{} vehicles on {}", vehicles, experiment.device_name());
    const Times times = time_frames(experiment, settings, options);
    const std::size_t lights = experiment.scene().lights.size() +
                               vehicles * experiment.scene().traffic.vehicle_lights.size();
    double others = median(times.all);
    std::vector<std::string> row{fmt::to_string(vehicles), fmt::to_string(lights),
                                 fmt::format("{:.3g}", others)};
    for (const std::string& pass : vehicle_passes) {
      const auto timed = times.passes.find(pass);
      const double ms = timed == times.passes.end() ? 0 : median(timed->second);
      others -= ms;
      row.push_back(fmt::format("{:.3g}", ms));
    }
    row.push_back(fmt::format("{:.3g}", others));
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace nightcity::experiments
