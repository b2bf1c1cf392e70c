// Error and cost of every frame of a moving camera.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "formats/program/progress_display.h"
#include "runtime/experiments/experiment.h"
#include "runtime/render/governor.h"

namespace nightcity::experiments {

struct FlightOptions {
  std::filesystem::path folder;         // gets flight.csv and the pictures
  std::string path = "orbit";           // preset or file: see find_path
  std::uint32_t frames = 120;           // along the path
  double time_step_s = 0;               // the clock moves on by this much before every frame
  std::uint32_t every = 1;              // the error of every Nth frame is measured
  std::uint32_t reference_frames = 16;  // of each reference picture
  std::optional<float> ev100;           // of the pictures; not set: metered from the first
  bool pictures = false;                // writes every frame as PNG
  render::GovernorOptions governor;     // governs where it has a budget or a target
};

/// The figures of a flight. They leave out the first frame, which has no history and in which the
/// driver compiles.
struct FlightReport {
  std::string device;
  std::vector<double> ms;                    // of every frame
  std::optional<render::Governor> governor;  // as it was at the end
  // One value for each measured frame. The mean signed error is relative to the reference's mean.
  std::vector<double> rmse8, relative_mse, mean_signed_error, fireflies;
};

/// Flies along the path, the clock starting at settings.time_s, and compares the measured frames
/// with references of their own views. Writes flight.csv and, where asked for, frame-NNNN.png. With
/// a budget or a target the effort of each frame is governed: its rungs are measured at the path's
/// beginning, middle and end first, its choices are in the report and logged, and flight.csv has
/// the effort of each frame. Throws Error.
FlightReport fly(const FlightOptions& options, Experiment& experiment,
                 render::RenderSettings settings, program::ProgressDisplay& progress);

}  // namespace nightcity::experiments
