// Trees in city.glb: trunks and crowns of loose leaves, instanced.
#pragma once

#include <span>

#include "formats/georeference.h"
#include "formats/scene_writer.h"
#include "tools/trees/model_tree.h"
#include "tools/trees/tree.h"

namespace nightcity::bake {

/// Adds the trees to `writer` as instanced nodes of kind "tree", which cast shadows. A crown is the
/// unit ball of trees::make_leaves, stretched to its size and turned by its place. In winter only
/// evergreens have leaves; other crowns are twigs. Those of `model` are features of the scene.
void add_tree_models(SceneWriter& writer, std::span<const trees::Tree> trees,
                     std::span<const trees::ModelTree> model, trees::Season season,
                     const Georeference& georeference);

}  // namespace nightcity::bake
