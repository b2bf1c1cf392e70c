// The mean colour of a picture file: what a surface reflects on average under its texture.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>

namespace nightcity {

/// 8,192 by 8,192. A picture takes four bytes a pixel while it is read, and a file of sixty
/// kilobytes may hold a gigabyte of one colour.
constexpr std::int64_t max_picture_pixels = std::int64_t{1} << 26;

/// Returns the mean of a PNG or JPEG, whose values are sRGB, as linear Rec. 709. Each pixel counts
/// by its alpha where `use_alpha`, and alike otherwise. Returns nothing if the bytes are no such
/// picture, it has more than `max_pixels`, or no pixel counts.
std::optional<glm::dvec3> find_picture_mean(std::span<const std::byte> bytes, bool use_alpha,
                                            std::int64_t max_pixels = max_picture_pixels);

}  // namespace nightcity
