#include "runtime/nightview/experiment.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <chrono>
#include <fstream>

#include "formats/error.h"
#include "runtime/measure/exr.h"

namespace nightcity {

double gpu_ms(const Renderer& renderer) {
  double sum = 0;
  for (const auto& span : renderer.timings()) sum += span.ms;
  return sum;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void wake(const gpu::Device& device, const std::function<void()>& render) {
  if (device.info().kind == "cpu") return;
  const auto start = std::chrono::steady_clock::now();
  do render();
  while (std::chrono::steady_clock::now() - start < std::chrono::seconds(1));
}

Experiment::Experiment(RenderScene scene, const Options& options)
    : scene_(std::move(scene)),
      device_(std::make_unique<gpu::Device>(options.device)),
      device_scene_(std::make_unique<DeviceScene>(*device_, scene_)),
      passes_(std::make_unique<PassLibrary>(*device_)),
      renderer_(std::make_unique<Renderer>(*device_, *passes_, *device_scene_, options.width,
                                           options.height)) {
  if (device_->timestamp_period_ns() <= 0)
    throw Error(device_->info().name, "has no clock to time passes by");
}

void Experiment::check_validation() const {
  device_->check_validation();
}

Image Experiment::reference(const CameraPose& pose, RenderSettings settings, std::uint32_t frames,
                            const std::filesystem::path& cache,
                            const std::function<void(std::uint32_t)>& progress) {
  if (!cache.empty() && std::filesystem::exists(cache)) {
    Image kept = read_exr(cache);
    if (kept.info.frames == frames && kept.width == renderer_->width() &&
        kept.height == renderer_->height())
      return kept;
  }
  settings.estimator = Estimator::reference;
  settings.seed = 1000003;  // none of the measured pictures'
  settings.accumulate = true;
  // A renderer of its own: the measured one keeps its history.
  Renderer renderer(*device_, *passes_, *device_scene_, renderer_->width(), renderer_->height());
  for (std::uint32_t i = 0; i < frames; ++i) {
    renderer.render_frame(pose, settings);
    if (progress) progress(i + 1);
  }
  Image truth = renderer.download(false);
  truth.info.ev100.reset();  // to be metered
  if (!cache.empty()) write_exr(cache, truth);
  return truth;
}

void Experiment::warm_up(const CameraPose& pose, const RenderSettings& settings) {
  Renderer renderer(*device_, *passes_, *device_scene_, renderer_->width(), renderer_->height());
  for (int i = 0; i < 2; ++i) renderer.render_frame(pose, settings);  // the second has a history
  wake(*device_, [&] { renderer.render_frame(pose, settings); });
}

std::vector<Measurement> Experiment::measure(const CameraPose& pose, RenderSettings settings,
                                             const Image& truth,
                                             const std::vector<std::uint32_t>& frames,
                                             std::uint32_t lead, std::uint32_t repeats) {
  std::vector<Measurement> results(frames.size());
  std::vector<double> ms;
  if (device_->info().kind != "cpu") warm_up(pose, settings);
  for (std::uint32_t repeat = 0; repeat < repeats; ++repeat) {
    settings.seed = 1 + repeat;  // starts mean and history anew
    settings.accumulate = false;
    for (std::uint32_t i = 0; i <= lead; ++i) renderer_->render_frame(pose, settings);
    settings.accumulate = true;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      while (renderer_->frames() < frames[i]) {
        renderer_->render_frame(pose, settings);
        ms.push_back(gpu_ms(*renderer_));
      }
      const Comparison c = compare(renderer_->download(false), truth);
      Measurement& m = results[i];
      m.frames = frames[i];
      m.rmse8 += c.rmse8 / repeats;
      m.relative_mse += c.relative_mse / repeats;
      m.mean_signed_error += c.mean_signed_error / repeats;
      m.relative_mean_signed_error += c.relative_mean_signed_error / repeats;
      m.fireflies += c.fireflies / repeats;
    }
  }
  if (ms.empty()) ms.push_back(gpu_ms(*renderer_));  // the last warm-up frame was the only one
  for (Measurement& m : results) m.ms = median(ms);
  return results;
}

std::string scene_fingerprint(const std::filesystem::path& glb) {
  XXH64_state_t* state = XXH64_createState();
  XXH64_reset(state, 0);
  std::filesystem::path lights = glb;
  lights.replace_extension(".lights");
  std::vector<char> block(1 << 20);
  for (const auto& path : {glb, lights}) {
    std::ifstream file(path, std::ios::binary);
    while (file) {
      file.read(block.data(), static_cast<std::streamsize>(block.size()));
      XXH64_update(state, block.data(), static_cast<std::size_t>(file.gcount()));
    }
  }
  const std::string text = fmt::format("{:016x}", XXH64_digest(state));
  XXH64_freeState(state);
  return text;
}

std::string pose_fingerprint(const CameraPose& pose) {
  std::vector<float> values;
  for (const glm::vec3& v : {pose.position, pose.target, pose.up})
    values.insert(values.end(), {v.x, v.y, v.z});
  values.push_back(pose.fov_deg);
  return fmt::format("{:08x}",
                     XXH64(values.data(), values.size() * sizeof(float), 0) & 0xFFFFFFFFu);
}

}  // namespace nightcity
