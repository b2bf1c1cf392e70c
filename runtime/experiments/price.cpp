#include "runtime/experiments/price.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

#include "formats/error.h"
#include "formats/median.h"
#include "runtime/experiments/experiment.h"
#include "runtime/measure/false_colour.h"
#include "runtime/render/renderer.h"
#include "runtime/scene/camera_path.h"

namespace nightcity::experiments {
namespace {

using Clock = std::chrono::steady_clock;
using measure::Estimate;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// A median deviates from the expected value by this much more than a mean of normal values, and the
// median of their distances from it is by this much smaller than their standard deviation.
constexpr double median_spread = 1.2533, to_deviation = 1.4826;

Estimate find_median(const std::vector<double>& values) {
  const double middle = median(values);
  std::vector<double> distances;
  for (const double value : values) distances.push_back(std::abs(value - middle));
  return {middle,
          median_spread * to_deviation * median(distances) / std::sqrt(double(values.size()))};
}

// One model on the device.
struct Model {
  std::unique_ptr<render::DeviceScene> scene;
  std::unique_ptr<render::Renderer> renderer;
  render::RenderSettings settings;
  double load_s = 0;
};

class Pricing {
 public:
  Pricing(const PriceOptions& options, program::ProgressDisplay& progress)
      : options_(options), progress_(progress), device_(options.device), passes_(device_) {
    if (options.runs < 3)
      throw UsageError("--runs", "must be 3 or more: the standard errors are by leaving one out");
    if (device_.timestamp_period_ns() <= 0)
      throw Error(device_.info().name, "has no clock that could time the passes");
    report_.device = device_.label();
  }

  PriceReport run() {
    load_whole();
    list_rows();
    total_ = (report_.measured.size() + 1) * poses_.size();
    whole_pictures_ = render_views(whole_, "whole model");
    for (const std::size_t row : report_.measured) measure_row(report_.rows[row]);
    choose();
    device_.check_validation();
    return std::move(report_);
  }

 private:
  // Reads the files twice: the first time fills the system's file cache, so that models are
  // compared without it.
  void load_whole() {
    progress_.show({"reading the scene", 0, 0, ""});
    {
      const scene::RenderScene scene = options_.load(options_.left_out.of_scene());
      find_views(scene);
      report_.triangles = scene.triangles.size();
      report_.lights = scene.lights.size();
      for (const render::ModelPart& part : render::list_model_parts())
        counts_.push_back(count_of(part, scene));
    }
    whole_ = load(options_.left_out, options_.settings.indirect.bounces);
    report_.whole.bytes = double(whole_.scene->bytes());
    report_.whole.load_s = whole_.load_s;
  }

  void find_views(const scene::RenderScene& scene) {
    for (const std::string& view : options_.views) {
      if (is_file_of_poses(view)) {
        const std::vector<scene::CameraPose> poses = scene::read_poses(view);
        for (std::size_t i = 0; i < poses.size(); ++i) {
          poses_.push_back(poses[i]);
          report_.views.push_back(std::filesystem::path(view).stem().string() + " " +
                                  std::to_string(i + 1));
        }
      } else {
        poses_.push_back(scene::find_camera(view, scene));
        report_.views.push_back(std::filesystem::path(view).stem().string());
      }
    }
  }

  // A file of one camera has no list of poses.
  static bool is_file_of_poses(const std::string& view) {
    const auto& presets = scene::camera_presets();
    if (std::find(presets.begin(), presets.end(), view) != presets.end()) return false;
    try {
      return !scene::read_poses(view).empty();
    } catch (const Error&) {
      return false;  // then it is a camera, or find_camera says what is wrong
    }
  }

  std::size_t count_of(const render::ModelPart& part, const scene::RenderScene& scene) const {
    if (options_.left_out.holds(part)) return 0;
    if (part.of_scene) return scene.parts[static_cast<std::size_t>(*part.of_scene)];
    return render::is_present(part, scene, options_.settings) ? 1 : 0;
  }

  Model load(const render::LeftOut& left_out, std::uint32_t bounces) {
    const auto start = Clock::now();
    scene::RenderScene scene = options_.load(left_out.of_scene());
    Model model;
    model.scene = std::make_unique<render::DeviceScene>(device_, scene, render::ReleaseGeometry{});
    // Builds the tables of the lights that shine.
    model.scene->set_time(options_.settings.time_s, options_.settings.environment.lights);
    model.load_s = seconds_since(start);
    model.renderer = std::make_unique<render::Renderer>(device_, passes_, *model.scene,
                                                        options_.width, options_.height);
    model.settings = options_.settings;
    left_out.apply(model.settings);
    model.settings.indirect.bounces = std::min(model.settings.indirect.bounces, bounces);
    return model;
  }

  // One row for each part, and one for each number of bounces below that of the whole model.
  void list_rows() {
    const std::uint32_t bounces = options_.settings.indirect.bounces;
    const auto& parts = render::list_model_parts();
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (std::string(parts[i].name) == "bounces") continue;
      SimplerModel row;
      row.name = parts[i].name;
      row.help = parts[i].help;
      row.count = counts_[i];
      row.left_out = options_.left_out;
      row.left_out.add(parts[i]);
      row.bounces = bounces;
      report_.rows.push_back(std::move(row));
    }
    for (std::uint32_t fewer = 0; fewer < std::max(bounces, 1u); ++fewer) {
      SimplerModel row;
      row.name = "bounces " + std::to_string(fewer);
      row.help = fewer == 0   ? "direct light alone"
                 : fewer == 1 ? "light that bounces once at most"
                              : "light that bounces " + std::to_string(fewer) + " times at most";
      row.count = bounces;
      row.left_out = options_.left_out;
      row.bounces = fewer;
      report_.rows.push_back(std::move(row));
    }
    for (std::size_t i = 0; i < report_.rows.size(); ++i)
      if (report_.rows[i].count > 0) report_.measured.push_back(i);
  }

  // Renders the pictures of all views, each run with a seed that no other picture has.
  std::vector<std::vector<measure::Image>> render_views(Model& model, const std::string& name) {
    std::vector<std::vector<measure::Image>> views;
    for (const scene::CameraPose& pose : poses_) {
      std::vector<measure::Image> pictures;
      for (std::uint32_t run = 0; run < options_.runs; ++run) {
        render::RenderSettings settings = model.settings;
        settings.sampling.seed = ++last_seed_;
        for (std::uint32_t frame = 0; frame < options_.frames; ++frame)
          model.renderer->render_frame(pose, settings);
        pictures.push_back(model.renderer->download(false));
        progress_.show({name, done_ * options_.runs + run + 1,
                        std::max(total_, done_ + 1) * options_.runs, "pictures"});
      }
      ++done_;
      views.push_back(std::move(pictures));
    }
    return views;
  }

  std::vector<measure::ModelDifference> compare(
      const std::vector<std::vector<measure::Image>>& pictures,
      const std::vector<std::vector<measure::Image>>& whole) const {
    std::vector<measure::ModelDifference> differences;
    for (std::size_t view = 0; view < poses_.size(); ++view) {
      try {
        differences.push_back(measure::find_model_difference(pictures[view], whole[view]));
      } catch (const Error& error) {
        throw Error("view " + report_.views[view], error.what());
      }
    }
    return differences;
  }

  void set_errors(SimplerModel& row) const {
    row.error = row.bound = 0;
    for (const measure::ModelDifference& difference : row.views) {
      const Estimate value = value_of(options_.measure, difference);
      row.error = std::max(row.error, value.value);
      row.bound = std::max(row.bound, find_bound(options_.measure, difference));
    }
  }

  // Returns the measure's value with two standard errors more.
  static double find_bound(ErrorMeasure measure, const measure::ModelDifference& d) {
    const auto above = [](const Estimate& e) { return std::max(e.value, 0.0) + 2 * e.error; };
    switch (measure) {
      case ErrorMeasure::rmse:
        return std::sqrt(above(d.mse8));
      case ErrorMeasure::mean:
        return std::abs(d.relative_mean.value) + 2 * d.relative_mean.error;
      case ErrorMeasure::relative_rmse:
        return std::sqrt(above(d.relative_mse));
    }
    return 0;
  }

  // Frames of both models alternate, so that a clock rate that drifts meets both alike.
  Estimate time_difference(Model& model, std::vector<double>* whole_ms) {
    std::vector<double> means, squares;
    double sum = 0, error2 = 0;
    for (const scene::CameraPose& pose : poses_) {
      for (int i = 0; i < 2; ++i) {  // the second has a history
        whole_.renderer->render_frame(pose, whole_.settings);
        model.renderer->render_frame(pose, model.settings);
      }
      wake(device_, [&] { model.renderer->render_frame(pose, model.settings); });
      std::vector<double> differences;
      for (std::uint32_t i = 0; i < options_.timed; ++i) {
        whole_.renderer->render_frame(pose, whole_.settings);
        const double whole = sum_gpu_ms(*whole_.renderer);
        model.renderer->render_frame(pose, model.settings);
        differences.push_back(whole - sum_gpu_ms(*model.renderer));
        if (whole_ms) whole_ms->push_back(whole);
      }
      const Estimate middle = find_median(differences);
      sum += middle.value;
      error2 += middle.error * middle.error;
    }
    const double views = double(poses_.size());
    return {sum / views, std::sqrt(error2) / views};
  }

  void measure_row(SimplerModel& row) {
    Model model = load(row.left_out, row.bounces);
    row.views = compare(render_views(model, row.name), whole_pictures_);
    set_errors(row);
    row.saved.ms = time_difference(model, &whole_ms_);
    row.saved.bytes = report_.whole.bytes - double(model.scene->bytes());
    row.saved.load_s = report_.whole.load_s - model.load_s;
  }

  SimplerModel combine(const std::vector<std::size_t>& cuts) const {
    SimplerModel model;
    model.left_out = options_.left_out;
    model.bounces = options_.settings.indirect.bounces;
    for (const std::size_t cut : cuts) {
      const SimplerModel& row = report_.rows[report_.measured[cut]];
      model.name += (model.name.empty() ? "" : ", ") + row.name;
      for (const render::ModelPart& part : render::list_model_parts())
        if (row.left_out.holds(part)) model.left_out.add(part);
      model.bounces = std::min(model.bounces, row.bounces);
    }
    return model;
  }

  // Measures a set of cuts. A verification renders the whole model anew as well.
  double measure_cuts(const std::vector<std::size_t>& cuts, bool is_verification) {
    total_ += poses_.size() * (is_verification ? 2 : 1);
    SimplerModel row = combine(cuts);
    Model model = load(row.left_out, row.bounces);
    const auto pictures = render_views(model, is_verification ? "verifying" : "trying");
    row.views =
        compare(pictures, is_verification ? render_views(whole_, "verifying") : whole_pictures_);
    set_errors(row);
    if (is_verification) {
      row.saved.ms = time_difference(model, nullptr);
      row.saved.bytes = report_.whole.bytes - double(model.scene->bytes());
      row.saved.load_s = report_.whole.load_s - model.load_s;
      row.saving = find_saving(row.saved, report_.whole);
      report_.chosen = row;
    }
    return row.bound;
  }

  void choose() {
    if (!whole_ms_.empty()) report_.whole.ms = find_median(whole_ms_);
    for (std::size_t view = 0; view < poses_.size(); ++view)
      report_.means.push_back(find_mean(whole_pictures_[view]));
    std::vector<Cut> cuts;
    for (const std::size_t row : report_.measured) {
      SimplerModel& each = report_.rows[row];
      each.saving = find_saving(each.saved, report_.whole);
      cuts.push_back({each.name.starts_with("bounces ") ? "bounces" : "", each.error, each.saving});
    }
    report_.chosen = combine({});
    report_.choice = choose_cuts(cuts, options_.limit, [this](const auto& made, bool verifies) {
      return measure_cuts(made, verifies);
    });
    if (report_.choice.cuts.empty()) report_.chosen = combine({});
  }

  static double find_mean(const std::vector<measure::Image>& pictures) {
    double sum = 0, count = 0;
    for (const measure::Image& picture : pictures)
      for (const float value : measure::luminance_of(picture)) {
        sum += double{value};
        ++count;
      }
    return sum / count;
  }

  const PriceOptions& options_;
  program::ProgressDisplay& progress_;
  gpu::Device device_;
  render::PassLibrary passes_;
  PriceReport report_;
  std::vector<scene::CameraPose> poses_;
  std::vector<std::size_t> counts_;  // parallel to the table of parts
  Model whole_;
  std::vector<std::vector<measure::Image>> whole_pictures_;  // by view
  std::vector<double> whole_ms_;
  std::uint32_t last_seed_ = 0;
  std::size_t done_ = 0, total_ = 0;  // views rendered, and known to be to render
};

}  // namespace

Estimate value_of(ErrorMeasure measure, const measure::ModelDifference& difference) {
  switch (measure) {
    case ErrorMeasure::rmse:
      return difference.rmse8();
    case ErrorMeasure::mean:
      return {std::abs(difference.relative_mean.value), difference.relative_mean.error};
    case ErrorMeasure::relative_rmse:
      return measure::root_of(difference.relative_mse);
  }
  return {};
}

double find_saving(const ModelCost& saved, const ModelCost& whole) {
  const bool is_measured = std::abs(saved.ms.value) > 2 * saved.ms.error;
  const double of_ms = is_measured && whole.ms.value > 0 ? saved.ms.value / whole.ms.value : 0;
  const double of_bytes = whole.bytes > 0 ? saved.bytes / whole.bytes : 0;
  return 0.5 * (of_ms + of_bytes);
}

PriceReport price_scene(const PriceOptions& options, program::ProgressDisplay& progress) {
  return Pricing(options, progress).run();
}

}  // namespace nightcity::experiments
