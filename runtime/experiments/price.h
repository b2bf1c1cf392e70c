// Finds what a scene requires: the error of leaving each part of the model out, beside what it
// costs, and the smallest model that keeps a stated error.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "formats/program/progress_display.h"
#include "runtime/experiments/model_bench.h"
#include "runtime/experiments/price_choice.h"

namespace nightcity::experiments {

/// The measure of error that a limit is set for.
enum class ErrorMeasure {
  rmse,          // of 8-bit display values
  mean,          // |relative mean signed error|
  relative_rmse  // root of the relative MSE
};

struct PriceOptions {
  gpu::Device::Options device;
  std::uint32_t width = 320, height = 180;
  std::vector<std::string> views{"overview", "street"};  // cameras, or files of poses
  render::RenderSettings settings;                       // of the whole model
  render::LeftOut left_out;                              // is missing from the whole model already
  std::uint32_t runs = 4;     // pictures of each side and view, with seeds of their own; >= 3
  std::uint32_t frames = 64;  // in each picture
  std::uint32_t timed = 16;   // pairs of frames whose times are compared, in each view
  double limit = 1;           // of the error of the model that is chosen
  ErrorMeasure measure = ErrorMeasure::rmse;
  LoadWithout load;
  // Other bakes of the scene, by name. Where there are any, they are measured against the scene in
  // place of its parts, and no model is chosen.
  std::vector<std::pair<std::string, LoadWithout>> others;
};

/// The cost of a model.
struct ModelCost {
  measure::Estimate ms;  // a frame by the device's clock, mean over views
  double bytes = 0;      // of the scene on the device
  double load_s = 0;     // from the files to the device
};

/// A model that is simpler than the whole one, or another bake.
struct SimplerModel {
  std::string name;          // of the part, "bounces 2", or of the bake
  std::string help;          // what is rendered instead
  std::size_t count = 0;     // things of that part in the scene; 0 = absent: not measured
  render::LeftOut left_out;  // with what the whole model lacks
  std::uint32_t bounces = 0;
  std::vector<measure::ModelDifference> views;  // against the whole model; empty where absent
  // Pixels that see a lamp do not count: it looks otherwise, whatever it lights.
  bool without_lamps_seen = false;
  ModelCost saved;  // below 0 where it costs more
  // Greatest over views; and with two standard errors less and more.
  double error = 0, least = 0, bound = 0;
  double saving = 0;  // share of the whole price: see find_saving
};

struct PriceReport {
  std::string device;
  std::vector<std::string> views;
  std::size_t triangles = 0, lights = 0;
  ModelCost whole;
  std::vector<double> means;       // luminance of the whole model in each view, cd/m2
  std::vector<double> lamps_seen;  // share of the pixels of each view that see a lamp
  std::vector<SimplerModel> rows;
  std::vector<std::size_t> measured;  // rows that are present
  CutChoice choice;                   // its cuts are indices into `measured`
  // The chosen model, measured with random numbers of its own: its bound is within the limit. The
  // whole model where nothing can be left out.
  SimplerModel chosen;
};

/// Returns the value of a measure, and its standard error. All of them are additive at most: the
/// error of two changes together is at most the sum of both.
measure::Estimate value_of(ErrorMeasure measure, const measure::ModelDifference& difference);

/// Returns the share of the whole model's price that a simpler one saves: the mean of the shares of
/// milliseconds and bytes. Milliseconds count where they are more than two standard errors from
/// none, load times not: they are measured once.
double find_saving(const ModelCost& saved, const ModelCost& whole);

/// Measures the scene. Throws Error, or UsageError where no picture can be measured: fewer than
/// three runs, a view without light.
PriceReport price_scene(const PriceOptions& options, program::ProgressDisplay& progress);

}  // namespace nightcity::experiments
