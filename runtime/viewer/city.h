// A city that the window shows, and its loading in the background.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>

#include "runtime/gpu/device.h"
#include "runtime/render/device_scene.h"
#include "runtime/render/pass_library.h"
#include "runtime/render/settings.h"
#include "runtime/scene/camera.h"
#include "runtime/scene/render_scene.h"
#include "runtime/viewer/light_editor.h"
#include "runtime/viewer/map_projection.h"

namespace nightcity::viewer {

struct City {
  std::string path;
  scene::RenderScene scene;
  std::unique_ptr<render::DeviceScene> on_device;
  scene::CameraPose pose;  // of the camera that was asked for
  std::size_t triangles = 0;
  std::unique_ptr<MapProjection> projection;
  LightEditor edits;   // of its lights, which the scene has already
  std::string notice;  // what is to be said about it, or ""
};

/// Returns the file name of a path, as titles show it.
std::string name_of(const std::string& path);

/// Reads a scene, and hands over its expected traits as soon as they are known.
using LoadScene =
    std::function<scene::RenderScene(const std::string& path, const scene::TakeTraits& take)>;

/// Reads a scene, copies it to the device and finds the camera's pose in a thread of its own, whose
/// token (formats/cancel.h) asks for an end once nobody waits for the city. Meanwhile the passes of
/// its first picture are compiled.
class Opening {
 public:
  /// `camera`: as find_camera takes it. Lights are switched as `settings` say, with which the city
  /// is shown first.
  Opening(std::string path, std::string camera, const render::RenderSettings& settings,
          LoadScene load);
  /// Ends the thread, which looks between its pieces of work whether it is to.
  ~Opening();
  Opening(const Opening&) = delete;
  Opening& operator=(const Opening&) = delete;

  /// Says where the scene goes: reading begins without it. Call it once. Both must outlive the
  /// object.
  void set_device(gpu::Device& device, render::PassLibrary& passes);
  /// Returns what is being done, in a few words.
  const char* stage() const { return stage_.load(); }
  const std::string& path() const { return path_; }
  double elapsed_s() const;
  bool is_done() const;
  /// Waits for the city. Throws what loading threw.
  std::unique_ptr<City> take() { return city_.get(); }

 private:
  // Compiles the passes of the first picture, once traits and library are both known.
  void compile_early();

  std::string path_;
  render::RenderSettings settings_;
  std::mutex mutex_;  // of these two
  std::optional<scene::SceneTraits> traits_;
  render::PassLibrary* passes_ = nullptr;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::atomic<const char*> stage_{"reading"};
  std::stop_source stop_;
  std::promise<gpu::Device*> device_;
  std::future<std::unique_ptr<City>> city_;
};

}  // namespace nightcity::viewer
