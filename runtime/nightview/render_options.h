// The options that every command with a renderer has, declared once.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

#include "runtime/gpu/device.h"
#include "runtime/render/settings.h"
#include "runtime/scene/render_scene.h"

namespace nightcity {

/// "HH:MM" or "HH:MM:SS" to seconds since noon. Throws UsageError.
double parse_time(const std::string& text);

struct RenderOptions {
  std::string scene;
  gpu::Device::Options device;
  std::string camera = "overview";
  std::string size = "1280x720";
  std::string estimator = name_of(RenderSettings{}.estimator);
  std::string time = "20:00";
  std::string sky_map, moon;
  RenderSettings settings;

  /// Declares --size, --estimator, --candidates, --neighbours, --seed, --device, --trace, --camera and the
  /// finer ones.
  void declare(CLI::App& command);
  /// After parsing: names to settings. Throws UsageError.
  void resolve();

  /// The scene, with the sky map that the options name. Throws Error.
  RenderScene load() const;

  std::uint32_t width = 0, height = 0;  // after resolve()
};

}  // namespace nightcity
