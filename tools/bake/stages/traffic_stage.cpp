#include "tools/bake/stages/traffic_stage.h"

#include <algorithm>

#include "formats/error.h"
#include "formats/traffic_pose.h"
#include "tools/bake/stages/lamp_stage.h"
#include "tools/traffic/bodies.h"

namespace nightcity {
namespace {

/// Where wheels stand: on the ground, or on a road that lies on it.
HeightAt road_height_on(const Terrain& terrain) {
  constexpr double on_it_m = 0.6;  // higher up it is a bridge
  return [&terrain](const glm::dvec2& place) -> std::optional<double> {
    const auto ground = terrain.height_at(place);
    if (!ground || ground->footing == Footing::roof) return std::nullopt;
    const auto road = terrain.height_of(Footing::road, place);
    return road && *road > ground->height_m && *road < ground->height_m + on_it_m
               ? *road
               : ground->height_m;
  };
}

std::optional<double> flat(const glm::dvec2&) {
  return 0.0;
}

traffic::TrafficSet drive_on(const Recipe& recipe, const OsmData& osm, const CityFrame& frame,
                             const HeightAt& height, const InsideBuilding& inside,
                             const Georeference& georeference, const ProgressSink& progress) {
  return traffic::make_traffic(
      osm.highways, [&](const glm::dvec2& lon_lat) { return frame.from_lon_lat(lon_lat); }, height,
      inside, recipe.traffic.options, georeference,
      [&](const char* step, double share) {
        if (progress)
          progress({std::string("traffic: ") + step, static_cast<std::size_t>(share * 100), "%"});
      });
}

}  // namespace

traffic::TrafficSet make_city_traffic(const Recipe& recipe, const OsmData& osm,
                                      const CityFrames& frames, const Terrain& terrain,
                                      const Georeference& georeference,
                                      const ProgressSink& progress) {
  if (osm.highways.empty()) return {};
  if (!frames.city().has_lon_lat())
    throw Error("", "[city] crs",
                "the city names no CRS: streets cannot be placed without crs or control_points");
  const auto inside = [&](const glm::dvec2& p) {
    return terrain.height_of(Footing::ground_surface, p).has_value();
  };
  // Roads published without heights, in a model without any ground: a bake leaves them at 0, and so do we.
  const auto has_ground = [&](const OsmWay& way) {
    return std::any_of(way.lon_lat.begin(), way.lon_lat.end(), [&](const glm::dvec2& lon_lat) {
      return terrain.height_at(frames.city().from_lon_lat(lon_lat)).has_value();
    });
  };
  const bool groundless = recipe.osm.files.empty() &&
                          std::none_of(osm.highways.begin(), osm.highways.end(), has_ground);
  return drive_on(recipe, osm, frames.city(), groundless ? HeightAt(flat) : road_height_on(terrain),
                  inside, georeference, progress);
}

traffic::TrafficSet make_map_traffic(const Recipe& recipe, const OsmData& osm,
                                     const CityFrame& frame, const Georeference& georeference,
                                     const ProgressSink& progress) {
  return drive_on(recipe, osm, frame, flat, {}, georeference, progress);
}

LightFileContent content_of(const LightFile& file) {
  LightFileContent content;
  content.georeference = file.georeference();
  content.lights = file.lights();
  content.provenance = file.provenance();
  content.profiles = file.profiles();
  content.profile_data = file.profile_data();
  content.schedules = file.schedules();
  content.switches = file.switches();
  content.traffic = file.traffic();
  return content;
}

void finish_with_traffic(LightFileWriter& writer, LightFileContent content,
                         const traffic::TrafficSet& traffic) {
  std::vector<LightProfile> profiles(content.profiles.begin(), content.profiles.end());
  std::vector<float> data(content.profile_data.begin(), content.profile_data.end());
  const auto first_profile = static_cast<uint>(profiles.size()),
             first_value = static_cast<uint>(data.size());
  for (LightProfile profile : traffic.profiles.profiles) {
    profile.data_offset += first_value;
    profiles.push_back(profile);
  }
  data.insert(data.end(), traffic.profiles.data.begin(), traffic.profiles.data.end());
  std::vector<Light> lights = traffic.vehicle_lights;
  for (Light& light : lights) light.kind_profile += first_profile << 8;
  content.profiles = profiles;
  content.profile_data = data;
  content.traffic = traffic.trips.empty() ? TrafficContent{} : traffic.content();
  content.traffic.vehicle_lights =
      traffic.trips.empty() ? std::span<const Light>() : std::span<const Light>(lights);
  writer.finish(content);
}

void write_with_traffic(const std::filesystem::path& path, LightFileContent content,
                        const traffic::TrafficSet& traffic) {
  LightFileWriter writer(path);
  finish_with_traffic(writer, std::move(content), traffic);
}

void add_vehicle_models(SceneWriter& writer, const traffic::TrafficSet& traffic, double t) {
  const TrafficContent content = traffic.content();
  for (std::uint32_t kind = 0; kind < content.vehicles.size(); ++kind) {
    const traffic::VehicleType& type = traffic::vehicle_types[kind];
    SceneNode node;
    node.name = type.name;
    node.kind = "vehicle";
    node.vehicle = kind;
    const Trip* first = nullptr;
    for (const Trip& trip : content.trips) {
      if (trip.vehicle != kind) continue;
      if (!first) first = &trip;
      if (const auto pose = pose_at(content, trip, t))
        node.instances.push_back({glm::mat4(to_model(*pose)), no_id});
    }
    if (!first) continue;
    if (node.instances.empty()) {
      const auto knots = content.knots.subspan(first->first_knot, first->knot_count);
      node.instances.push_back({glm::mat4(to_model(pose_on_drive(knots, 0))), no_id});
    }
    std::vector<std::uint32_t> materials;
    for (const SceneMaterial& material : traffic::body_materials(type))
      materials.push_back(writer.add_material(material));
    node.mesh = writer.add_mesh(traffic::make_body(
        type, {materials[0], materials[1], materials[2], materials[3], materials[4]}));
    writer.add_node(node);
  }
}

}  // namespace nightcity
