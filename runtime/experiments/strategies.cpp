#include "runtime/experiments/strategies.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <array>

#include "formats/program/output.h"
#include "runtime/experiments/experiment.h"
#include "runtime/experiments/lamp_field.h"

namespace nightcity::experiments {
namespace {

constexpr std::uint32_t lead_frames = 8;  // they fill the history

struct Strategy {
  const char* name;  // as strategies.csv has always called it: near is "local" there, far is "wide"
  float near_share, far_share, uniform_share;  // the rest by flux
};

// All but the first two sample a share of the candidates from all lights, because a grid cell lists
// only its strongest.
constexpr std::array strategies{
    Strategy{"uniform", 0, 0, 1},
    Strategy{"power", 0, 0, 0},
    Strategy{"half uniform, half power", 0, 0, 0.5f},
    Strategy{"local 0.9, power 0.1", 0.9f, 0, 0},
    Strategy{"local 0.7, uniform 0.1, power 0.2", 0.7f, 0, 0.1f},
    Strategy{"wide 0.8, uniform 0.05, power 0.15", 0, 0.8f, 0.05f},
    Strategy{"local 0.7, wide 0.2, uniform 0.05, power 0.05", 0.7f, 0.2f, 0.05f},
    Strategy{"local 0.5, wide 0.3, uniform 0.05, power 0.15", 0.5f, 0.3f, 0.05f}};

std::vector<std::string> make_row(std::size_t lights, render::Estimator estimator,
                                  const char* strategy, const std::vector<Measurement>& measured) {
  return {fmt::to_string(lights),
          render::name_of(estimator),
          strategy,
          fmt::format("{:.3g}", measured.back().ms),
          fmt::format("{:.3g}", measured.front().relative_mse),
          fmt::format("{:.3g}", measured.back().relative_mse),
          fmt::format("{:+.2f}", 100 * measured.back().relative_mean_signed_error)};
}

}  // namespace

measure::Table compare_strategies(const StrategiesOptions& options) {
  program::require_writable_folder(options.folder);
  measure::Table table{{"lights", "estimator", "candidates from", "ms", "relative MSE of a frame",
                        fmt::format("of the mean of {}", options.frames), "mean error, %"},
                       {}};
  const std::vector<std::uint32_t> frames =
      options.frames > 1 ? std::vector{1u, options.frames} : std::vector{1u};
  for (const std::size_t lights : options.lights) {
    Experiment experiment(make_lamp_field(lights), {options.device, options.width, options.height});
    spdlog::info("{} lights, {} triangles on {}: rendering the reference", lights,
                 experiment.scene().triangles.size(), experiment.device_name());
    render::RenderSettings settings;
    settings.sampling.jitter = false;
    settings.sampling.candidates = options.candidates;
    const scene::CameraPose pose = lamp_field_camera();
    const measure::Image truth =
        experiment.reference(pose, settings, options.reference_frames,
                             options.folder / fmt::format("reference-{}-{}x{}.exr", lights,
                                                          options.width, options.height));
    for (const render::Estimator estimator :
         {render::Estimator::ris, render::RenderSettings{}.sampling.estimator})
      for (const Strategy& strategy : strategies) {
        settings.sampling.estimator = estimator;
        settings.sampling.near_share = strategy.near_share;
        settings.sampling.far_share = strategy.far_share;
        settings.sampling.uniform_share = strategy.uniform_share;
        const auto measured = experiment.measure(pose, settings, truth, frames, lead_frames, 1);
        table.rows.push_back(make_row(lights, estimator, strategy.name, measured));
        measure::write_csv(options.folder / "strategies.csv", table);
      }
    experiment.check_validation();
  }
  return table;
}

}  // namespace nightcity::experiments
