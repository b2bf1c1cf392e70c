// The pictures on a scene's surfaces, as the device has them.
#pragma once

#include <vector>

#include "formats/scene.h"
#include "runtime/scene/render_scene.h"

namespace nightcity::scene {

/// Unpacks the pictures of the textures of `materials`, which are parallel to `out.materials`, with
/// their smaller levels. Materials keep the mean colour alone where they shine or are as smooth as
/// water, where a picture cannot be unpacked, or where `out.left_out` has textures or colours.
void add_textures(RenderScene& out, const std::vector<SceneMaterial>& materials,
                  const std::vector<ScenePicture>& pictures);

}  // namespace nightcity::scene
