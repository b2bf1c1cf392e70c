// The mean colour of a picture file: what a surface reflects on average under its texture.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <span>

namespace nightcity {

/// Returns the mean of a PNG or JPEG, whose values are sRGB, as linear Rec. 709. Each pixel counts
/// by its alpha where `use_alpha`, and alike otherwise. Returns nothing if the bytes are no such
/// picture, a side is longer than 16,384 pixels, or no pixel counts.
std::optional<glm::dvec3> find_picture_mean(std::span<const std::byte> bytes, bool use_alpha);

}  // namespace nightcity
