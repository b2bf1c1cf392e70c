// The traits of a scene decide which passes render it. They are known before its geometry is read.
#pragma once

#include "formats/scene.h"
#include "runtime/scene/render_scene.h"

namespace nightcity::scene {

struct SceneTraits {
  bool profiles = false;    // some light has a luminaire profile
  bool rectangles = false;  // some light is a window
  bool schedules = false;   // some light is not always on
  bool traffic = false;     // vehicles move
  bool water = false;       // a surface is as smooth as water
  bool textures = false;    // pictures lie on surfaces
  bool sky_map = false;     // the sky has a luminance by direction

  bool operator==(const SceneTraits&) const = default;
};

/// Returns the traits of a scene that is complete.
SceneTraits find_traits(const RenderScene& scene);

/// Returns what the traits of a scene will most likely be, by its lights, which `scene` already
/// has, and by the header of its file with the materials that meshes use. A picture that cannot be
/// read is taken for readable, and whether there will be a map of the sky, nobody says yet.
SceneTraits expect_traits(const RenderScene& scene, const Scene& header,
                          const std::vector<bool>& used_materials);

}  // namespace nightcity::scene
