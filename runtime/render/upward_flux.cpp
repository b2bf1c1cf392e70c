#include "runtime/render/upward_flux.h"

#include <algorithm>
#include <cmath>

#include "runtime/render/vehicle_passes.h"

namespace nightcity::render {
namespace {

// The work of one dispatch: short enough for every watchdog and for drivers that end long loops
// (REFERENCE_CHUNK in shaders/limits.h).
constexpr std::uint32_t rays_per_dispatch = 16;
constexpr std::uint32_t lights_per_dispatch = 1u << 16;

}  // namespace

UpwardFlux measure_upward_flux(gpu::Device& device, PassLibrary& library, DeviceScene& scene,
                               const UpwardSettings& settings) {
  scene.set_time(settings.time_s);
  VehiclePasses vehicle_passes(device, scene);
  const scene::SceneTraits traits = scene.traits();
  PassConstants constants{};
  constants[CONSTANT_PROFILES] = traits.profiles;
  constants[CONSTANT_TEXTURES] = traits.textures;
  constants[CONSTANT_RECTANGLES] = traits.rectangles;
  constants[CONSTANT_SCHEDULES] = traits.schedules;
  constants[CONSTANT_TRAFFIC] = traits.traffic;
  const TracePass& pass = library.upward(constants);

  gpu::Frame frame{};
  frame.scene = scene.buffers();
  vehicle_passes.enter(frame);
  frame.seed = settings.seed;
  frame.bounces = settings.bounces;
  frame.time_s = frame.previous_time_s = float(settings.time_s);
  frame.cycle_time_s = frame.previous_cycle_time_s =
      cycle_time(frame.scene.traffic.cycle, settings.time_s);
  frame.previous_lit = frame.scene.lit;

  UpwardFlux result;
  const scene::Box box = scene.bounds();
  const float width_m = std::max(box.upper.x - box.lower.x, 1.0f),
              depth_m = std::max(box.upper.z - box.lower.z, 1.0f);
  result.cell_m = std::max(settings.cell_m, std::sqrt(width_m * depth_m / float(1u << 24)));
  result.origin_x = box.lower.x;
  result.origin_z = box.lower.z;
  result.width = static_cast<std::uint32_t>(width_m / result.cell_m) + 1;
  result.depth = static_cast<std::uint32_t>(depth_m / result.cell_m) + 1;
  const std::size_t cells = std::size_t{result.width} * result.depth;
  const std::uint32_t lights = frame.scene.light_count;
  gpu::Buffer map(device, cells * sizeof(std::uint32_t)),
      escapes(device, lights * sizeof(gpu::Escape));
  map.fill_zero();
  escapes.fill_zero();
  const std::uint32_t dispatches =
      (std::max(settings.rays, 1u) + rays_per_dispatch - 1) / rays_per_dispatch;
  frame.upward = {
      escapes.address(), map.address(), result.origin_x, result.origin_z,
      result.cell_m,     result.width,  result.depth,    dispatches * rays_per_dispatch};

  gpu::Buffer frame_buffer(device, sizeof frame, gpu::Memory::host);
  frame_buffer.upload(&frame, sizeof frame);
  if (scene.has_traffic()) {
    const std::shared_ptr<const PassSet> passes = library.get(constants);
    device.run([&](VkCommandBuffer commands) {
      for (const FrameStep& step : vehicle_passes.list_steps(*passes, frame_buffer.address())) {
        step.record(commands, 0, step.parts);
        gpu::full_barrier(commands);
      }
    });
  }
  for (std::uint32_t i = 0; i < dispatches; ++i) {
    frame.frame = i;
    frame_buffer.upload(&frame, sizeof frame);
    device.run([&](VkCommandBuffer commands) {
      for (std::uint32_t first = 0; first < lights; first += lights_per_dispatch) {
        const gpu::Push push{frame_buffer.address(), first, rays_per_dispatch};
        pass.dispatch(commands, &push, std::min(lights_per_dispatch, lights - first));
        gpu::full_barrier(commands);
      }
    });
  }

  for (const gpu::Escape& e : escapes.read<gpu::Escape>(lights)) {
    const double rays = frame.upward.rays;
    result.lights.push_back(
        {double(e.direct) / rays, double(e.reflected) / rays, double(e.sideways) / rays});
  }
  result.flux_lm = scene.flux_now();
  const auto moving = vehicle_passes.lights();
  for (const Light& light : moving) result.flux_lm.push_back(double(light.flux_lm));
  for (const std::uint32_t count : map.read<std::uint32_t>(cells))
    result.cells_lm.push_back(double(count) / 1024);
  return result;
}

}  // namespace nightcity::render
