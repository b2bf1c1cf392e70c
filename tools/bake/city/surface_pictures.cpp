#include "tools/bake/city/surface_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <tuple>
#include <utility>

#include "formats/finite.h"
#include "formats/srgb.h"
#include "tools/city/ring.h"
#include "tools/ring_area.h"

namespace nightcity::bake {
namespace {

using Texel = std::array<double, 3>;  // linear light

double luminance(const Texel& texel) {
  return 0.2126 * texel[0] + 0.7152 * texel[1] + 0.0722 * texel[2];
}

// A picture at the size that the scene has it, in linear light.
struct Image {
  int width, height;
  std::vector<Texel> texels;

  double mean_luminance() const {
    double sum = 0;
    for (const Texel& texel : texels) sum += luminance(texel);
    return sum / static_cast<double>(texels.size());
  }
};

// Returns the picture with so many texels a side: each has the mean of the pixels that it covers.
Image resize(const city::SurfacePicture& from, int width, int height) {
  Image to{width, height, {}};
  to.texels.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  const std::array<double, 256>& linear = list_linear_of_srgb8();
  const auto range = [](int i, int count, int size) {
    const int first = static_cast<int>(std::int64_t{i} * size / count);
    const int end = static_cast<int>((std::int64_t{i + 1} * size + count - 1) / count);
    return std::pair(first, std::max(end, first + 1));
  };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto [left, right] = range(x, width, from.width);
      const auto [top, bottom] = range(y, height, from.height);
      Texel sum{};
      for (int j = top; j < bottom; ++j) {
        const std::uint8_t* pixel =
            from.rgb.data() + 3 * static_cast<std::size_t>(j * from.width + left);
        for (int i = left; i < right; ++i, pixel += 3)
          for (std::size_t c = 0; c < 3; ++c) sum[c] += linear[pixel[c]];
      }
      for (double& channel : sum) channel /= (right - left) * (bottom - top);
      to.texels.push_back(sum);
    }
  return to;
}

// Returns the texels times `gain`. One that would be brighter than white keeps its colour.
PicturePiece to_piece(const Image& image, double gain) {
  PicturePiece piece{
      static_cast<std::uint16_t>(image.width), static_cast<std::uint16_t>(image.height), {}};
  piece.rgb.reserve(3 * image.texels.size());
  for (const Texel& texel : image.texels) {
    const double most = gain * std::max({texel[0], texel[1], texel[2]});
    for (const double channel : texel)
      piece.rgb.push_back(srgb8_from_linear(gain * channel / std::max(most, 1.0)));
  }
  return piece;
}

// Surfaces that are compared with each other: those of a kind.
enum class Group : std::uint8_t { walls, roofs, others, count };
Group find_group(city::SurfaceType surface) {
  return surface == city::SurfaceType::wall   ? Group::walls
         : surface == city::SurfaceType::roof ? Group::roofs
                                              : Group::others;
}

}  // namespace

bool PictureLayout::Before::operator()(const glm::dvec3& a, const glm::dvec3& b) const {
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

glm::dvec2 PictureLayout::Placed::find(const glm::dvec3& p) const {
  const auto known = places.find(p);
  if (known != places.end()) return known->second;
  return place + glm::dvec2(glm::dot(across[0], p - at), glm::dot(across[1], p - at));
}

// The map of all vertices is that of three far from each other.
PictureLayout::Placed PictureLayout::to_placed(const city::Polygon& polygon) {
  Placed placed;
  const std::vector<glm::dvec2>& places = polygon.picture->places;
  std::vector<glm::dvec3> vertices = polygon.exterior;
  for (const city::Ring& ring : polygon.interiors)
    vertices.insert(vertices.end(), ring.begin(), ring.end());
  if (vertices.size() != places.size() || vertices.empty() ||
      !std::all_of(vertices.begin(), vertices.end(), [](const auto& p) { return finite(p); }))
    return placed;
  for (std::size_t i = 0; i < vertices.size(); ++i) placed.places.emplace(vertices[i], places[i]);
  const auto farthest = [&](auto distance) {
    std::size_t best = 0;
    for (std::size_t i = 0; i < vertices.size(); ++i)
      if (distance(vertices[i]) > distance(vertices[best])) best = i;
    return best;
  };
  placed.at = vertices[0];
  placed.place = places[0];
  const std::size_t b = farthest([&](const glm::dvec3& p) { return glm::distance(p, placed.at); });
  const glm::dvec3 along = vertices[b] - placed.at;
  const std::size_t c =
      farthest([&](const glm::dvec3& p) { return glm::length(glm::cross(along, p - placed.at)); });
  const glm::dvec3 aside = vertices[c] - placed.at, n = glm::cross(along, aside);
  const double n2 = glm::dot(n, n);
  placed.area_m2 = glm::length(city::area_vector(polygon.exterior));
  const auto end = places.begin() + static_cast<std::ptrdiff_t>(polygon.exterior.size());
  placed.pixels = std::abs(signed_area({places.begin(), end}));
  if (!(n2 > 0)) return placed;
  const glm::dvec3 to_b = glm::cross(aside, n) / n2, to_c = glm::cross(n, along) / n2;
  for (int k = 0; k < 2; ++k)
    placed.across[k] =
        to_b * (places[b][k] - placed.place[k]) + to_c * (places[c][k] - placed.place[k]);
  return placed;
}

PictureLayout::PictureLayout(city::CityObject& object) {
  for (city::Polygon& polygon : object.polygons) {
    polygon.picture_number = 0;
    if (!polygon.picture) continue;
    Placed placed = to_placed(polygon);
    if (placed.places.empty()) continue;
    placed_.push_back(std::move(placed));
    polygon.picture_number = static_cast<std::uint32_t>(placed_.size());
  }
}

SurfacePictures PictureLayout::lay_out(const mesh::TriangleMesh& mesh,
                                       const city::CityObject& object, double texels_per_m) const {
  // A picture in one size. Polygons that share it, as large as each other, share its texels.
  struct Used {
    std::uint32_t piece;
    Image image;
    Group group;
    glm::dvec2 scale;
    double area_m2 = 0;
  };
  using Key = std::tuple<const city::SurfacePicture*, int, int, Group>;
  std::map<Key, Used> used;
  std::vector<Used*> in_order;
  std::vector<Used*> by_number(placed_.size());
  const auto find = [&](const city::SurfacePicture& picture, const Placed& placed, Group group) {
    const double texels = texels_per_m * std::sqrt(placed.area_m2 / std::max(placed.pixels, 1e-9));
    const double scale = std::clamp(texels, 0.0, 1.0);
    const auto to_texels = [scale](int pixels) {
      return std::max(1, static_cast<int>(std::ceil(scale * pixels)));
    };
    const int width = to_texels(picture.width), height = to_texels(picture.height);
    const Key key{&picture, width, height, group};
    auto at = used.find(key);
    if (at == used.end()) {
      at = used.emplace(key, Used{static_cast<std::uint32_t>(in_order.size()),
                                  resize(picture, width, height),
                                  group,
                                  {double(width) / picture.width, double(height) / picture.height}})
               .first;
      in_order.push_back(&at->second);
    }
    at->second.area_m2 += placed.area_m2;
    return &at->second;
  };
  SurfacePictures result;
  result.triangles.resize(mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const mesh::MeshTriangle& triangle = mesh.triangles[i];
    if (triangle.polygon >= object.polygons.size()) continue;
    const city::Polygon& polygon = object.polygons[triangle.polygon];
    if (!polygon.picture || polygon.picture_number == 0) continue;
    const std::size_t number = polygon.picture_number - 1;
    if (!by_number[number])
      by_number[number] = find(*polygon.picture, placed_[number], find_group(triangle.surface));
    result.triangles[i].piece = by_number[number]->piece;
    for (int k = 0; k < 3; ++k)
      result.triangles[i].places[k] = glm::vec2(
          by_number[number]->scale * placed_[number].find(mesh.positions[triangle.vertex[k]]));
  }
  if (in_order.empty()) return {};

  const bool is_evened = object.type == city::ObjectType::building;
  std::array<double, static_cast<std::size_t>(Group::count)> light{}, area_m2{};
  for (const Used* one : in_order) {
    light[static_cast<std::size_t>(one->group)] += one->area_m2 * one->image.mean_luminance();
    area_m2[static_cast<std::size_t>(one->group)] += one->area_m2;
  }
  for (const Used* one : in_order) {
    const auto group = static_cast<std::size_t>(one->group);
    const double own = one->image.mean_luminance();
    const bool is_lit = is_evened && own > 0 && area_m2[group] > 0;
    result.pieces.push_back(
        to_piece(one->image, is_lit ? light[group] / area_m2[group] / own : 1.0));
  }
  return result;
}

}  // namespace nightcity::bake
