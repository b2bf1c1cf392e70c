// The sweep: error and cost of every combination of settings in every view.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "formats/program/progress_display.h"
#include "runtime/gpu/device.h"
#include "runtime/render/parse.h"
#include "runtime/render/settings.h"
#include "runtime/scene/render_scene.h"

namespace nightcity::experiments {

struct SweepOptions {
  gpu::Device::Options device;
  std::string scene;             // SCENE.glb
  std::filesystem::path folder;  // gets the table, its summaries and the reference pictures
  render::PictureSize size{640, 360};
  std::vector<std::string> views{"overview"};  // camera files or presets
  std::vector<std::uint32_t> frames{1, 16};   // errors are those of means of so many frames; rising
  std::map<std::string, std::string> values;  // lists by setting name: see list_combinations
  render::RenderSettings base;                // of what is not swept
  scene::PartSet left_out;                    // is not loaded
  std::uint32_t reference_frames = 64;        // of a reference picture
  std::uint32_t warm_up = 8;                  // frames that fill the history
  std::uint32_t repeats = 1;                  // seeds whose errors are averaged
  // The clock moves on by this much before every frame, up to the moment that is measured. A mean
  // over moments has no reference, so `frames` must then be 1.
  double time_step_s = 0;
  double minutes = 0;  // ends after the combination that takes longer than this; 0 = never
};

struct SweepReport {
  std::size_t done = 0,
              total = 0;  // combinations in all views; fewer are done when the time was up
};

/// Measures what sweep.csv in the folder lacks, and writes sweep.md and sweep-VIEW.svg from all of
/// it. Throws Error, or UsageError for a value that a setting does not take.
SweepReport run_sweep(const SweepOptions& options, program::ProgressDisplay& progress);

}  // namespace nightcity::experiments
