#include "tools/bake/city/road_consumer.h"

#include <optional>

namespace nightcity::bake {

StreetReport read_ground_and_streets(City& city, bool wants_streets, const ProgressSink& progress) {
  std::optional<RoadConsumer> roads;
  if (wants_streets && city.wants_model_streets()) roads.emplace();
  city.read({roads ? &*roads : nullptr}, progress);
  city.build_ground();
  return roads ? city.add_model_streets(roads->roads()) : StreetReport{};
}

}  // namespace nightcity::bake
