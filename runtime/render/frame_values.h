// Turns settings into the values that shaders read in a frame.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

#include "runtime/render/settings.h"
#include "shaders/frame.h"

namespace nightcity::render {

/// Returns how many partners a pixel has in one frame at most: those without history may have more
/// than the others.
std::uint32_t pairings_of(const ReuseSettings& reuse);

/// Returns the n-th position within a pixel, each coordinate in [0, 1), from the pixel's centre on:
/// the R2 sequence (Roberts 2018).
glm::vec2 find_sub_pixel(std::uint32_t number);

/// Turns a camera to the horizon: viewers of panoramas take their middle row for it.
void level_camera(gpu::Camera& camera);

/// Returns the air of a scene whose lowest point is `ground_m` high.
gpu::Air make_air(const AirSettings& settings, float ground_m);

/// Fills in how lights are sampled and reservoirs reused. The frame's scene and number are there.
/// `step_cd_m2` is the light that shows as one step of an 8-bit picture; 0 = not known yet.
void fill_sampling(gpu::Frame& frame, const RenderSettings& settings, float step_cd_m2);

}  // namespace nightcity::render
