#include "tools/city/city_reader.h"

#include <utility>

namespace nightcity::city {

void ReadReport::merge(const ReadReport& other) {
  if (version.empty()) version = other.version;
  if (srs_name.empty()) srs_name = other.srs_name;
  objects += other.objects;
  polygons += other.polygons;
  extruded += other.extruded;
  flat += other.flat;
  for (const auto& [name, count] : other.skipped) skipped[name] += count;
  warnings.insert(warnings.end(), other.warnings.begin(), other.warnings.end());
}

ObjectStage deliver_to(const ObjectSink& sink) {
  return [&sink](std::vector<CityObject>&& objects) -> std::function<void()> {
    // std::function wants to copy what it holds.
    const auto held = std::make_shared<std::vector<CityObject>>(std::move(objects));
    return [&sink, held] {
      for (CityObject& object : *held) sink(std::move(object));
    };
  };
}

}  // namespace nightcity::city
