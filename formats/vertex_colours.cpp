#include "formats/vertex_colours.h"

#include <algorithm>

#include "formats/srgb.h"

namespace nightcity {
namespace {

// Returns the level of a channel, 0 to 63, in sRGB, whose steps look alike.
std::uint64_t level_of(double linear) {
  return static_cast<std::uint64_t>(std::clamp(srgb_from_linear(linear), 0.0, 1.0) * 63 + 0.5);
}

}  // namespace

void VertexColours::apply(ScenePrimitive& primitive, const std::vector<glm::vec3>& colours,
                          std::size_t first) {
  const auto is_white = [](const glm::vec3& colour) { return colour == glm::vec3(1); };
  if (std::all_of(colours.begin(), colours.end(), is_white)) return;
  ++primitives_;
  primitive.triangle_materials.reserve(primitive.indices.size() / 3);
  for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
    glm::dvec3 mean(0);
    for (std::size_t k = 0; k < 3; ++k) mean += glm::dvec3(colours[primitive.indices[i + k]]) / 3.0;
    const std::uint64_t key = std::uint64_t{primitive.material} << 18 | level_of(mean.x) << 12 |
                              level_of(mean.y) << 6 | level_of(mean.z);
    const auto [place, added] = places_.try_emplace(key, static_cast<std::uint32_t>(bins_.size()));
    if (added) bins_.push_back({primitive.material, glm::dvec3(0), 0});
    Bin& bin = bins_[place->second];
    bin.sum += mean;
    ++bin.triangles;
    primitive.triangle_materials.push_back(static_cast<std::uint32_t>(first + place->second));
  }
}

std::vector<SceneMaterial> VertexColours::materials(
    const std::vector<SceneMaterial>& of_file) const {
  std::vector<SceneMaterial> made;
  made.reserve(bins_.size());
  for (const Bin& bin : bins_) {
    made.push_back(of_file[bin.base]);
    made.back().texture.reset();  // a triangle has one colour
    made.back().base_colour *= glm::vec3(bin.sum / static_cast<double>(bin.triangles));
  }
  return made;
}

}  // namespace nightcity
