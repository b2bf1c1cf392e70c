// The options that every command with a renderer has, declared once.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

#include "runtime/gpu/device.h"
#include "runtime/render/model_parts.h"
#include "runtime/render/setting_table.h"
#include "runtime/scene/render_scene.h"

namespace nightcity::nightview {

/// Declares the option of a setting with its range, under its name and its older names.
void declare_setting(CLI::App& command, const render::Setting& setting,
                     render::RenderSettings& settings);

/// Returns the scene of SCENE.glb and SCENE.lights without these parts, and logs a warning for each
/// kind of thing that the files hold and no picture shows. Throws Error.
scene::RenderScene load_and_report(const std::string& scene, const scene::PartSet& left_out = {});

/// Declares the argument "scene".
void declare_scene(CLI::App& command, std::string& scene);

/// Declares --projection, which find_projection takes.
void declare_projection(CLI::App& command, std::string& projection);

/// Declares --size.
void declare_size(CLI::App& command, std::string& size);

struct RenderOptions {
  std::string scene;
  gpu::Device::Options device;
  std::string camera = "overview";
  std::string size = "1280x720";
  std::string time = "20:00";
  std::string sky_map, moon, lights = "all";
  std::string settings_file, leave_out, preset, edits;
  render::RenderSettings settings;
  // The result is a picture that a person looks at, and no figure: unless a sky is asked for, it
  // has the city's own.
  bool to_be_looked_at = false;

  /// Declares the scene, --settings, --preset, --leave-out, --size, --time, --camera, --device,
  /// --trace, --sky-map, --moon, --lights, --edits and all settings. `command` must outlive the
  /// object.
  void declare(CLI::App& command);
  /// Reads the settings file, and converts the parsed text to settings, left_out, width and height.
  /// An option of the command line goes before the file's value. Throws Error, or UsageError.
  void resolve();

  /// Returns the scene with the sky map that the options name, without the parts that they leave
  /// out. Throws Error.
  scene::RenderScene load() const { return load(scene); }
  /// The same without these parts, and without warnings; of another scene too.
  scene::RenderScene load(const scene::PartSet& parts) const { return load(scene, parts); }
  scene::RenderScene load(const std::string& other, const scene::PartSet& parts,
                          const scene::TakeTraits& take = {}) const;
  /// The first of another scene.
  scene::RenderScene load(const std::string& other, const scene::TakeTraits& take = {}) const;

  // Set by resolve().
  std::uint32_t width = 0, height = 0;
  render::LeftOut left_out;

 private:
  bool is_given(const std::string& option) const;
  void read_settings();
  void apply_preset(const std::string& name);
  void make_sky(const std::string& name, scene::RenderScene& loaded) const;

  CLI::App* command_ = nullptr;
  bool has_sky_ = false;  // the user asked for one
};

}  // namespace nightcity::nightview
