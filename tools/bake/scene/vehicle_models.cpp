#include "tools/bake/scene/vehicle_models.h"

#include <cstdint>
#include <vector>

#include "formats/traffic_pose.h"
#include "tools/traffic/bodies.h"

namespace nightcity::bake {
namespace {

std::vector<SceneInstance> place_kind(const TrafficContent& content, std::uint32_t kind, double t) {
  std::vector<SceneInstance> instances;
  const Trip* first = nullptr;
  for (const Trip& trip : content.trips) {
    if (trip.vehicle != kind) continue;
    if (!first) first = &trip;
    if (const auto pose = pose_at(content, trip, t))
      instances.push_back({glm::mat4(to_model(*pose)), no_id});
  }
  if (first && instances.empty()) {
    const auto knots = content.knots.subspan(first->first_knot, first->knot_count);
    instances.push_back({glm::mat4(to_model(pose_on_trip(knots, 0))), no_id});
  }
  return instances;
}

}  // namespace

void add_vehicle_models(SceneWriter& writer, const traffic::TrafficSet& traffic, double t) {
  const TrafficContent content = traffic.content();
  for (std::uint32_t kind = 0; kind < content.vehicles.size(); ++kind) {
    const traffic::VehicleType& type = traffic::vehicle_types[kind];
    SceneNode node;
    node.name = type.name;
    node.kind = "vehicle";
    node.vehicle = kind;
    node.instances = place_kind(content, kind, t);
    if (node.instances.empty()) continue;
    std::vector<std::uint32_t> materials;
    for (const SceneMaterial& material : traffic::body_materials(type))
      materials.push_back(writer.add_material(material));
    node.mesh = writer.add_mesh(traffic::make_body(
        type, {materials[0], materials[1], materials[2], materials[3], materials[4]}));
    writer.add_node(node);
  }
}

}  // namespace nightcity::bake
