// From a sweep's table to presets.
#pragma once

#include <string>
#include <vector>

#include "runtime/measure/table.h"

namespace nightcity::experiments {

/// A combination of settings of a sweep, over all its views.
struct SweptSettings {
  std::string settings;  // "estimator=traced candidates=8": those that differ in the sweep
  double ms = 0;         // geometric mean over the views
  double relative_mse = 0;
  bool on_front = false;  // of these means
};

/// Returns the combinations of estimators without bias (and without the reference) that were
/// measured in every view, for the fewest frames averaged: a frame is what a preset is about. In
/// rising order of milliseconds. Throws Error where the table lacks a column or has no such row.
std::vector<SweptSettings> read_swept_settings(const measure::Table& sweep);

/// The picks, as indices into the combinations. With logarithms of milliseconds and error scaled to
/// 0 .. 1 along the front: `accurate` has the smallest error; `fast` is the cheapest of those with
/// an error at most `max_ratio` times as large, so that no preset is of no use; `balanced` is the
/// knee between them, the point of the front that lies farthest below the line that joins them
/// (Satopaa et al. 2011, "Finding a kneedle in a haystack").
struct PresetPicks {
  std::size_t fast, balanced, accurate;
};
constexpr double max_preset_ratio = 30;
PresetPicks pick_presets(const std::vector<SweptSettings>& combinations,
                         double max_ratio = max_preset_ratio);

/// Returns the lines of runtime/render/preset_table.inc for a class of devices.
std::string to_preset_lines(const std::string& device_class,
                            const std::vector<SweptSettings>& combinations,
                            const PresetPicks& picks);

}  // namespace nightcity::experiments
