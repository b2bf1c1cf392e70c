#include "runtime/experiments/model_bench.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "formats/error.h"
#include "formats/median.h"
#include "runtime/experiments/experiment.h"
#include "runtime/scene/camera_path.h"

namespace nightcity::experiments {
namespace {

using Clock = std::chrono::steady_clock;
using measure::Estimate;

// A median deviates from the expected value by this much more than a mean of normal values, and the
// median of their distances from it is by this much smaller than their standard deviation.
constexpr double median_spread = 1.2533, to_deviation = 1.4826;

// A file of one camera has no list of poses.
bool is_file_of_poses(const std::string& word) {
  const auto& presets = scene::camera_presets();
  if (std::find(presets.begin(), presets.end(), word) != presets.end()) return false;
  try {
    return !scene::read_poses(word, glm::dvec3(0)).empty();
  } catch (const Error&) {
    return false;  // then it is a camera, or find_camera says what is wrong
  }
}

// Returns that of model space: a scene's own is of the frame that it is rendered in.
Georeference find_georeference(const scene::RenderScene& scene) {
  Georeference georeference = scene.georeference;
  georeference.origin = georeference.from_model(-scene.origin);
  return georeference;
}

// Returns where a model is looked at from.
scene::CameraPose pose_in(const Model& model, const View& view) {
  scene::CameraPose pose = view.pose;
  pose.origin += model.shift;
  return pose;
}

}  // namespace

std::vector<View> find_views(const std::vector<std::string>& words,
                             const scene::RenderScene& scene) {
  std::vector<View> views;
  for (const std::string& word : words) {
    const std::string name = std::filesystem::path(word).stem().string();
    if (!is_file_of_poses(word)) {
      views.push_back({name, scene::find_camera(word, scene)});
      continue;
    }
    std::size_t number = 0;
    for (const scene::CameraPose& pose : scene::read_poses(word, scene.origin))
      views.push_back({name + " " + std::to_string(++number), pose});
  }
  return views;
}

ModelBench::ModelBench(const Options& options, program::ProgressDisplay& progress)
    : options_(options), progress_(progress), device_(options.device), passes_(device_) {
  if (device_.timestamp_period_ns() <= 0)
    throw Error(device_.info().name, "has no clock that could time the passes");
}

void ModelBench::set_views(std::vector<View> views, const scene::RenderScene& scene) {
  views_ = std::move(views);
  georeference_ = find_georeference(scene);
}

Model ModelBench::load(const LoadWithout& read, const render::LeftOut& left_out,
                       render::RenderSettings settings) {
  Model model;
  model.settings = settings;
  left_out.apply(model.settings);
  const auto start = Clock::now();
  scene::RenderScene scene = read(left_out.of_scene());
  if (scene.georeference.crs == georeference_.crs)
    model.shift = find_georeference(scene).to_model(georeference_.origin);
  model.scene = std::make_unique<render::DeviceScene>(device_, scene, render::ReleaseGeometry{},
                                                      settings.light_moment());
  model.load_s = std::chrono::duration<double>(Clock::now() - start).count();
  model.renderer = std::make_unique<render::Renderer>(device_, passes_, *model.scene,
                                                      options_.width, options_.height);
  return model;
}

Pictures ModelBench::render(Model& model, const std::string& name) {
  Pictures views;
  for (const View& view : views_) {
    std::vector<measure::Image> pictures;
    for (std::uint32_t run = 0; run < options_.runs; ++run) {
      render::RenderSettings settings = model.settings;
      settings.sampling.seed = ++last_seed_;
      for (std::uint32_t frame = 0; frame < options_.frames; ++frame)
        model.renderer->render_frame(pose_in(model, view), settings);
      pictures.push_back(model.renderer->download(false));
      progress_.show({name, done_ * options_.runs + run + 1,
                      std::max(expected_, done_ + 1) * options_.runs, "pictures"});
    }
    ++done_;
    views.push_back(std::move(pictures));
  }
  return views;
}

std::vector<std::vector<bool>> ModelBench::find_seen(Model& model,
                                                     const std::vector<bool>& is_one) {
  std::vector<std::vector<bool>> views;
  for (const View& view : views_) {
    model.renderer->render_frame(pose_in(model, view), model.settings);
    const std::size_t pixels = std::size_t{options_.width} * options_.height;
    const std::vector<float> lights = model.renderer->sample_mean(pixels).layer("light")->values;
    std::vector<bool>& seen = views.emplace_back();
    for (const float light : lights)
      seen.push_back(light >= 0 &&
                     (light >= float(is_one.size()) || is_one[static_cast<std::size_t>(light)]));
  }
  return views;
}

std::vector<measure::ModelDifference> ModelBench::compare(
    const Pictures& pictures, const Pictures& whole,
    const std::vector<std::vector<bool>>& left_out) const {
  std::vector<measure::ModelDifference> differences;
  for (std::size_t i = 0; i < views_.size(); ++i) {
    try {
      differences.push_back(
          measure::find_model_difference(pictures[i], whole[i], std::nullopt,
                                         left_out.empty() ? std::vector<bool>() : left_out[i]));
    } catch (const Error& error) {
      throw Error("view " + views_[i].name, error.what());
    }
  }
  return differences;
}

Estimate ModelBench::time_difference(Model& whole, Model& other, std::vector<double>& whole_ms) {
  double sum = 0, squared_error = 0;
  for (const View& view : views_) {
    for (int i = 0; i < 2; ++i) {  // the second has a history
      whole.renderer->render_frame(pose_in(whole, view), whole.settings);
      other.renderer->render_frame(pose_in(other, view), other.settings);
    }
    wake(device_, [&] { other.renderer->render_frame(pose_in(other, view), other.settings); });
    std::vector<double> differences;
    for (std::uint32_t i = 0; i < options_.timed; ++i) {
      whole.renderer->render_frame(pose_in(whole, view), whole.settings);
      whole_ms.push_back(sum_gpu_ms(*whole.renderer));
      other.renderer->render_frame(pose_in(other, view), other.settings);
      differences.push_back(whole_ms.back() - sum_gpu_ms(*other.renderer));
    }
    const Estimate middle = find_median(differences);
    sum += middle.value;
    squared_error += middle.error * middle.error;
  }
  const double views = double(views_.size());
  return {sum / views, std::sqrt(squared_error) / views};
}

Estimate find_median(const std::vector<double>& values) {
  if (values.empty()) return {};
  const double middle = median(values);
  std::vector<double> distances;
  for (const double value : values) distances.push_back(std::abs(value - middle));
  return {middle,
          median_spread * to_deviation * median(distances) / std::sqrt(double(values.size()))};
}

}  // namespace nightcity::experiments
