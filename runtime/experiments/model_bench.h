// Models of one city side by side on a device: their pictures, with seeds of their own, and their
// times.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "formats/georeference.h"
#include "formats/program/progress_display.h"
#include "runtime/gpu/device.h"
#include "runtime/measure/model_difference.h"
#include "runtime/render/model_parts.h"
#include "runtime/render/renderer.h"
#include "runtime/scene/camera.h"

namespace nightcity::experiments {

/// Reads a scene without these parts.
using LoadWithout = std::function<scene::RenderScene(const scene::PartSet& left_out)>;

/// A model on the device.
struct Model {
  std::unique_ptr<render::DeviceScene> scene;
  std::unique_ptr<render::Renderer> renderer;
  render::RenderSettings settings;
  double load_s = 0;    // from the files to the device
  glm::dvec3 shift{0};  // from the views' model space to its own, m: bakes choose their origins
};

/// A view of the scene, by name.
struct View {
  std::string name;
  scene::CameraPose pose;
};

/// Returns the views that the words stand for: presets, files of a camera, and files of poses,
/// which stand for all of theirs. Throws Error.
std::vector<View> find_views(const std::vector<std::string>& words,
                             const scene::RenderScene& scene);

/// The pictures of a model: by view, then by run.
using Pictures = std::vector<std::vector<measure::Image>>;

class ModelBench {
 public:
  struct Options {
    gpu::Device::Options device;
    std::uint32_t width = 0, height = 0;
    std::uint32_t runs = 0, frames = 0;  // pictures of a view, and frames in each
    std::uint32_t timed = 0;             // pairs of frames whose times are compared, in each view
  };
  /// Throws Error where there is no device, or its queue has no timestamps.
  ModelBench(const Options& options, program::ProgressDisplay& progress);

  std::string device_name() const { return device_.label(); }
  void check_validation() const { device_.check_validation(); }
  /// Sets the views of every model, which are in the model space of this scene. A model with
  /// another origin in the same CRS is looked at from the same places.
  void set_views(std::vector<View> views, const scene::RenderScene& scene);
  const std::vector<View>& views() const { return views_; }
  /// Tells the progress that so many models are to be rendered besides those that it knows of.
  void expect(std::size_t models) { expected_ += models * views_.size(); }

  /// Loads a model. What `left_out` names of the settings is turned off in it.
  Model load(const LoadWithout& read, const render::LeftOut& left_out,
             render::RenderSettings settings);

  /// Renders all views. No two pictures have the same seed, whatever their models.
  Pictures render(Model& model, const std::string& name);

  /// Returns which pixels of each view see a light of these: `is_one` is by number, and true for
  /// numbers beyond its end, which are lights of vehicles.
  std::vector<std::vector<bool>> find_seen(Model& model, const std::vector<bool>& is_one);

  /// Returns the differences of pictures, a value for each view, without the pixels that `left_out`
  /// marks in each (empty: with all). Throws Error with the view's name.
  std::vector<measure::ModelDifference> compare(
      const Pictures& pictures, const Pictures& whole,
      const std::vector<std::vector<bool>>& left_out = {}) const;

  /// Returns how many milliseconds a frame of `whole` takes more than one of `other`, the mean over
  /// views of medians. Frames of both alternate, so that a clock rate that drifts meets both alike.
  /// The times of `whole` are added to `whole_ms`.
  measure::Estimate time_difference(Model& whole, Model& other, std::vector<double>& whole_ms);

 private:
  Options options_;
  program::ProgressDisplay& progress_;
  gpu::Device device_;
  render::PassLibrary passes_;
  std::vector<View> views_;
  Georeference georeference_;  // of the views
  std::uint32_t last_seed_ = 0;
  std::size_t done_ = 0, expected_ = 0;  // views of models
};

/// Returns the median of values and the standard error of it, as of normal values with outliers.
measure::Estimate find_median(const std::vector<double>& values);

}  // namespace nightcity::experiments
