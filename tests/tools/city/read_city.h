// A city as a reader delivers it, all at once.
#pragma once

#include <string>
#include <vector>

#include "tools/city/city_reader.h"

namespace nightcity::test {

struct City {
  std::vector<city::CityObject> objects;
  city::ReadReport report;

  const city::CityObject* find(const std::string& id) const {
    for (const city::CityObject& object : objects)
      if (object.id == id) return &object;
    return nullptr;
  }
  /// Returns a sink that keeps every object. The city must outlive it.
  city::ObjectSink sink() {
    return [this](city::CityObject&& object) { objects.push_back(std::move(object)); };
  }
};

}  // namespace nightcity::test
