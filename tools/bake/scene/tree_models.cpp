#include "tools/bake/scene/tree_models.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <vector>

#include "tools/bake/scene/materials.h"
#include "tools/bake/scene/shapes.h"
#include "tools/random.h"
#include "tools/trees/crown.h"

namespace nightcity::bake {
namespace {

constexpr std::size_t trees_in_node = 8'192;  // trees in one node

// Leaves are clusters and twigs are branches: fewer and larger than a tree's own, with the same
// gaps. Sizes in radii of the crown.
constexpr double leaf_length = 0.2, leaf_width = 0.12, twig_length = 0.7, twig_width = 0.05;

ScenePrimitive make_crown(double gap, double length, double width, std::uint32_t material) {
  ScenePrimitive crown;
  crown.material = material;
  for (const trees::LeafQuad& quad : trees::make_leaves(gap, length, width, 1)) {
    const auto first = static_cast<std::uint32_t>(crown.positions.size());
    crown.positions.insert(crown.positions.end(), quad.begin(), quad.end());
    for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) crown.indices.push_back(first + i);
  }
  return crown;
}

class TreeModels {
 public:
  TreeModels(SceneWriter& writer, const Georeference& georeference)
      : writer_(writer), georeference_(georeference) {}

  // Adds a feature for each of `trees` that is one of the model's.
  void add_features(std::span<const trees::Tree> trees, std::span<const trees::ModelTree> model) {
    features_.assign(model.size(), no_id);
    for (const trees::Tree& tree : trees) {
      if (!tree.of_model || features_[*tree.of_model] != no_id) continue;
      const trees::ModelTree& own = model[*tree.of_model];
      features_[*tree.of_model] =
          writer_.add_feature({own.id, own.class_name, own.function, own.height_m, std::nullopt});
    }
  }

  void add_trunks(std::span<const trees::Tree> trees) {
    const SceneMaterial bark = named(ground_cover::GroundKind::soil, "bark");
    const auto mesh = writer_.add_mesh({"trunk", {make_prism(1, 6, writer_.add_material(bark))}});
    add("trunks", mesh, trees, [&](const trees::Tree& tree) {
      const auto radius = static_cast<float>(tree.trunk_m / 2);
      // Into the crown, where it ends unseen.
      const auto top = static_cast<float>((tree.clear_m + tree.height_m) / 2);
      return glm::scale(at_foot(tree), {radius, top, radius});
    });
  }

  void add_crowns(std::span<const trees::Tree> trees, bool leaves) {
    if (trees.empty()) return;
    const SceneMaterial material = leaves ? named(ground_cover::GroundKind::scrub, "leaves")
                                          : named(ground_cover::GroundKind::soil, "twigs");
    const auto index = writer_.add_material(material);
    const auto mesh = writer_.add_mesh(
        {material.name,
         {leaves ? make_crown(trees::gap_with_leaves, leaf_length, leaf_width, index)
                 : make_crown(trees::gap_without_leaves, twig_length, twig_width, index)}});
    add(leaves ? "crowns" : "bare crowns", mesh, trees, [&](const trees::Tree& tree) {
      const auto up = static_cast<float>((tree.height_m - tree.clear_m) / 2),
                 out = static_cast<float>(tree.crown_m / 2);
      Random random{std::llround(tree.foot.x * 100), std::llround(tree.foot.y * 100)};
      glm::mat4 place =
          glm::translate(at_foot(tree), {0, static_cast<float>(tree.clear_m) + up, 0});
      place = glm::scale(place, {out, up, out});
      return glm::rotate(place, static_cast<float>(random.range(0, 2 * std::numbers::pi)),
                         {0, 1, 0});
    });
  }

 private:
  static SceneMaterial named(ground_cover::GroundKind kind, const char* name) {
    SceneMaterial material = find_material(to_code(kind));
    material.name = name;
    return material;
  }

  glm::mat4 at_foot(const trees::Tree& tree) const {
    return glm::translate(glm::mat4(1), glm::vec3(georeference_.to_model(tree.foot)));
  }

  template <class Place>
  void add(const char* name, std::uint32_t mesh, std::span<const trees::Tree> trees,
           const Place& place) {
    for (std::size_t first = 0; first < trees.size(); first += trees_in_node) {
      SceneNode node{name, "tree", mesh, true, {}};
      for (const trees::Tree& tree :
           trees.subspan(first, std::min(trees_in_node, trees.size() - first)))
        node.instances.push_back({place(tree), no_id, {}, find_feature(tree)});
      writer_.add_node(node);
    }
  }

  std::uint32_t find_feature(const trees::Tree& tree) const {
    return tree.of_model ? features_[*tree.of_model] : no_id;
  }

  SceneWriter& writer_;
  const Georeference& georeference_;
  std::vector<std::uint32_t> features_;  // of the model's trees
};

}  // namespace

void add_tree_models(SceneWriter& writer, std::span<const trees::Tree> trees,
                     std::span<const trees::ModelTree> model, trees::Season season,
                     const Georeference& georeference) {
  if (trees.empty() || season == trees::Season::none) return;
  std::vector<trees::Tree> green, bare;
  for (const trees::Tree& tree : trees)
    (season == trees::Season::summer || tree.evergreen ? green : bare).push_back(tree);
  TreeModels models(writer, georeference);
  models.add_features(trees, model);
  models.add_trunks(trees);
  models.add_crowns(green, true);
  models.add_crowns(bare, false);
}

}  // namespace nightcity::bake
