#include "runtime/viewer/city.h"

#include <filesystem>

#include "formats/cancel.h"
#include "formats/error.h"
#include "runtime/viewer/live_picture.h"

namespace nightcity::viewer {

std::string name_of(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

Opening::Opening(std::string path, std::string camera, const render::RenderSettings& settings,
                 LoadScene load)
    : path_(std::move(path)), settings_(settings) {
  city_ = std::async(std::launch::async, [this, path = path_, camera = std::move(camera),
                                          load = std::move(load),
                                          device = device_.get_future()]() mutable {
    const CancelScope scope(stop_.get_token());
    auto city = std::make_unique<City>();
    city->path = path;
    city->scene = load(path, [this](const scene::SceneTraits& traits) {
      const std::lock_guard lock(mutex_);
      traits_ = traits;
      compile_early();
    });
    throw_if_cancelled();
    try {
      city->notice = city->edits.open(LightEditor::find_file(path), city->scene);
    } catch (const Error& error) {  // the city is there without them
      city->notice = error.what();
    }
    city->projection = std::make_unique<MapProjection>(city->scene.georeference.crs,
                                                       city->scene.places.geographic);
    city->triangles = city->scene.triangles.size();
    throw_if_cancelled();
    stage_ = "finding the camera";
    city->pose = scene::find_camera(camera, city->scene);
    throw_if_cancelled();
    stage_ = "copying to the device";
    // Lights are switched in the background later, so that the clock never blocks the window;
    // the first frame has its lights already.
    city->on_device =
        std::make_unique<render::DeviceScene>(*device.get(), city->scene, settings_.light_moment());
    city->on_device->switch_when_ready();
    return city;
  });
}

Opening::~Opening() {
  stop_.request_stop();
  device_ = {};  // a thread that still waits for a device ends by an exception
  if (city_.valid()) city_.wait();
}

void Opening::set_device(gpu::Device& device, render::PassLibrary& passes) {
  device_.set_value(&device);
  const std::lock_guard lock(mutex_);
  passes_ = &passes;
  compile_early();
}

void Opening::compile_early() {
  if (passes_ && traits_) start_first_passes(*passes_, settings_, *traits_);
}

double Opening::elapsed_s() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

bool Opening::is_done() const {
  return city_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

}  // namespace nightcity::viewer
