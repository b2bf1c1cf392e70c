// The layers that a rendered picture carries beside its colours.
#pragma once

#include <cstdint>
#include <span>

#include "runtime/measure/image.h"
#include "runtime/render/device_scene.h"

namespace nightcity::render {

/// Adds "luminance", cd/m^2.
void add_luminance_layer(measure::Image& image);

/// Adds "direct_lamps", "direct_windows", "direct_vehicles", "sky", "emitted", "indirect"
/// and "air", cd/m^2: the sums over `frames` frames, divided by their number.
void add_light_layers(measure::Image& image, std::span<const gpu::LayerSums> sums,
                      std::uint32_t frames);

/// Adds what the camera saw in each pixel: "albedo", "normal", "position" (m), "motion" (m per
/// frame), "depth" (m), "material" and "feature" (ids, -1 = none).
void add_surface_layers(measure::Image& image, std::span<const gpu::Surface> surfaces,
                        const DeviceScene& scene);

/// Adds "transmittance": the share of a surface's light that the air in front of it lets pass, 1
/// where no surface is seen. `camera_height` is the camera's, m.
void add_transmittance_layer(measure::Image& image, std::span<const gpu::Surface> surfaces,
                             const gpu::Air& air, float camera_height);

}  // namespace nightcity::render
