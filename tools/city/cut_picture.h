// Cuts out of a texture what lies on one polygon.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <vector>

#include "formats/picture_mean.h"
#include "tools/city/city_model.h"
#include "tools/city/city_reader.h"
#include "tools/city/skip_counter.h"

namespace nightcity::city {

/// The pixels that the pictures of one object may have, together: what is on the way through the
/// program stays small, whatever a file says.
constexpr std::int64_t max_object_pixels = std::int64_t{1} << 24;

/// Reasons, as readers count them, for which a polygon has no picture.
constexpr const char* texture_misfit =
    "texture: a ring has another number of texture coordinates than of vertices";
constexpr const char* texture_not_cut =
    "texture: its place in the picture is no number, or its object has too many pixels";

/// Returns the box of the picture around `places`, which are texture coordinates from the lower
/// left corner, 1 being the picture's width and height, beyond which it repeats. A box of more than
/// 2048 pixels a side is made smaller. Null where a coordinate is no number or beyond a thousand
/// repetitions, or where `pixels_left`, from which it takes its own, does not suffice.
std::shared_ptr<const SurfacePicture> cut_picture(const Picture& picture,
                                                  const std::vector<glm::dvec2>& places,
                                                  std::int64_t& pixels_left);

/// Gives a polygon the mean of the picture between `places`, at least one, as its colour
/// (find_mean_step) and, with Textures::atlas, what cut_picture() cuts out. `skipped` counts where
/// that is nothing.
void lay_picture(const Picture& picture, const std::vector<glm::dvec2>& places, Textures textures,
                 Polygon& polygon, std::int64_t& pixels_left, SkipCounter& skipped);

/// Turns the rings of a polygon round, and its picture with them.
void reverse_rings(Polygon& polygon);

}  // namespace nightcity::city
