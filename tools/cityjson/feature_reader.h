// Reads city objects that have been parsed, and passes them on.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tools/city/city_reader.h"
#include "tools/city/skip_counter.h"
#include "tools/cityjson/object_reader.h"

namespace nightcity::cityjson {

/// City objects that are read together, on one thread.
struct Batch {
  std::vector<city::CityObject> objects;
  city::ReadReport report;
  city::SkipCounter skipped;
  std::function<void()> rest;  // what the stage leaves to be done in file order

  void read(std::span<const GroupMember> group, const GeometrySources& sources,
            const city::ReadOptions& options);
  /// Hands the objects to the stage; call when all are read.
  void hand_over(const city::ObjectStage& stage);
  /// Does what is left, in file order, and adds to the report of the file.
  void take_into(city::ReadReport& file);
};

/// Reads a CityJSONFeature, or all city objects of a small CityJSON. Throws Error, with `name` and
/// `line`, where it is neither.
void read_feature(const dom::element& value, const SharedParts& shared,
                  const city::ReadOptions& options, const std::string& name, std::size_t line,
                  Batch& batch);

}  // namespace nightcity::cityjson
