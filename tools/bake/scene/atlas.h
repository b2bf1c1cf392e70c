// Packs the pieces of pictures on the surfaces of a tile into few pictures.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "formats/scene.h"
#include "tools/bake/city/surface_pictures.h"

namespace nightcity::bake {

/// Around each piece its edge is repeated for so many texels at least, and pieces begin at
/// multiples of them: two halvings of the picture do not mix one piece with another.
constexpr int atlas_margin = 4;

struct Atlases {
  struct Place {
    std::uint32_t picture;
    glm::ivec2 corner;  // of the piece, in texels from the upper left corner
  };
  std::vector<Place> places;  // of each piece
  std::vector<glm::ivec2> sizes;
  std::vector<ScenePicture> pictures;  // JPEG, parallel to `sizes`
};

/// Packs pieces in shelves, the highest first, into pictures of at most 2048 texels a side. A
/// longer piece gets a picture of its own. The result depends on the pieces and their order alone.
Atlases pack_atlases(std::span<const PicturePiece> pieces);

}  // namespace nightcity::bake
