#include "runtime/scene/textures.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>

#include "formats/free_memory.h"
#include "formats/parallel.h"
#include "formats/picture_mean.h"
#include "formats/srgb.h"
#include "runtime/scene/parts.h"

namespace nightcity::scene {
namespace {

struct Level {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint32_t> texels;
};

Level to_level(const Picture& picture) {
  Level level{static_cast<std::uint32_t>(picture.width()),
              static_cast<std::uint32_t>(picture.height()),
              {}};
  const auto bytes = picture.pixels();
  level.texels.resize(bytes.size() / 4);
  for (std::size_t i = 0; i < level.texels.size(); ++i)
    level.texels[i] = std::uint32_t{bytes[4 * i]} | std::uint32_t{bytes[4 * i + 1]} << 8 |
                      std::uint32_t{bytes[4 * i + 2]} << 16;
  return level;
}

// Returns the picture at half its width and height: the mean light of four texels each. The last
// row or column of an odd number is left out.
Level halve(const Level& from) {
  Level to{std::max(from.width / 2, 1u), std::max(from.height / 2, 1u), {}};
  to.texels.reserve(std::size_t{to.width} * to.height);
  for (std::uint32_t y = 0; y < to.height; ++y)
    for (std::uint32_t x = 0; x < to.width; ++x) {
      std::uint32_t texel = 0;
      for (int shift = 0; shift < 24; shift += 8) {
        double sum = 0;
        for (std::uint32_t k = 0; k < 4; ++k) {
          const std::size_t row = std::min(2 * y + k / 2, from.height - 1),
                            column = std::min(2 * x + k % 2, from.width - 1);
          sum += linear_from_srgb8(
              static_cast<std::uint8_t>(from.texels[row * from.width + column] >> shift));
        }
        texel |= std::uint32_t{srgb8_from_linear(sum / 4)} << shift;
      }
      to.texels.push_back(texel);
    }
  return to;
}

std::vector<Level> unpack(const ScenePicture& bytes) {
  const std::optional<Picture> picture = Picture::read(bytes);
  if (!picture) return {};
  std::vector<Level> levels{to_level(*picture)};
  while (levels.size() < TEXTURE_LEVELS && std::max(levels.back().width, levels.back().height) > 1)
    levels.push_back(halve(levels.back()));
  return levels;
}

std::uint32_t to_number(TextureWrap wrap) {
  return wrap == TextureWrap::clamp    ? WRAP_CLAMP
         : wrap == TextureWrap::mirror ? WRAP_MIRROR
                                       : WRAP_REPEAT;
}

// Returns whether a picture may lie on such a material (MATERIAL_IS_COLOUR).
bool is_matt(const gpu::Material& material) {
  return material.emission == glm::vec3(0) && material.roughness >= WATER_ROUGHNESS;
}

}  // namespace

void add_textures(RenderScene& out, const std::vector<SceneMaterial>& materials,
                  const std::vector<ScenePicture>& pictures) {
  if (holds(out.left_out, Part::textures) || holds(out.left_out, Part::colours)) return;
  std::vector<std::uint32_t> used;
  for (std::size_t i = 0; i < materials.size(); ++i)
    if (materials[i].texture && is_matt(out.materials[i]) &&
        materials[i].texture->picture < pictures.size())
      used.push_back(materials[i].texture->picture);
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());

  std::vector<std::vector<Level>> unpacked(used.size());
  run_parallel(used.size(), count_cores(),
               [&](std::size_t i) { unpacked[i] = unpack(pictures[used[i]]); });
  std::map<std::uint32_t, gpu::Texture> shapes;  // of pictures
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (unpacked[i].empty()) continue;
    gpu::Texture& shape = shapes[used[i]];
    shape.first = static_cast<std::uint32_t>(out.texels.size());
    shape.width = unpacked[i].front().width;
    shape.height = unpacked[i].front().height;
    shape.levels = static_cast<std::uint32_t>(unpacked[i].size());
    for (const Level& level : unpacked[i])
      out.texels.insert(out.texels.end(), level.texels.begin(), level.texels.end());
    free_memory(unpacked[i]);
  }
  for (std::size_t i = 0; i < materials.size(); ++i) {
    if (!materials[i].texture || !is_matt(out.materials[i])) continue;
    const auto shape = shapes.find(materials[i].texture->picture);
    if (shape == shapes.end()) continue;
    gpu::Texture& texture = out.textures.emplace_back(shape->second);
    texture.factor = materials[i].texture->factor;
    texture.wrap = to_number(materials[i].texture->wrap_u) | to_number(materials[i].texture->wrap_v)
                                                                 << 2;
    out.materials[i].texture = static_cast<std::uint32_t>(out.textures.size());
  }
}

}  // namespace nightcity::scene
