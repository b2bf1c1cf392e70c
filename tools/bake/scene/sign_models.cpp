#include "tools/bake/scene/sign_models.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "tools/bake/scene/shapes.h"

namespace nightcity::bake {

void add_sign_bodies(SceneWriter& writer, std::span<const map_lights::Body> bodies,
                     const Georeference& georeference, std::uint32_t material) {
  SceneNode boxes{"sign boxes", "sign", 0, true, {}}, columns{"sign columns", "sign", 0, true, {}};
  for (const map_lights::Body& body : bodies) {
    // Turns +x to `facing`.
    glm::mat4 place = glm::translate(glm::mat4(1), glm::vec3(georeference.to_model(body.foot)));
    place =
        glm::rotate(place, static_cast<float>(std::atan2(body.facing.y, body.facing.x)), {0, 1, 0});
    const glm::vec3 size(body.is_column ? body.width_m : body.depth_m, body.height_m, body.width_m);
    (body.is_column ? columns : boxes).instances.push_back({glm::scale(place, size), no_id});
  }
  const auto add = [&](SceneNode& node, const char* name, const ScenePrimitive& shape) {
    if (node.instances.empty()) return;
    node.mesh = writer.add_mesh({name, {shape}});
    writer.add_node(node);
  };
  add(boxes, "sign box", make_box(material));
  add(columns, "sign column", make_prism(0.5f, 6, material));
}

}  // namespace nightcity::bake
