// The triangles of a scene as the device has them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "formats/large_vector.h"
#include "runtime/gpu/buffer.h"
#include "runtime/gpu/device.h"
#include "runtime/scene/render_scene.h"

namespace nightcity::render {

/// Returns how many there are: one that a hierarchy of ours cuts comes several times.
std::size_t count_device_triangles(const gpu::Device& device, const scene::RenderScene& scene);

/// Returns their numbers: in the order of the leaves, or each once (`once`, which has to stay) for
/// the device's own structures.
std::span<const std::uint32_t> order_triangles(const gpu::Device& device,
                                               const scene::RenderScene& scene,
                                               LargeVector<std::uint32_t>& once);

/// Uploads triangles by their numbers.
gpu::Buffer upload_triangles(gpu::Device& device, const scene::RenderScene& scene,
                             std::span<const std::uint32_t> order);

}  // namespace nightcity::render
