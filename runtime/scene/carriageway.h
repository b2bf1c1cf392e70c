// Carriageways of a scene, known by what they are made of.
#pragma once

#include <glm/vec3.hpp>

#include "runtime/scene/render_scene.h"

namespace nightcity::scene {

/// Returns whether something of the scene is made as carriageways are (is_carriageway_material).
/// Scenes of other programs and cities without streets have nothing of the kind.
bool has_carriageways(const RenderScene& scene);

/// Returns whether the ground below an eye is made as carriageways are.
bool stands_on_carriageway(const RenderScene& scene, const glm::dvec3& eye);

/// Returns how far a carriageway goes on in a level direction of unit length, m, at most `most_m`:
/// below an eye or up to 4 m beside it, as from a pavement, on ground that rises or falls by up to
/// a fifth. 0 where none is there.
double find_carriageway_ahead(const RenderScene& scene, const glm::dvec3& eye,
                              const glm::dvec3& ahead, double most_m);

}  // namespace nightcity::scene
