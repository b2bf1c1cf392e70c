// Advertising as luminous rectangles.
#pragma once

#include "tools/lights/road_index.h"
#include "tools/lights/taken_places.h"
#include "tools/map_lights/light_collector.h"
#include "tools/map_lights/sign_tags.h"

namespace nightcity::map_lights {

/// Places signs one by one. A sign with one face looks at the road beside it, one with two faces
/// stands across it and is seen by both directions; the tag `direction` says otherwise. A sign
/// mapped as a line or an area lies along it. One inside a building moves out of it, to the wall
/// towards the road, and loses its back.
class SignPlacer {
 public:
  SignPlacer(const Ground& ground, const lights::RoadIndex& roads, LightCollector& out)
      : ground_(ground), roads_(roads), out_(out) {}

  void place(const osm::OsmShiningThing& thing, const std::vector<glm::dvec2>& outline,
             const MapLightOptions& options);

 private:
  glm::dvec2 find_facing(const glm::dvec2& lon_lat, const SignTags& tags, const glm::dvec2& at,
                         const std::optional<lights::RoadIndex::Nearest>& road) const;
  void add_faces(const LitThing& thing, const SignTags& tags, const Body& body);

  const Ground& ground_;
  const lights::RoadIndex& roads_;
  LightCollector& out_;
  lights::TakenPlaces taken_;
};

}  // namespace nightcity::map_lights
