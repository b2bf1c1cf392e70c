// The options that every command with a renderer has, declared once.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

#include "runtime/gpu/device.h"
#include "runtime/render/setting_table.h"
#include "runtime/scene/render_scene.h"

namespace nightcity::nightview {

/// Declares the option of a setting with its range, under its name and its older names.
void declare_setting(CLI::App& command, const render::Setting& setting,
                     render::RenderSettings& settings);

/// Returns the scene of SCENE.glb and SCENE.lights, and logs a warning for each kind of thing that
/// the files hold and no picture shows. Throws Error.
scene::RenderScene load_and_report(const std::string& scene);

/// Declares the argument "scene".
void declare_scene(CLI::App& command, std::string& scene);

/// Declares --size.
void declare_size(CLI::App& command, std::string& size);

struct RenderOptions {
  std::string scene;
  gpu::Device::Options device;
  std::string camera = "overview";
  std::string size = "1280x720";
  std::string time = "20:00";
  std::string sky_map, moon, lights = "all";
  render::RenderSettings settings;

  /// Declares the scene, --size, --time, --camera, --device, --trace, --sky-map, --moon, --lights and all
  /// settings.
  void declare(CLI::App& command);
  /// Converts the parsed text to settings, width and height. Throws UsageError.
  void resolve();

  /// Returns the scene with the sky map that the options name. Throws Error.
  scene::RenderScene load() const { return load(scene); }
  /// The same of another scene.
  scene::RenderScene load(const std::string& other) const;

  std::uint32_t width = 0, height = 0;  // set by resolve()
};

}  // namespace nightcity::nightview
