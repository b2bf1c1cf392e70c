#include "runtime/viewer/viewer.h"

#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <memory>

#include "formats/error.h"
#include "formats/rgb9e5.h"
#include "runtime/measure/exposure.h"
#include "runtime/measure/exr.h"
#include "runtime/measure/png.h"
#include "runtime/render/renderer.h"
#include "runtime/scene/markers.h"
#include "runtime/viewer/camera_motion.h"
#include "runtime/viewer/overlay.h"
#include "runtime/viewer/panel.h"
#include "runtime/viewer/screen.h"
#include "runtime/viewer/swapchain.h"
#include "runtime/viewer/window.h"

namespace nightcity::viewer {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_between(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

bool is_power_of_four(std::uint32_t n) {
  while (n > 1 && n % 4 == 0) n /= 4;
  return n == 1;
}

gpu::Device::Options for_window(gpu::Device::Options options, const Window& window) {
  options.instance_extensions = window.instance_extensions();
  options.device_extensions = {VK_KHR_SWAPCHAIN_EXTENSION_NAME};
  return options;
}

class Viewer {
 public:
  Viewer(scene::RenderScene scene, const ViewOptions& options)
      : options_(options),
        scene_(std::move(scene)),
        window_(options.width, options.height, "nightview"),
        device_(for_window(options.device, window_)),
        swapchain_(device_, window_.create_surface(device_.instance())),
        device_scene_(device_, scene_),
        passes_(device_),
        screen_(device_) {
    state_.settings = options.settings;
    state_.pose = scene::find_camera(options.camera, scene_);
    state_.markers = options.markers;
    state_.divisor = options.divisor;
    state_.auto_exposure = !options.ev100;
    if (options.ev100) state_.settings.display.ev100 = *options.ev100;
    stats_.scene = std::filesystem::path(options.scene).filename().string();
    stats_.device = device_.label();
    stats_.triangles = scene_.triangles.size();
    stats_.lights = scene_.lights.size();
    state_.night_changes = !scene_.traffic.trips.empty() || !scene_.schedules.empty();
    state_.play = options.play;
    // Lights are switched in the background, so that the clock never blocks the window; the first
    // frame has its lights already.
    device_scene_.set_time(options.settings.time_s);
    device_scene_.switch_when_ready();
    swapchain_.resize(window_.size());
    overlay_ = std::make_unique<Overlay>(device_, window_, swapchain_);
  }

  ViewReport run() {
    while (!window_.closing() && (options_.quit_after == 0 || shown_ < options_.quit_after)) step();
    if (!options_.save_camera.empty()) scene::write_camera(options_.save_camera, state_.pose);
    device_.check_validation();
    return {shown_, stats_.frames, render::name_of(state_.settings.sampling.estimator)};
  }

 private:
  void step() {
    const auto start = Clock::now();
    // With nothing to render, sleep until there is input, but keep the panel alive.
    const bool idle =
        !restart_ && stats_.frames >= options_.max_frames && !device_scene_.switching();
    const InputState input = window_.poll(idle ? 0.05 : 0.0);
    handle_keys(input);
    const double elapsed_s = std::min(seconds_between(last_step_, start), 0.25);
    move_camera(input, elapsed_s);
    run_clock(elapsed_s);
    last_step_ = start;

    const glm::uvec2 size = window_.size();
    if (size.x == 0 || size.y == 0) {  // minimised
      window_.poll(0.1);
      return;
    }
    if (size != swapchain_.size() || outdated_) swapchain_.resize(size);
    outdated_ = false;
    if (!idle || restart_) render();
    show();
    stats_.frame_ms = 1000 * seconds_between(start, Clock::now());
  }

  void handle_keys(const InputState& input) {
    if (overlay_->wants_keys()) return;
    for (const int key : input.pressed) {
      const auto& names = render::list_estimators();
      const auto number = static_cast<std::size_t>(key - GLFW_KEY_1);
      if (key >= GLFW_KEY_1 && number < names.size()) {
        state_.settings.sampling.estimator = names[number].estimator;
        restart_ = true;
      }
      if (key == GLFW_KEY_M) state_.markers = !state_.markers;
      if (key == GLFW_KEY_F) state_.fly = !state_.fly;
      if (key == GLFW_KEY_P) save_picture();
      if (key == GLFW_KEY_SPACE) state_.play = !state_.play;
      if (key == GLFW_KEY_TAB) state_.show_panel = !state_.show_panel;
      if (key == GLFW_KEY_ESCAPE) glfwSetWindowShouldClose(window_.handle(), GLFW_TRUE);
    }
  }

  void move_camera(const InputState& input, double seconds) {
    const scene::CameraPose before = state_.pose;
    scene::CameraPose& pose = state_.pose;
    if (!overlay_->wants_mouse()) {
      constexpr float radians_per_pixel = 0.005f;
      const glm::vec2 angle = input.drag * radians_per_pixel;
      if (angle != glm::vec2(0))
        pose = state_.fly ? turned(pose, angle.x, angle.y) : orbited(pose, -angle.x, angle.y);
      // Metres per pixel at the target's distance: the point under the cursor follows it.
      const float height_m =
          2 * std::tan(glm::radians(pose.fov_deg) / 2) * glm::distance(pose.position, pose.target);
      const float metres = height_m / static_cast<float>(std::max(1u, window_.size().y));
      if (input.pan != glm::vec2(0))
        pose = moved(pose, {-input.pan.x * metres, input.pan.y * metres, 0});
      if (input.scroll != 0) {
        if (state_.fly) {
          state_.speed_m_s =
              std::clamp(state_.speed_m_s * std::pow(1.2f, input.scroll), 0.5f, 500.0f);
        } else {
          pose = dollied(pose, std::pow(0.9f, input.scroll));
        }
      }
    }
    if (!overlay_->wants_keys() && input.fly != glm::vec3(0)) {
      const float metres =
          state_.speed_m_s * (input.fast ? 5.0f : 1.0f) * static_cast<float>(seconds);
      pose = moved(pose, metres * glm::normalize(input.fly));
    }
    restart_ |= pose.position != before.position || pose.target != before.target;
  }

  void run_clock(double elapsed_s) {
    if (!state_.play || !state_.night_changes) return;
    double& time_s = state_.settings.time_s;
    time_s +=
        options_.time_step_s > 0 ? options_.time_step_s : elapsed_s * double(state_.clock_speed);
    if (time_s > night_end_s || time_s < night_begin_s) time_s = night_begin_s;
    restart_ = true;
  }

  void render() {
    const auto divisor =
        static_cast<std::uint32_t>(state_.divisor > 0 ? state_.divisor : auto_divisor_);
    const glm::uvec2 size = glm::max(swapchain_.size() / divisor, glm::uvec2(1));
    if (!renderer_ || renderer_->width() != size.x || renderer_->height() != size.y) {
      renderer_.reset();  // frees its memory before the new one allocates
      renderer_ =
          std::make_unique<render::Renderer>(device_, passes_, device_scene_, size.x, size.y);
    }
    state_.settings.averaging.accumulate = state_.accumulate;
    // While the clock runs, the picture is the mean of the last few frames and follows motion.
    constexpr std::uint32_t frames_in_motion = 8;
    state_.settings.averaging.window = state_.play && state_.night_changes ? frames_in_motion : 0;
    restart_ = false;
    const auto start = Clock::now();
    renderer_->render_frame(state_.pose, state_.settings);
    if (state_.divisor == 0) adapt(seconds_between(start, Clock::now()));
    stats_.width = size.x;
    stats_.height = size.y;
    stats_.frames = renderer_->frames();
    stats_.passes = renderer_->timings();
    meter();
  }

  // Chooses the most pixels that still respond to input at once: a CPU driver may take seconds for
  // all of them. A step changes the number of pixels by four, so the two limits are more than a
  // factor of four apart.
  void adapt(double seconds) {
    if (shown_ == 0) return;  // the first frame compiles shaders
    if (seconds < 0.06 && auto_divisor_ > 1) {
      auto_divisor_ /= 2;
    } else if (seconds > 0.4 && auto_divisor_ < 8) {
      auto_divisor_ *= 2;
    } else {
      return;
    }
    restart_ = true;
  }

  // The mean improves over time, so it is metered now and then, but not at every step of a moving
  // camera.
  void meter() {
    const auto now = Clock::now();
    if (!state_.auto_exposure || !is_power_of_four(stats_.frames)) return;
    if (metered_ && seconds_between(*metered_, now) < 0.25) return;
    metered_ = now;
    state_.settings.display.ev100 = measure::auto_exposure_ev100(renderer_->download(false));
    restart_ = true;  // shows the picture with the new exposure even when the mean is full
  }

  void show() {
    overlay_->begin();
    PanelRequests requests;
    if (state_.show_panel) requests = draw_panel(state_, stats_);
    if (state_.markers) draw_markers();
    draw_caption();
    overlay_->end();

    restart_ |= requests.restart;
    if (!requests.camera_preset.empty()) {
      state_.pose = scene::find_camera(requests.camera_preset, scene_);
      restart_ = true;
    }
    if (requests.save) save_picture();

    if (!swapchain_.acquire()) {
      outdated_ = true;
      return;
    }
    ++shown_;
    const bool last = options_.quit_after != 0 && shown_ == options_.quit_after;
    measure::Image8 grabbed;
    measure::Image8* grab = last && !options_.screenshot.empty() ? &grabbed : nullptr;
    outdated_ = !screen_.show(
        swapchain_, renderer_->display(), {renderer_->width(), renderer_->height()},
        [this](VkCommandBuffer commands) { overlay_->record(commands); }, grab);
    if (grab)
      measure::write_png(options_.screenshot, grabbed,
                         measure::png_text(renderer_->download(false).info));
  }

  void draw_markers() {
    // More would cover the picture, and ImGui's indices end at 65,535 vertices per list.
    constexpr std::size_t max_markers = 20000;
    const glm::vec2 size(swapchain_.size());
    const gpu::Camera camera = scene::make_camera(state_.pose, size.x / size.y);
    ImDrawList* list = ImGui::GetBackgroundDrawList();
    for (const scene::Marker& marker : scene::find_markers(camera, scene_.lights, max_markers)) {
      const glm::vec3 colour = decode_rgb9e5(scene_.lights[marker.light].colour_rgb9e5);
      const float brightest = std::max({colour.r, colour.g, colour.b, 1e-6f});
      const ImU32 packed = ImGui::ColorConvertFloat4ToU32(
          {colour.r / brightest, colour.g / brightest, colour.b / brightest, 0.9f});
      const ImVec2 at{marker.at.x * size.x, marker.at.y * size.y};
      const float radius = std::clamp(200.0f / marker.distance, 2.0f, 12.0f);
      list->AddCircle(at, radius, packed, 8, 1.5f);
    }
  }

  void draw_caption() {
    const std::string text = caption(state_, stats_);
    ImDrawList* list = ImGui::GetForegroundDrawList();
    const ImVec2 at{12, static_cast<float>(swapchain_.size().y) - 24};
    list->AddText({at.x + 1, at.y + 1}, IM_COL32(0, 0, 0, 255), text.c_str());
    list->AddText(at, IM_COL32(255, 255, 255, 255), text.c_str());
    window_.set_title(fmt::format("{} - {} - nightview", stats_.scene, text));
  }

  // Writes night-NNN.png and .exr in the current folder, under the first free number.
  void save_picture() {
    if (!renderer_) return;
    std::string stem;
    for (int i = 1; stem.empty(); ++i) {
      const std::string name = fmt::format("night-{:03}", i);
      if (!std::filesystem::exists(name + ".png") && !std::filesystem::exists(name + ".exr"))
        stem = name;
    }
    const measure::Image image = renderer_->download();
    try {
      measure::write_exr(stem + ".exr", image);
      measure::write_png(
          stem + ".png",
          measure::to_display(image, state_.settings.display.ev100, state_.settings.display.tone),
          measure::png_text(image.info));
      spdlog::info("{0}.png and {0}.exr: {1}", stem, caption(state_, stats_));
    } catch (const Error& error) {
      spdlog::error("{}", error.what());  // a full disk is no reason to close the window
    }
  }

  ViewOptions options_;
  scene::RenderScene scene_;
  Window window_;
  gpu::Device device_;
  Swapchain swapchain_;
  render::DeviceScene device_scene_;
  render::PassLibrary passes_;
  Screen screen_;
  std::unique_ptr<Overlay> overlay_;
  std::unique_ptr<render::Renderer> renderer_;
  ViewerState state_;
  FrameStats stats_;
  int auto_divisor_ = 8;   // used when state_.divisor is 0
  bool restart_ = true;    // something changed: render even when the mean is full
  bool outdated_ = false;  // the swapchain no longer fits the window
  std::uint32_t shown_ = 0;
  Clock::time_point last_step_ = Clock::now();
  std::optional<Clock::time_point> metered_;
};

}  // namespace

ViewReport run_viewer(scene::RenderScene scene, const ViewOptions& options) {
  return Viewer(std::move(scene), options).run();
}

}  // namespace nightcity::viewer
