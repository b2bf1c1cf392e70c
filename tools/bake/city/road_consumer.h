// The roads of a city model, gathered while it is read: they become streets where the map has none.
#pragma once

#include "tools/bake/city/city.h"
#include "tools/bake/city/city_consumer.h"
#include "tools/streets/road_surfaces.h"

namespace nightcity::bake {

class RoadConsumer final : public CityConsumer {
 public:
  Turn prepare(const std::shared_ptr<const PreparedObject>& prepared) override {
    if (prepared->object.type != city::ObjectType::road || prepared->mesh.triangles.empty())
      return {};
    return [this, prepared](bool) { roads_.add(prepared->object); };
  }

  const streets::RoadSurfaces& roads() const { return roads_; }

 private:
  streets::RoadSurfaces roads_;
};

/// Reads a city and builds its ground. `wants_streets`: where the map has no streets, they come
/// from the model's roads. Throws Error as City's functions do.
StreetReport read_ground_and_streets(City& city, bool wants_streets, const ProgressSink& progress);

}  // namespace nightcity::bake
