#include "tools/bake/scene/atlas.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <tuple>

#include "formats/error.h"

// The writer alone: its encoder is the same on all machines, and so are the bytes of a bake.
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

namespace nightcity::bake {
namespace {

constexpr int max_side = 2048;
// The scale ends at 100. Above 90 the encoder keeps all of the colour's detail, for a third more
// bytes.
constexpr int jpeg_quality = 85;

int with_margins(int texels) {
  return (texels + atlas_margin - 1) / atlas_margin * atlas_margin + 2 * atlas_margin;
}

// Gives the pieces their places, from the highest to the lowest.
void place(std::span<const PicturePiece> pieces, Atlases& atlases) {
  std::vector<std::uint32_t> order(pieces.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::tuple(-pieces[a].height, -pieces[a].width, a) <
           std::tuple(-pieces[b].height, -pieces[b].width, b);
  });
  glm::ivec2 at(0);  // in the last picture
  int shelf = 0;     // height of the present one
  const auto begin_picture = [&] {
    atlases.sizes.emplace_back(0);
    at = glm::ivec2(0);
    shelf = 0;
  };
  for (const std::uint32_t i : order) {
    const int width = with_margins(pieces[i].width), height = with_margins(pieces[i].height);
    if (atlases.sizes.empty()) begin_picture();
    if (at.x > 0 && at.x + width > max_side) {
      at = {0, at.y + shelf};
      shelf = 0;
    }
    if (at.y > 0 && at.y + height > max_side) begin_picture();
    atlases.places[i] = {static_cast<std::uint32_t>(atlases.sizes.size() - 1), at + atlas_margin};
    glm::ivec2& size = atlases.sizes.back();
    size.x = std::max(size.x, at.x + width);
    size.y = std::max(size.y, at.y + height);
    at.x += width;
    shelf = std::max(shelf, height);
  }
}

// Draws a piece, and its edge around it as far as its margins go.
void draw(const PicturePiece& piece, const glm::ivec2& corner, int stride,
          std::vector<std::uint8_t>& rgb) {
  const int width = with_margins(piece.width), height = with_margins(piece.height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int from_x = std::clamp(x - atlas_margin, 0, piece.width - 1),
                from_y = std::clamp(y - atlas_margin, 0, piece.height - 1);
      const int to = (corner.y - atlas_margin + y) * stride + corner.x - atlas_margin + x;
      std::memcpy(&rgb[3 * static_cast<std::size_t>(to)],
                  &piece.rgb[3 * static_cast<std::size_t>(from_y * piece.width + from_x)], 3);
    }
}

void append(void* picture, void* bytes, int size) {
  const auto* first = static_cast<const std::byte*>(bytes);
  auto* to = static_cast<ScenePicture*>(picture);
  to->insert(to->end(), first, first + size);
}

}  // namespace

Atlases pack_atlases(std::span<const PicturePiece> pieces) {
  Atlases atlases;
  atlases.places.resize(pieces.size());
  place(pieces, atlases);
  for (std::uint32_t picture = 0; picture < atlases.sizes.size(); ++picture) {
    const glm::ivec2 size = atlases.sizes[picture];
    std::vector<std::uint8_t> rgb(3 * static_cast<std::size_t>(size.x) *
                                  static_cast<std::size_t>(size.y));
    for (std::size_t i = 0; i < pieces.size(); ++i)
      if (atlases.places[i].picture == picture)
        draw(pieces[i], atlases.places[i].corner, size.x, rgb);
    if (!stbi_write_jpg_to_func(append, &atlases.pictures.emplace_back(), size.x, size.y, 3,
                                rgb.data(), jpeg_quality))
      throw Error("textures", "a picture of " + std::to_string(size.x) + " x " +
                                  std::to_string(size.y) + " texels cannot be written");
  }
  return atlases;
}

}  // namespace nightcity::bake
