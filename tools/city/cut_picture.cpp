#include "tools/city/cut_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>

#include "formats/srgb.h"
#include "tools/city/picture_shelf.h"

namespace nightcity::city {
namespace {

constexpr std::int64_t max_side = 2048;

// Along one side: the first pixel of the box, and how many pixels of the picture make one of it.
struct Side {
  std::int64_t first, step, count;
};
Side find_side(double low, double high) {
  const auto first = static_cast<std::int64_t>(std::floor(low));
  const std::int64_t all = std::max<std::int64_t>(std::llround(std::ceil(high)) - first, 1);
  const std::int64_t step = (all + max_side - 1) / max_side;
  return {first, step, (all + step - 1) / step};
}

std::int64_t wrap(std::int64_t i, int size) {
  return (i % size + size) % size;
}

// Returns the mean of a square of `step` pixels; of a large one, of some in it.
std::array<std::uint8_t, 3> find_mean(const Picture& picture, const Side& x, const Side& y,
                                      std::int64_t column, std::int64_t row) {
  constexpr std::int64_t max_samples = 4;
  const std::int64_t nx = std::min(x.step, max_samples), ny = std::min(y.step, max_samples);
  std::array<double, 3> sum{};
  std::array<std::uint8_t, 3> mean;
  for (std::int64_t j = 0; j < ny; ++j)
    for (std::int64_t i = 0; i < nx; ++i) {
      const std::int64_t px = wrap(x.first + column * x.step + i * x.step / nx, picture.width()),
                         py = wrap(y.first + row * y.step + j * y.step / ny, picture.height());
      const auto* pixel =
          picture.pixels().data() + 4 * static_cast<std::size_t>(py * picture.width() + px);
      for (std::size_t c = 0; c < 3; ++c) sum[c] += linear_from_srgb8(pixel[c]);
    }
  for (std::size_t c = 0; c < 3; ++c)
    mean[c] = srgb8_from_linear(sum[c] / static_cast<double>(nx * ny));
  return mean;
}

// Fills the part's rows where each of its pixels is one of the picture's, as most are.
void copy_rows(const Picture& picture, const Side& x, const Side& y, SurfacePicture& part) {
  std::vector<std::size_t> columns;  // bytes from the beginning of a row
  for (std::int64_t column = 0; column < x.count; ++column)
    columns.push_back(4 * static_cast<std::size_t>(wrap(x.first + column, picture.width())));
  const unsigned char* const pixels = picture.pixels().data();
  std::uint8_t* to = part.rgb.data();
  for (std::int64_t row = 0; row < y.count; ++row) {
    const unsigned char* const from =
        pixels +
        4 * static_cast<std::size_t>(wrap(y.first + row, picture.height()) * picture.width());
    for (const std::size_t column : columns) to = std::copy_n(from + column, 3, to);
  }
}

void average_rows(const Picture& picture, const Side& x, const Side& y, SurfacePicture& part) {
  std::uint8_t* to = part.rgb.data();
  for (std::int64_t row = 0; row < y.count; ++row)
    for (std::int64_t column = 0; column < x.count; ++column) {
      const auto mean = find_mean(picture, x, y, column, row);
      to = std::copy(mean.begin(), mean.end(), to);
    }
}

}  // namespace

std::shared_ptr<const SurfacePicture> cut_picture(const Picture& picture,
                                                  const std::vector<glm::dvec2>& places,
                                                  std::int64_t& pixels_left) {
  constexpr double farthest = 1000;  // repetitions
  const glm::dvec2 size(picture.width(), picture.height());
  glm::dvec2 low(farthest * size), high(-low);
  const auto to_pixels = [&](const glm::dvec2& p) { return glm::dvec2(p.x, 1 - p.y) * size; };
  for (const glm::dvec2& p : places) {
    if (!(std::abs(p.x) < farthest) || !(std::abs(p.y) < farthest)) return {};
    low = glm::min(low, to_pixels(p));
    high = glm::max(high, to_pixels(p));
  }
  if (places.empty()) return {};
  const Side x = find_side(low.x, high.x), y = find_side(low.y, high.y);
  if (x.count * y.count > pixels_left) return {};
  pixels_left -= x.count * y.count;

  const auto part = std::make_shared<SurfacePicture>();
  part->width = static_cast<int>(x.count);
  part->height = static_cast<int>(y.count);
  part->rgb.resize(static_cast<std::size_t>(3 * x.count * y.count));
  if (x.step == 1 && y.step == 1)
    copy_rows(picture, x, y, *part);
  else
    average_rows(picture, x, y, *part);
  for (const glm::dvec2& p : places)
    part->places.push_back((to_pixels(p) - glm::dvec2(x.first, y.first)) /
                           glm::dvec2(x.step, y.step));
  return part;
}

void lay_picture(const Picture& picture, const std::vector<glm::dvec2>& places, Textures textures,
                 Polygon& polygon, std::int64_t& pixels_left, SkipCounter& skipped) {
  glm::dvec2 low = places.front(), high = low;
  for (const glm::dvec2& place : places) {
    low = glm::min(low, place);
    high = glm::max(high, place);
  }
  polygon.diffuse_colour = find_mean_step(picture, low, high);
  if (textures != Textures::atlas) return;
  polygon.picture = cut_picture(picture, places, pixels_left);
  if (!polygon.picture) skipped.add(texture_not_cut);
}

void reverse_rings(Polygon& polygon) {
  std::shared_ptr<SurfacePicture> picture;
  if (polygon.picture) picture = std::make_shared<SurfacePicture>(*polygon.picture);
  std::size_t first = 0;
  const auto reverse = [&](Ring& ring) {
    std::reverse(ring.begin(), ring.end());
    if (!picture || first + ring.size() > picture->places.size()) return;
    const auto begin = picture->places.begin() + static_cast<std::ptrdiff_t>(first);
    std::reverse(begin, begin + static_cast<std::ptrdiff_t>(ring.size()));
    first += ring.size();
  };
  reverse(polygon.exterior);
  for (Ring& ring : polygon.interiors) reverse(ring);
  if (picture) polygon.picture = std::move(picture);
}

}  // namespace nightcity::city
