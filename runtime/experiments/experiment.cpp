#include "runtime/experiments/experiment.h"

#include <chrono>

#include "formats/error.h"
#include "formats/median.h"
#include "runtime/measure/exr.h"
#include "runtime/measure/significance.h"

namespace nightcity::experiments {
namespace {

constexpr std::uint32_t reference_seed = 1000003;  // added, so that no measured picture has it

// Sets the means of the errors of repeats, and how sure they are.
void set_errors(Measurement& result, const std::vector<measure::Comparison>& repeats) {
  const auto values = [&](double measure::Comparison::*error) {
    std::vector<double> all;
    for (const measure::Comparison& repeat : repeats) all.push_back(repeat.*error);
    return all;
  };
  const auto mean = [&](double measure::Comparison::*error) {
    double sum = 0;
    for (const double value : values(error)) sum += value / double(repeats.size());
    return sum;
  };
  using measure::Comparison;
  result.rmse8 = mean(&Comparison::rmse8);
  result.relative_mse = mean(&Comparison::relative_mse);
  result.mean_signed_error = mean(&Comparison::mean_signed_error);
  result.relative_mean_signed_error = mean(&Comparison::relative_mean_signed_error);
  result.fireflies = mean(&Comparison::fireflies);
  const auto confidence = [&](double measure::Comparison::*error) {
    return measure::find_confidence(values(error), 0.95);
  };
  result.rmse8_ci95 = confidence(&Comparison::rmse8);
  result.relative_mse_ci95 = confidence(&Comparison::relative_mse);
  result.relative_mean_signed_error_ci95 = confidence(&Comparison::relative_mean_signed_error);
}

}  // namespace

double sum_gpu_ms(const render::Renderer& renderer) {
  return gpu::sum_ms(renderer.timings());
}

namespace {

void render_for(const gpu::Device& device, std::chrono::milliseconds time,
                const std::function<void()>& render) {
  if (device.info().kind == "cpu") return;
  const auto start = std::chrono::steady_clock::now();
  do render();
  while (std::chrono::steady_clock::now() - start < time);
}

}  // namespace

void wake(const gpu::Device& device, const std::function<void()>& render) {
  render_for(device, std::chrono::seconds(1), render);
}

Experiment::Experiment(scene::RenderScene scene, const Options& options)
    : scene_(std::move(scene)),
      device_(std::make_unique<gpu::Device>(options.device)),
      device_scene_(std::make_unique<render::DeviceScene>(*device_, scene_)),
      passes_(std::make_unique<render::PassLibrary>(*device_)),
      renderer_(std::make_unique<render::Renderer>(*device_, *passes_, *device_scene_,
                                                   options.width, options.height)) {
  if (device_->timestamp_period_ns() <= 0)
    throw Error(device_->info().name, "has no clock that could time the passes");
}

render::Renderer Experiment::make_renderer() const {
  const glm::uvec2 size = renderer_->picture_size();
  return {*device_, *passes_, *device_scene_, size.x, size.y};
}

void Experiment::check_validation() const {
  device_->check_validation();
}

measure::Image Experiment::reference(const scene::CameraPose& pose, render::RenderSettings settings,
                                     std::uint32_t frames, const std::filesystem::path& cache,
                                     const std::function<void(std::uint32_t)>& progress) {
  if (!cache.empty() && std::filesystem::exists(cache)) {
    measure::Image kept = measure::read_exr(cache);
    if (kept.info.frames == frames && kept.info.bounces == settings.indirect.bounces &&
        glm::uvec2(kept.width, kept.height) == renderer_->picture_size())
      return kept;
  }
  settings.sampling.estimator = render::Estimator::reference;
  settings.sampling.seed += reference_seed;
  settings.sampling.resolution_scale = 1;
  settings.averaging.accumulate = true;
  render::Renderer renderer = make_renderer();  // the measured one keeps its history
  for (std::uint32_t i = 0; i < frames; ++i) {
    renderer.render_frame(pose, settings);
    if (progress) progress(i + 1);
  }
  measure::Image truth = renderer.download(false);
  truth.info.ev100.reset();  // so that comparisons meter the exposure
  if (!cache.empty()) measure::write_exr(cache, truth);
  return truth;
}

void Experiment::warm_up(const scene::CameraPose& pose, const render::RenderSettings& settings) {
  render::Renderer renderer = make_renderer();
  for (int i = 0; i < 2; ++i) renderer.render_frame(pose, settings);  // the second has a history
  wake(*device_, [&] { renderer.render_frame(pose, settings); });
}

void Experiment::wake_up(const scene::CameraPose& pose, const render::RenderSettings& settings) {
  if (device_->info().kind == "cpu") return;
  render::Renderer renderer = make_renderer();
  render_for(*device_, std::chrono::milliseconds(100),
             [&] { renderer.render_frame(pose, settings); });
}

std::vector<double> Experiment::start_run(const scene::CameraPose& pose,
                                          render::RenderSettings& settings, std::uint32_t seed,
                                          std::uint32_t lead, double time_step_s) {
  settings.sampling.seed = seed;
  settings.averaging.accumulate = false;
  const double last_s = settings.time_s;
  std::vector<double> ms;
  for (std::uint32_t i = 0; i <= lead; ++i) {
    settings.time_s = last_s - time_step_s * (lead - i);
    renderer_->render_frame(pose, settings);
    ms.push_back(sum_gpu_ms(*renderer_));
  }
  settings.averaging.accumulate = true;
  return ms;
}

std::vector<Measurement> Experiment::measure(const scene::CameraPose& pose,
                                             render::RenderSettings settings,
                                             const measure::Image& truth,
                                             const std::vector<std::uint32_t>& frames,
                                             std::uint32_t lead, std::uint32_t repeats,
                                             double time_step_s) {
  std::vector<Measurement> results(frames.size());
  std::vector<std::vector<measure::Comparison>> errors(frames.size());
  std::vector<double> ms;
  if (device_->info().kind != "cpu") warm_up(pose, settings);
  for (std::uint32_t repeat = 0; repeat < repeats; ++repeat) {
    const std::vector<double> moving_ms = start_run(pose, settings, 1 + repeat, lead, time_step_s);
    if (time_step_s > 0) ms.insert(ms.end(), moving_ms.begin(), moving_ms.end());
    for (std::size_t i = 0; i < frames.size(); ++i) {
      while (time_step_s <= 0 && renderer_->frames() < frames[i]) {
        renderer_->render_frame(pose, settings);
        ms.push_back(sum_gpu_ms(*renderer_));
      }
      errors[i].push_back(measure::compare(renderer_->download(false), truth));
    }
  }
  for (std::size_t i = 0; i < frames.size(); ++i) {
    results[i].frames = frames[i];
    set_errors(results[i], errors[i]);
  }
  if (ms.empty()) ms.push_back(sum_gpu_ms(*renderer_));  // the mean is the last lead frame alone
  for (Measurement& result : results) result.ms = median(ms);
  return results;
}

}  // namespace nightcity::experiments
